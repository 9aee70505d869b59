// Exact polynomials in tau with integer coefficients: signs at doubles, common divisors, root counts.
#pragma once
#include <array>
#include <vector>

#include "cfree/number.hpp"

namespace cfree {

// A dyadic rational n / 2^k.
struct Dyadic {
    Int n;
    unsigned k = 0;
    static Dyadic from(double value);
    static Dyadic middle(const Dyadic& p, const Dyadic& q);
    double rounded_down() const;
    double rounded_up() const;
};
int compare(const Dyadic& p, const Dyadic& q);

using Poly = std::vector<Int>;  // coefficients from the constant up; no leading zeros; empty is zero

Poly product(const Poly& p, const Poly& q);
Poly difference(const Poly& p, const Poly& q);
int sign_at(const Poly& p, const Dyadic& tau);
Poly greatest_common_divisor(Poly p, Poly q);
Poly squarefree(const Poly& p);

// Sturm's chain of a squarefree polynomial.
class Sturm {
public:
    explicit Sturm(const Poly& squarefree);
    int roots_in(const Dyadic& lo, const Dyadic& hi) const;  // in (lo, hi]
    const Poly& polynomial() const { return chain[0]; }

private:
    int variations(const Dyadic& tau) const;
    std::vector<Poly> chain;
};

// Isolating intervals (lo, hi] of the roots in (lo, hi], in order, each narrower than 2^-bits.
std::vector<std::array<Dyadic, 2>> isolate(const Sturm& sturm, const Dyadic& lo, const Dyadic& hi, unsigned bits);

}  // namespace cfree

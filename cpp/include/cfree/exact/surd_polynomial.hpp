// Polynomials in tau whose coefficients are sums of square roots of integers: signs at angles, and roots, exactly.
//
// The norm is the product of the polynomial's conjugates, in which roots of integers have the other sign: a polynomial with
// integer coefficients. Roots of the polynomial are roots of its norm; others of those belong to conjugates only.
#pragma once
#include <span>
#include <vector>

#include "cfree/exact/algebraic.hpp"
#include "cfree/exact/surd.hpp"

namespace cfree {

// p = sum of c[k] times the square roots whose bits are set in k; each c[k] is a polynomial.
using SurdPoly = Surds<LongPoly>;

SurdPoly surd_polynomial(std::span<const RootSum> coefficients);  // from the constant up
SurdPoly derivative(const SurdPoly& p);
bool is_zero(const SurdPoly& p);   // at every angle
LongPoly norm(const SurdPoly& p);  // primitive; zero only if p is
SurdPoly primitive(SurdPoly p);    // a positive multiple, without a common factor of its coefficients

int sign_at(const SurdPoly& p, const Dyadic& tau);
// By balls if they are certain, else by squaring; narrows the root's interval.
int sign_at(const SurdPoly& p, LongRoot& x);

struct SurdRoot {
    LongRoot at;        // a root of the norm
    bool changes_sign;  // false: the polynomial only touches zero there
};
// A polynomial without a common factor of its coefficients, and its norm without multiple roots.
struct NormedPoly {
    SurdPoly p;
    LongPoly norm;
    NormedPoly(SurdPoly f) : p(primitive(std::move(f))), norm(squarefree(cfree::norm(p))) {}
};
// The roots strictly between two angles, in order; the polynomial is not zero.
std::vector<SurdRoot> roots_between(const NormedPoly& f, const Dyadic& lo, const Dyadic& hi);

// Parts of the above, for values with more roots (`radicals.hpp`).
int degree_of(const SurdPoly& p);
int size(const SurdPoly& p);                                         // bits of the longest coefficient
RootSum value_at(const SurdPoly& p, const Dyadic& tau, int degree);  // times 2^(k degree), which is at least p's
Ball value_at(const SurdPoly& p, const Ball& tau, int size);         // times 2^-size
Ball narrow_ball(LongRoot& x);                                       // around the root, its radius about 2^-106

}  // namespace cfree

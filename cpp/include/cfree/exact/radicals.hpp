// Values with square roots of polynomials in tau, such as positions on circles: signs at angles, exactly.
#pragma once
#include "cfree/exact/surd_polynomial.hpp"

namespace cfree {

// a + b sqrt(d) + (c + f sqrt(d)) sqrt(e). Where a sign is taken, d and e must not be negative; zero is allowed. With one root
// c = f = e = 0.
struct Radicals {
    SurdPoly a, b, d, c, e, f;
};
int sign_at(const Radicals& p, const Dyadic& tau);
int sign_at(const Radicals& p, LongRoot& x);  // narrows the root's interval

}  // namespace cfree

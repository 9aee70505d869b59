// Signs of values with square roots of polynomials: balls, then squaring.
#include "cfree/exact/radicals.hpp"

#include <algorithm>

#include "cfree/exact/squaring.hpp"

namespace cfree {

namespace {

// A measure of each part, degree or bits, such that all summands have the same: roots have half of that of their squares.
struct Measures {
    int a, b, d, c, e, f;
};
template <class Measure>
Measures measures(const Radicals& p, const Measure& measure) {
    const int d = (measure(p.d) + 1) / 2, e = (measure(p.e) + 1) / 2;
    const int all = std::max({measure(p.a), measure(p.b) + d, measure(p.c) + e, measure(p.f) + d + e});
    return {all, all - d, 2 * d, all - e, 2 * e, all - d - e};
}

std::optional<int> ball_sign(const Radicals& p, const Ball& tau) {
    const Measures m = measures(p, size);
    const Ball d = sqrt(value_at(p.d, tau, m.d)), e = sqrt(value_at(p.e, tau, m.e));
    const Ball first = value_at(p.a, tau, m.a) + value_at(p.b, tau, m.b) * d;
    return certain_sign(first + (value_at(p.c, tau, m.c) + value_at(p.f, tau, m.f) * d) * e);
}

}  // namespace

int sign_at(const Radicals& p, const Dyadic& tau) {
    if (const auto sign = ball_sign(p, ball(tau.n, static_cast<int>(tau.k)))) return *sign;
    const Measures m = measures(p, degree_of);
    const auto at = [&](const SurdPoly& part, int n) { return value_at(part, tau, n); };
    return sign_by_squaring(at(p.a, m.a), at(p.b, m.b), at(p.d, m.d), at(p.c, m.c), at(p.f, m.f), at(p.e, m.e),
                            [](const RootSum& x) { return x.sign(); });
}

int sign_at(const Radicals& p, LongRoot& x) {
    const Ball tau = narrow_ball(x);
    if (x.is_dyadic()) return sign_at(p, x.lo);
    if (const auto sign = ball_sign(p, tau)) return *sign;
    return sign_by_squaring(p.a, p.b, p.d, p.c, p.f, p.e, [&](const SurdPoly& part) { return sign_at(part, x); });
}

}  // namespace cfree

// Compare real roots by halving, common divisors and Sturm chains; theory, "Degrees".
#include "cfree/exact/algebraic.hpp"

#include <algorithm>

#include "cfree/support/lookout.hpp"

namespace cfree {

template <class P>
void RootOf<P>::halve() {
    if (is_dyadic()) return;
    heed_stop();
    const Dyadic mid = Dyadic::middle(lo, hi);
    const int s = cfree::sign_at(p, mid);
    if (s == 0) lo = hi = mid;
    else if (s == cfree::sign_at(p, lo)) lo = mid;
    else hi = mid;
}

// Largest d such that the interval is certainly narrower than 2^-d, or 0.
template <class P>
unsigned RootOf<P>::digits() const {
    const unsigned k = std::max(lo.k, hi.k);
    const Int width = (hi.n << (k - hi.k)) - (lo.n << (k - lo.k));
    const unsigned size = width.is_zero() ? 0 : static_cast<unsigned>(msb(width)) + 1;
    return size < k ? k - size : 0;
}

// A step of Newton's method from the middle m, once the interval is narrower than 2^-right, with a bound of its error: by the mean
// value theorem the root is m - p(m) / s for a slope s between the least and the greatest in the interval. The value is exact, the
// slope a double. False if the slope may vanish, or if halving is as good.
template <class P>
bool RootOf<P>::step(unsigned right) {
    constexpr double rounding = 0x1p-50;  // at most 8 u
    const Dyadic m = Dyadic::middle(lo, hi);
    const int size = largest_bit(p);
    const double width = std::ldexp(1.0, -static_cast<int>(right)), t = ball(m.n, static_cast<int>(m.k)).hi, reach = std::abs(t) + width;
    double slope = 0, total = 0, bend = 0;  // p', the sum of its summands, and a bound of p'' in the interval
    for (int i = p.size() - 1; i > 0; --i) {
        const double c = i * ball(p[i], size).hi;
        bend = bend * reach + total, slope = slope * t + c, total = total * reach + std::abs(c);
    }
    const double share = (rounding * p.size() * total + 2 * bend * width) / std::abs(slope);
    if (!(share < 0x1p-4)) return false;
    const Int value = value_at(p, m);
    if (value.is_zero()) return lo = hi = m, true;
    const double by = -ball(value, size + static_cast<int>(m.k) * (p.size() - 1)).hi / slope;
    const double error = 2 * (share + rounding) * std::abs(by);
    if (!(error > 0x1p-900)) return false;
    const auto at = [&](double x) {
        const Dyadic d = Dyadic::from(x);
        const unsigned k = std::max(d.k, m.k);
        return Dyadic{(m.n << (k - m.k)) + (d.n << (k - d.k)), k};
    };
    const Dyadic l = at(by - error), h = at(by + error);
    if (cfree::compare(lo, l) < 0) lo = l;
    if (cfree::compare(h, hi) < 0) hi = h;
    return true;
}

// Cut the interval into 2^b parts, and test the part with the chord's root and its neighbours: once half of the digits are
// right, this gives the others.
template <class P>
void RootOf<P>::narrow() {
    heed_stop();
    const unsigned right = digits(), b = right / 2;
    if (is_dyadic() || b < 4) return halve();
    if (b < 100 && step(right)) return;
    const unsigned k = std::max(lo.k, hi.k);
    const Int from = lo.n << (k - lo.k), width = (hi.n << (k - hi.k)) - from;
    const Int below = value_at(p, Dyadic{from, k}), above = value_at(p, Dyadic{from + width, k});
    const Int part = (abs(below) << b) / (abs(below) + abs(above)), last = Int(1) << b;
    const Dyadic l{(from << b) + width * (part == 0 ? part : Int(part - 1)), k + b};
    const Dyadic h{(from << b) + width * std::min(Int(part + 2), last), k + b};
    const int at_l = cfree::sign_at(p, l), at_h = cfree::sign_at(p, h);
    if (at_l == 0) hi = lo = l;
    else if (at_h == 0) lo = hi = h;
    else if (at_l != below.sign()) hi = l, halve();
    else if (at_h != above.sign()) lo = h, halve();
    else lo = l, hi = h;
}

Int value_at(const Poly& p, const Ratio& x) {
    Int value = 0, power = 1;
    for (int k = p.size(); k-- > 0; power *= x.d) value = value * x.n + p[k] * power;
    return value;
}

// The denominator of a rational root divides the leading coefficient: a narrow interval has at most one such number.
std::optional<Ratio> rational_value(RealRoot x) {
    const auto [n, k] = x.lo;
    if (x.is_dyadic()) return reduced(n, Int(1) << k);
    const Int lead = abs(x.p.back());
    if (x.digits() < msb(lead) + 2) {
        x.narrow();
        return rational_value(x);
    }
    const Int near = lead * n, twice = (2 * abs(near)) >> k;
    const Ratio value = reduced(near.sign() * ((twice + 1) >> 1), lead);
    const bool is_within = (value.n << k) >= n * value.d && (value.n << x.hi.k) <= x.hi.n * value.d;
    return is_within && value_at(x.p, value).is_zero() ? std::optional(value) : std::nullopt;
}

namespace {

// Most numbers differ: common divisors are computed only after so many steps, or so many equal digits.
constexpr int few = 6;
constexpr unsigned many = 40;

int roots_in(const Poly& squarefree, const Dyadic& lo, const Dyadic& hi) { return Sturm(squarefree).roots_in(lo, hi); }

// True if the root of x is one of g, a divisor of its polynomial.
template <class P>
bool is_root_of_divisor(const P& g, const RootOf<P>& x) {
    if (g.size() <= 1) return false;
    const int l = sign_at(g, x.lo), h = sign_at(g, x.hi);
    if (l == 0 || h == 0 || l != h) return true;
    return g.size() > 2 && roots_in(squarefree(g), x.lo, x.hi) > 0;
}

// Order of a root and a dyadic number in its interval.
template <class P>
int order_at(const RootOf<P>& x, const Dyadic& at) {
    if (x.is_dyadic()) return compare(x.lo, at);
    const int s = sign_at(x.p, at);
    if (s == 0) return 0;
    return s == sign_at(x.p, x.lo) ? 1 : -1;
}

}  // namespace

template <class P>
int sign_at(const P& q, RootOf<P>& x) {
    if (q.empty()) return 0;
    bool differ = false;
    for (int k = 0; !x.is_dyadic(); ++k, x.narrow()) {
        if (const int s = sign_on(q, x.lo, x.hi); s != 0) return s;
        if (differ || (k < few && x.digits() < many)) continue;
        if (is_root_of_divisor(greatest_common_divisor(q, x.p), x)) return 0;
        differ = true;
    }
    return sign_at(q, x.lo);
}

template <class P>
int compare(RootOf<P>& x, RootOf<P>& y) {
    if (compare(x.hi, y.lo) < 0) return -1;
    if (compare(y.hi, x.lo) < 0) return 1;
    bool differ = false;
    for (int k = 0;; ++k, (x.digits() < y.digits() ? x : y).narrow()) {
        if (compare(x.hi, y.lo) < 0) return -1;
        if (compare(y.hi, x.lo) < 0) return 1;
        if (x.is_dyadic()) return -order_at(y, x.lo);
        if (y.is_dyadic()) return order_at(x, y.lo);
        if (differ || (k < 2 * few && std::min(x.digits(), y.digits()) < many)) continue;
        const RootOf<P> both{{}, compare(x.lo, y.lo) < 0 ? y.lo : x.lo, compare(x.hi, y.hi) < 0 ? x.hi : y.hi};
        if (is_root_of_divisor(greatest_common_divisor(x.p, y.p), both)) return 0;
        differ = true;
    }
}

template <class P>
int compare(const RootOf<P>& x, const Dyadic& y) {
    if (compare(x.hi, y) < 0) return -1;
    if (compare(y, x.lo) < 0) return 1;
    return order_at(x, y);
}

template struct RootOf<Poly>;
template struct RootOf<LongPoly>;
template int sign_at(const Poly&, RealRoot&);
template int sign_at(const LongPoly&, LongRoot&);
template int compare(RealRoot&, RealRoot&);
template int compare(LongRoot&, LongRoot&);
template int compare(const RealRoot&, const Dyadic&);
template int compare(const LongRoot&, const Dyadic&);

}  // namespace cfree

// Arithmetic of polynomials of any degree.
#include "cfree/exact/long_polynomial.hpp"

namespace cfree {

LongPoly& LongPoly::operator+=(const LongPoly& q) {
    if (size() < q.size()) resize(q.size());
    for (int i = 0; i < q.size(); ++i) (*this)[i] += q[i];
    trim();
    return *this;
}

LongPoly& LongPoly::operator*=(const Int& factor) {
    for (Int& x : c) x *= factor;
    trim();
    return *this;
}

LongPoly LongPoly::operator-() const {
    LongPoly p = *this;
    for (Int& x : p) x = -x;
    return p;
}

LongPoly operator+(LongPoly p, const LongPoly& q) {
    p += q;
    return p;
}
LongPoly operator-(const LongPoly& p, const LongPoly& q) { return -q + p; }

LongPoly operator*(const LongPoly& p, const LongPoly& q) {
    if (p.empty() || q.empty()) return {};
    LongPoly r;
    r.resize(p.size() + q.size() - 1);
    for (int i = 0; i < p.size(); ++i)
        for (int j = 0; j < q.size(); ++j) r[i + j] += p[i] * q[j];
    return r;
}

LongPoly derivative(const LongPoly& p) {
    LongPoly d;
    d.resize(p.degree());
    for (int i = 1; i < p.size(); ++i) d[i - 1] = p[i] * i;
    return d;
}

LongPoly primitive(LongPoly p) {
    Int divisor = 0;
    for (const Int& x : p) {
        divisor = gcd(divisor, x);
        if (divisor == 1) return p;
    }
    for (Int& x : p) x /= divisor;
    return p;
}

std::optional<LongPoly> quotient(LongPoly p, const LongPoly& q) {
    LongPoly result;
    result.resize(std::max(p.size() - q.size() + 1, 0));
    for (int k = result.size(); k-- > 0;) {
        Int rest;
        divide_qr(p[k + q.degree()], q.back(), result[k], rest);
        if (!rest.is_zero()) return {};
        for (int i = 0; i < q.size(); ++i) p[i + k] -= result[k] * q[i];
    }
    p.trim();
    return p.empty() ? std::optional(std::move(result)) : std::nullopt;
}

Int value_at(const LongPoly& p, const Dyadic& tau) {
    Int value = 0;
    for (int i = p.size(); i-- > 0;) {
        value *= tau.n;
        value += p[i] << (tau.k * static_cast<unsigned>(p.degree() - i));
    }
    return value;
}
int sign_at(const LongPoly& p, const Dyadic& tau) { return value_at(p, tau).sign(); }

// By the slope's bound, as for `Poly`.
int sign_on(const LongPoly& p, const Dyadic& lo, const Dyadic& hi) {
    const unsigned k = std::max(lo.k, hi.k);
    const Int from = lo.n << (k - lo.k), to = hi.n << (k - hi.k), most = std::max(Int(abs(from)), Int(abs(to)));
    LongPoly slope = derivative(p);
    for (Int& x : slope) x = abs(x);
    const Int value = value_at(p, Dyadic{from, k});  // over 2^(k d), and so is its greatest change
    return abs(value) > (to - from) * value_at(slope, Dyadic{most, k}) ? value.sign() : 0;
}

LongPoly squarefree(const LongPoly& p) {
    if (p.size() <= 2) return p;
    const LongPoly divisor = greatest_common_divisor(p, derivative(p));
    return divisor.size() > 1 ? *quotient(p, divisor) : p;
}

}  // namespace cfree

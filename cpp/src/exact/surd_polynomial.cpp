// Norms, signs and roots of polynomials whose coefficients are sums of square roots.
#include "cfree/exact/surd_polynomial.hpp"

#include <algorithm>

#include "cfree/exact/squaring.hpp"

namespace cfree {

SurdPoly surd_polynomial(std::span<const RootSum> coefficients) {
    std::vector<Int> all;
    for (const RootSum& x : coefficients) all = joined(all, x.roots);
    std::vector<std::vector<Int>> c(std::size_t(1) << all.size());
    for (const RootSum& x : coefficients) {
        const RootSum same = x.over(all);
        for (std::size_t k = 0; k < c.size(); ++k) c[k].push_back(same.c[k]);
    }
    SurdPoly p(all, {});
    for (auto& part : c) p.c.emplace_back(std::move(part));
    return p;
}

SurdPoly derivative(const SurdPoly& p) {
    SurdPoly result(p.roots, {});
    for (const LongPoly& part : p.c) result.c.push_back(derivative(part));
    return result;
}

bool is_zero(const SurdPoly& p) {
    const SurdPoly same = p.independent();
    return std::all_of(same.c.begin(), same.c.end(), [](const LongPoly& part) { return part.is_zero(); });
}

LongPoly norm(const SurdPoly& p) {
    SurdPoly product = p.independent();
    while (!product.is_rational()) {
        const auto [a, b] = product.split();
        product = a * a - b * b * SurdPoly(product.roots.back());
    }
    return primitive(product.c[0]);
}

SurdPoly primitive(SurdPoly p) {
    const auto is_there = [](const LongPoly& part) { return !part.is_zero(); };
    if (!p.is_rational() && std::count_if(p.c.begin(), p.c.end(), is_there) == 1)  // the polynomial times one root
        p = SurdPoly(*std::find_if(p.c.begin(), p.c.end(), is_there));
    Int content = 0;
    for (const LongPoly& part : p.c)
        for (const Int& x : part)
            if (content = gcd(content, x); content == 1) return p;
    if (content > 1)
        for (LongPoly& part : p.c)
            for (int i = 0; i < part.size(); ++i) part[i] /= content;
    return p;
}

int degree_of(const SurdPoly& p) {
    int most = 0;
    for (const LongPoly& part : p.c) most = std::max(most, part.degree());
    return most;
}

int size(const SurdPoly& p) {
    int most = 0;
    for (const LongPoly& part : p.c)
        for (const Int& x : part)
            if (!x.is_zero()) most = std::max(most, static_cast<int>(msb(abs(x))) + 1);
    return most;
}

RootSum value_at(const SurdPoly& p, const Dyadic& tau, int degree) {
    RootSum value(p.roots, {});
    for (const LongPoly& part : p.c) {
        const auto missing = static_cast<unsigned>(degree - part.degree());
        value.c.push_back(value_at(part, tau) << (tau.k * missing));
    }
    return value;
}

Ball value_at(const SurdPoly& p, const Ball& tau, int size) {
    std::vector<Ball> roots;
    for (const Int& n : p.roots) roots.push_back(sqrt(ball(n, 0)));
    Ball sum;
    for (std::size_t k = 0; k < p.c.size(); ++k) {
        Ball term;
        for (int i = p.c[k].size(); i-- > 0;) term = term * tau + ball(p.c[k][i], size);
        for (std::size_t i = 0; i < roots.size(); ++i)
            if (k >> i & 1) term = term * roots[i];
        sum = sum + term;
    }
    return sum;
}

Ball narrow_ball(LongRoot& x) {
    constexpr unsigned digits = 106;
    while (!x.is_dyadic() && x.digits() < digits) x.narrow();
    const Ball end = ball(x.lo.n, static_cast<int>(x.lo.k));
    return x.is_dyadic() ? end : Ball(end.hi, end.lo, (end.radius + 0x1p-106) * radius_growth);
}

int sign_at(const SurdPoly& p, const Dyadic& tau) { return value_at(p, tau, degree_of(p)).sign(); }

int sign_at(const SurdPoly& p, LongRoot& x) {
    if (x.is_dyadic()) return sign_at(p, x.lo);
    if (p.is_rational() && p.c[0].size() <= 1) return p.c[0].empty() ? 0 : p.c[0].back().sign();
    if (const auto sign = certain_sign(value_at(p, narrow_ball(x), size(p)))) return *sign;
    const SurdPoly same = p.independent();
    if (same.is_rational()) return sign_at(same.c[0], x);
    const auto [a, b] = same.split();
    return sign_by_squaring(a, b, SurdPoly(same.roots.back()), [&](const SurdPoly& f) { return sign_at(f, x); });
}

// True if the sign of p changes at its root tau.
static bool changes_sign(SurdPoly p, const Dyadic& tau) {
    bool changes = false;
    for (; sign_at(p, tau) == 0; p = derivative(p)) changes = !changes;
    return changes;
}

std::vector<SurdRoot> roots_between(const NormedPoly& f, const Dyadic& lo, const Dyadic& hi) {
    const auto& [p, all] = f;
    std::vector<SurdRoot> roots;
    for (const auto& [from, to] : isolate(all, lo, hi)) {
        LongRoot x{all, from, to};
        if (x.is_dyadic()) {  // a rational root of one conjugate is a root of all
            roots.push_back({x, changes_sign(p, from)});
        } else if (sign_at(p, from) != sign_at(p, to)) {  // p has no other root between, and none at the ends
            roots.push_back({x, true});
        } else if (sign_at(p, x) == 0) {
            roots.push_back({x, false});
        }
    }
    return roots;
}

}  // namespace cfree

// Signs of exact points, in machine integers if these can hold them; docs/inside-the-core.md.
#include "cfree/polygons/points.hpp"

#include <algorithm>
#include <utility>

#include "cfree/exact/ball.hpp"

namespace cfree {

namespace {

constexpr unsigned small_bits = 62;    // differences have 63, products of two 126, their sum 127
constexpr int scaled_bits = 100;       // bits of the doubles: nothing overflows, and underflows are below `least`
constexpr double least = 0x1p-900;

unsigned bits(const Int& n) { return n.is_zero() ? 0 : static_cast<unsigned>(msb(abs(n))) + 1; }

}  // namespace

Points::Points(std::vector<Int> exact_x, std::vector<Int> exact_y) {
    unsigned widest = 0;
    for (const auto* axis : {&exact_x, &exact_y})
        for (const Int& c : *axis) widest = std::max(widest, bits(c));
    if (widest <= small_bits) {
        small.reserve(exact_x.size());
        for (std::size_t k = 0; k < exact_x.size(); ++k)
            small.push_back({static_cast<std::int64_t>(exact_x[k]), static_cast<std::int64_t>(exact_y[k])});
        return;
    }
    const auto rounded = [shift = static_cast<int>(widest) - scaled_bits](const std::vector<Int>& from) {
        std::vector<double> about;
        about.reserve(from.size());
        for (const Int& c : from) about.push_back(ball(c, shift).hi);
        return about;
    };
    auto about_x = rounded(exact_x), about_y = rounded(exact_y);
    large = std::make_shared<const Large>(Large{std::move(exact_x), std::move(exact_y), std::move(about_x), std::move(about_y)});
}

std::array<std::vector<Int>, 2> Points::coordinates() const {
    if (large) return {large->X, large->Y};
    std::array<std::vector<Int>, 2> result;
    for (auto& axis : result) axis.reserve(small.size());
    for (const auto& [x, y] : small) result[0].emplace_back(x), result[1].emplace_back(y);
    return result;
}

Points Points::chosen(const std::vector<Index>& which) const {
    std::vector<Int> chosen_x, chosen_y;
    chosen_x.reserve(which.size()), chosen_y.reserve(which.size());
    for (const Index k : which) chosen_x.push_back(X(k)), chosen_y.push_back(Y(k));
    return {std::move(chosen_x), std::move(chosen_y)};
}

std::array<Int, 4> Points::box() const {
    const auto extremes = [count = size()](auto at) {
        Index least = 0, most = 0;
        for (Index k = 1; k < count; ++k) {
            if (at(k) < at(least)) least = k;
            if (at(most) < at(k)) most = k;
        }
        return std::pair(least, most);
    };
    const auto around = [&](auto x, auto y) {
        const auto [x0, x1] = extremes(x);
        const auto [y0, y1] = extremes(y);
        return std::array{X(x0), Y(y0), X(x1), Y(y1)};
    };
    if (are_small()) return around([&](Index k) { return small[k].x; }, [&](Index k) { return small[k].y; });
    return around([&](Index k) -> const Int& { return large->X[k]; }, [&](Index k) -> const Int& { return large->Y[k]; });
}

int Points::compare(Index p, Index q) const {
    const auto order = [](const auto& a, const auto& b) { return (a > b) - (a < b); };
    if (are_small()) {
        const auto &a = small[p], &b = small[q];
        return a.x != b.x ? order(a.x, b.x) : order(a.y, b.y);
    }
    // rounding keeps the order
    const auto& [X, Y, about_x, about_y] = *large;
    if (about_x[p] != about_x[q]) return order(about_x[p], about_x[q]);
    if (const int by_x = X[p].compare(X[q])) return by_x < 0 ? -1 : 1;
    if (about_y[p] != about_y[q]) return order(about_y[p], about_y[q]);
    const int by_y = Y[p].compare(Y[q]);
    return (by_y > 0) - (by_y < 0);
}

template <bool is_dot>
int Points::sign(Index p, Index q, Index r, Index s) const {
    if (are_small()) {
        const Vec<std::int64_t> u = small[q] - small[p], v = small[s] - small[r];
        const Wide value = is_dot ? Wide(u.x) * v.x + Wide(u.y) * v.y : Wide(u.x) * v.y - Wide(u.y) * v.x;
        return (value > 0) - (value < 0);
    }
    // six roundings in a row: inputs, differences, products (2 + 2 + 1), their sum
    const Vec<Approx> u = about(p, q), v = about(r, s);
    const Approx value = is_dot ? dot(u, v) : cross(u, v);
    if (std::abs(value.v) > 8 * 0x1p-53 * value.m + least) return value.v > 0 ? 1 : -1;
    const Vec<Int> U{X(q) - X(p), Y(q) - Y(p)}, V{X(s) - X(r), Y(s) - Y(r)};
    return (is_dot ? dot(U, V) : cross(U, V)).sign();
}

int Points::turn(Index p, Index q, Index r, Index s) const { return sign<false>(p, q, r, s); }
int Points::along(Index p, Index q, Index r, Index s) const { return sign<true>(p, q, r, s); }

int Points::compare_lengths(Index p, Index q, Index r, Index s) const {
    const auto square = [](auto x_length, auto y_length) { return x_length * x_length + y_length * y_length; };
    if (are_small()) {
        const auto between = [&](Index from, Index to) { return square(Wide(small[to].x) - small[from].x, Wide(small[to].y) - small[from].y); };
        const Wide one = between(p, q), other = between(r, s);
        return (one > other) - (one < other);
    }
    const Vec<Approx> u = about(p, q), v = about(r, s);
    const Approx order = dot(u, u) - dot(v, v);  // seven roundings in a row
    if (std::abs(order.v) > 9 * 0x1p-53 * order.m + least) return order.v > 0 ? 1 : -1;
    return square(Int(X(q) - X(p)), Int(Y(q) - Y(p))).compare(square(Int(X(s) - X(r)), Int(Y(s) - Y(r))));
}

Vec<Approx> Points::about(Index from, Index to) const {
    const auto difference = [&](const std::vector<double>& c) {
        return Approx{c[to] - c[from], std::abs(c[to]) + std::abs(c[from])};
    };
    return {difference(large->about_x), difference(large->about_y)};
}

bool Points::is_upper(Index p, Index q) const {
    const auto decided = [&](const auto& from_x, const auto& from_y, const auto& to_x, const auto& to_y) {
        return to_y > from_y || (to_y == from_y && to_x > from_x);
    };
    if (are_small()) return decided(small[p].x, small[p].y, small[q].x, small[q].y);
    return decided(large->X[p], large->Y[p], large->X[q], large->Y[q]);
}

Meeting meet(const Points& v, Index p, Index q, Index r, Index s) {
    const int r_side = v.orient(p, q, r), s_side = v.orient(p, q, s);
    if (r_side == s_side) {
        if (r_side) return Meeting::apart;
        const auto ordered = [&](Index a, Index b) { return v.before(a, b) ? std::pair(a, b) : std::pair(b, a); };
        const auto [a, b] = ordered(p, q);
        const auto [c, d] = ordered(r, s);
        const int order = v.compare(ordered(a, c).second, ordered(b, d).first);
        return order == 0 ? Meeting::touch : order < 0 ? Meeting::overlap : Meeting::apart;
    }
    const int p_side = v.orient(r, s, p), q_side = v.orient(r, s, q);
    if (p_side == q_side) return Meeting::apart;
    return p_side && q_side && r_side && s_side ? Meeting::cross : Meeting::touch;
}

Location locate_in_sector(const Points& v, Index o, Index towards, Index start, Index end) {
    const int after_start = v.turn(o, start, o, towards), before_end = v.turn(o, towards, o, end);
    if ((after_start == 0 && v.along(o, start, o, towards) >= 0) || (before_end == 0 && v.along(o, end, o, towards) >= 0))
        return Location::boundary;
    const bool follows = after_start > 0, precedes = before_end > 0;
    const int whole = v.turn(o, start, o, end);
    const bool inside = whole > 0   ? follows && precedes
                        : whole < 0 ? follows || precedes
                                    : follows || v.along(o, start, o, end) >= 0;
    return inside ? Location::inside : Location::outside;
}

}  // namespace cfree

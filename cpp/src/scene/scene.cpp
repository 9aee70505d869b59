// Coordinates in doubles, exact or with remainders, and from origins near the shapes; theory, "Coordinates".
#include "cfree/scene/scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

#include "cfree/exact/ratio.hpp"

namespace cfree {

namespace {

constexpr int root_bits = 110;  // of a root that becomes a ball

Ball about(const Length& length, int shift) {
    if (length.is_rational()) return ball(length.factor, shift);
    const Int square = length.factor * length.factor * length.radicand;
    const int more = std::max(0, root_bits - static_cast<int>(msb(square)) / 2);
    Ball root = ball(root_below(square << (2 * static_cast<unsigned>(more))), shift + more);
    root.radius = ball_error(root.hi);  // ball() cuts at most half of it; what root_below() cuts is less than 2^-109 of the root
    return root;
}

template <class Round>
void set_doubles(Shape& s, Round round) {
    s.rounded.assign(s.X.size(), 0);
    const auto convert = [&](const std::vector<Int>& exact, std::vector<double>& high, std::vector<double>& low) {
        high.clear(), low.clear();
        for (std::size_t v = 0; v < exact.size(); ++v) {
            const Ball b = round(exact[v]);
            high.push_back(b.hi), low.push_back(b.lo);
            s.rounded[v] = std::max(s.rounded[v], static_cast<char>(b.radius != 0 ? 2 : b.lo != 0 ? 1 : 0));
        }
    };
    convert(s.X, s.x, s.x_low), convert(s.Y, s.y, s.y_low);
}

// A quotient of integers times 2^-shift, as two doubles, both rounded once: its value alone decides them.
Ball rounded(const Int& n, const Int& d, int shift) {
    if ((n % d).is_zero()) return ball(n / d, shift);
    int exponent;
    const double high = nearest(n, d), mantissa = std::ldexp(std::frexp(high, &exponent), 53);
    const Int m(static_cast<std::int64_t>(mantissa));
    const int power = exponent - 53;
    const auto up = static_cast<unsigned>(std::abs(power));
    const double low = power < 0 ? ratio((n << up) - m * d, d << up) : ratio(n - (m << up) * d, d);
    return {std::ldexp(high, -shift), std::ldexp(low, -shift), std::ldexp(ball_error(high), -shift)};
}

}  // namespace

void Shape::set_coordinates(std::vector<Int> exact_x, std::vector<Int> exact_y, int shift, const Int& scale) {
    X = std::move(exact_x), Y = std::move(exact_y);
    set_doubles(*this, [&](const Int& c) { return ball(c, shift); });
    for (Radius& radius : radii) radius.about = ball(radius.exact, shift);
    for (Length& length : lengths) length.about = about(length, shift);
    xy.clear();
    for (std::size_t k = 0; k < X.size(); ++k) xy.push_back(nearest(X[k], scale)), xy.push_back(nearest(Y[k], scale));
}

Index Shape::stub_between(Index vertex, Index other) const {
    const Index p = std::min(point[vertex], point[other]), q = std::max(point[vertex], point[other]);
    const auto found = std::lower_bound(touches.begin(), touches.end(), Touch{p, q, -1});
    return found != touches.end() && found->first == p && found->second == q ? found->stub : -1;
}

std::shared_ptr<const Scene> scene_around(Scene scene, const Vec<Int>& robot_origin, const Vec<Int>& obstacle_origin,
                                          int near_shift) {
    const auto is_zero = [](const Vec<Int>& p) { return p.x.is_zero() && p.y.is_zero(); };
    if (is_zero(robot_origin) && is_zero(obstacle_origin) && near_shift == scene.shift)
        return std::make_shared<const Scene>(std::move(scene));
    const auto around = [&](Shape shape, const Vec<Int>& origin) {
        for (Int& c : shape.X) c -= origin.x;
        for (Int& c : shape.Y) c -= origin.y;
        shape.set_coordinates(std::move(shape.X), std::move(shape.Y), near_shift, scene.scale);
        return shape;
    };
    scene.frame = {ratio(obstacle_origin.x, scene.scale), ratio(obstacle_origin.y, scene.scale),
                   ratio(robot_origin.x, scene.scale), ratio(robot_origin.y, scene.scale)};
    Scene moved{around(scene.robot, robot_origin), around(scene.obstacles, obstacle_origin), scene.scale, scene.short_part, near_shift,
                scene.is_bounded, scene.frame, nullptr, scene.is_round};
    scene.moved = std::make_shared<const Scene>(std::move(moved));
    return std::make_shared<const Scene>(std::move(scene));
}

int short_shift(const Scene& scene) {
    const auto bits_of_odd = static_cast<int>(msb(scene.scale) - lsb(scene.scale)), short_bits = static_cast<int>(msb(scene.short_part));
    return std::max(0, scene.shift - (bits_of_odd - short_bits));
}

std::optional<Scene> with_short_doubles(const Scene& scene) {
    const Int odd = scene.scale >> lsb(scene.scale);
    if (scene.is_round || odd == scene.short_part) return {};
    Scene result = scene;
    result.shift = short_shift(scene);
    const auto round = [&](const Int& c) { return rounded(c * scene.short_part, odd, result.shift); };
    set_doubles(result.robot, round), set_doubles(result.obstacles, round);
    return result;
}

namespace {

// First feature of the class of each feature, by layer, then by rank; features of no ring come last.
std::vector<Index> firsts(const std::vector<Index>& of_class, const Shape& shape, const std::vector<Index>& rank) {
    const auto count = static_cast<Index>(of_class.size());
    constexpr auto last = std::numeric_limits<Index>::max();
    const auto key = [&](Index k) {
        return k < shape.ring_vertices ? std::array{shape.layer[k], rank[k], k} : std::array{last, last, k};
    };
    Index classes = 0;
    for (const Index c : of_class) classes = std::max(classes, c + 1);
    std::vector<Index> first(classes, -1), result;
    for (Index k = 0; k < count; ++k)
        if (Index& best = first[of_class[k]]; best < 0 || key(k) < key(best)) best = k;
    for (const Index c : of_class) result.push_back(first[c]);
    return result;
}

}  // namespace

Representatives::Representatives(const Scene& scene) {
    for (const Shape* shape : {&scene.obstacles, &scene.robot}) {
        const bool of_robot = shape == &scene.robot;
        vertices[of_robot] = firsts(shape->point, *shape, shape->vertex_rank);
        edges[of_robot] = firsts(shape->line, *shape, shape->edge_rank);
    }
}

}  // namespace cfree

// Coordinates in doubles, exact or with remainders, and from origins near the shapes; theory, "Coordinates".
#include "cfree/scene/scene.hpp"

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

}  // namespace

void Shape::set_coordinates(std::vector<Int> exact_x, std::vector<Int> exact_y, int shift, const Int& scale) {
    X = std::move(exact_x), Y = std::move(exact_y);
    const auto convert = [&](const std::vector<Int>& exact, std::vector<double>& high, std::vector<double>& low) {
        high.clear(), low.clear();
        for (const Int& c : exact) {
            const Ball b = ball(c, shift);
            high.push_back(b.hi), low.push_back(b.lo);
            rounded |= b.lo != 0 || b.radius != 0;
            rounded_twice |= b.radius != 0;
        }
    };
    convert(X, x, x_low), convert(Y, y, y_low);
    for (Radius& radius : radii) radius.about = ball(radius.exact, shift);
    for (Length& length : lengths) length.about = about(length, shift);
    xy.clear();
    for (std::size_t k = 0; k < X.size(); ++k) xy.push_back(nearest(X[k], scale)), xy.push_back(nearest(Y[k], scale));
}

std::shared_ptr<const Scene> scene_around(Scene scene, const Vec<Int>& robot_origin, const Vec<Int>& obstacle_origin,
                                          int near_shift, const Rounded& near_rounded) {
    const auto is_zero = [](const Vec<Int>& p) { return p.x.is_zero() && p.y.is_zero(); };
    if (is_zero(robot_origin) && is_zero(obstacle_origin) && near_shift == scene.shift)
        return std::make_shared<const Scene>(std::move(scene));
    const auto around = [&](Shape shape, const Vec<Int>& origin, const Rounded& before) {
        shape.rounded = before.once, shape.rounded_twice = before.twice;
        for (Int& c : shape.X) c -= origin.x;
        for (Int& c : shape.Y) c -= origin.y;
        shape.set_coordinates(std::move(shape.X), std::move(shape.Y), near_shift, scene.scale);
        return shape;
    };
    scene.frame = {ratio(obstacle_origin.x, scene.scale), ratio(obstacle_origin.y, scene.scale),
                   ratio(robot_origin.x, scene.scale), ratio(robot_origin.y, scene.scale)};
    Scene moved{around(scene.robot, robot_origin, {}), around(scene.obstacles, obstacle_origin, near_rounded), scene.scale, near_shift,
                scene.is_bounded, scene.frame, nullptr, scene.is_round};
    scene.moved = std::make_shared<const Scene>(std::move(moved));
    return std::make_shared<const Scene>(std::move(scene));
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

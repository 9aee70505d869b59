// Refuse scenes for their numbers, with messages; docs/exact.md.
#include "cfree/scene/coordinate_range.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace cfree {

namespace {

unsigned bits(const Int& n) { return n.is_zero() ? 0 : static_cast<unsigned>(msb(abs(n))) + 1; }

std::string formatted(const char* format, double value) {
    std::array<char, 64> text;
    std::snprintf(text.data(), text.size(), format, value);
    return text.data();
}

// Approximate text of a number of any length.
std::string shown(const Int& value) {
    const int power = std::max(0, static_cast<int>(bits(value)) * 30103 / 100000 - 6);  // six or seven digits remain
    if (power <= 6) return value.str();
    const Int leading = floor_divide(value, boost::multiprecision::pow(Int(10), static_cast<unsigned>(power)));
    const std::string text = formatted("%e", static_cast<double>(leading));
    const auto mark = text.find('e');
    return formatted("%.6g", std::strtod(text.substr(0, mark).c_str(), nullptr)) + "e" +
           std::to_string(std::atoi(text.c_str() + mark + 1) + power);
}

// "1,110"
std::string grouped(unsigned n) {
    std::string digits = std::to_string(n);
    for (int k = static_cast<int>(digits.size()) - 3; k > 0; k -= 3) digits.insert(static_cast<std::size_t>(k), 1, ',');
    return digits;
}

struct Extreme {
    std::string_view kind;
    Index index;
    Int value, denominator;  // the coordinate of largest size, times the denominator
    bool is_radius = false;
};

// A radius below 0, none where a polygon has no interior, or another number of them than of polygons.
std::optional<RangeFault> radius_fault(const SceneShapes& shapes) {
    const auto fault = [](const char* kind, Index index, const Polygon& polygon, const Ratio& radius) -> std::optional<RangeFault> {
        if (radius.n.sign() < 0) return RangeFault{kind, index, "the radius " + text_of(radius) + " is below 0; give 0 or more"};
        if (polygon.is_thin() && radius.n.is_zero())
            return RangeFault{kind, index, "a point or a segment has no interior; give it a radius above 0"};
        return {};
    };
    for (const auto& [kind, polygons, roundings] : {std::tuple{"robot", &shapes.robot, &shapes.robot_rounding},
                                                    {"obstacles", &shapes.obstacles, &shapes.obstacle_rounding}}) {
        if (!roundings->empty() && roundings->size() != polygons->size())
            return RangeFault{kind, -1, std::to_string(roundings->size()) + " radii for " + std::to_string(polygons->size()) +
                                            " polygons; give one for each, or none"};
        for (std::size_t k = 0; k < polygons->size(); ++k)
            if (auto wrong = fault(kind, static_cast<Index>(k), *(*polygons)[k], rounding_of(*roundings, k).radius))
                return wrong;
    }
    return shapes.workspace ? fault("workspace", -1, *shapes.workspace, {}) : std::nullopt;
}

// Use one after the other, until `use` returns false.
template <class Use>
void for_each_extreme(const SceneShapes& shapes, Use use) {
    const auto add = [&](const char* kind, Index index, const Polygon& polygon) {
        Int widest = polygon.vertices.X(0);
        for (Index k = 0; k < polygon.vertices.size(); ++k)
            for (const Int& c : {polygon.vertices.X(k), polygon.vertices.Y(k)})
                if (abs(c) > abs(widest)) widest = c;
        return use(Extreme{kind, index, std::move(widest), polygon.denominator});
    };
    const auto add_radii = [&](const char* kind, std::size_t index, const std::vector<Rounding>& all) {
        if (all.empty()) return true;
        const auto at = static_cast<Index>(index);
        const auto add_radius = [&](const Ratio& radius) { return radius.n.is_zero() || use(Extreme{kind, at, radius.n, radius.d, true}); };
        if (!add_radius(all[index].radius)) return false;
        for (const Arc& arc : all[index].arcs) {
            if (!add_radius(arc.radius)) return false;
            for (const Ratio* c : {&arc.centre.x, &arc.centre.y})
                if (!use(Extreme{kind, at, c->n, c->d})) return false;
        }
        return true;
    };
    for (const auto& [kind, polygons, roundings] : {std::tuple{"robot", &shapes.robot, &shapes.robot_rounding},
                                                    {"obstacles", &shapes.obstacles, &shapes.obstacle_rounding}})
        for (std::size_t k = 0; k < polygons->size(); ++k)
            if (!add_radii(kind, k, *roundings) || !add(kind, static_cast<Index>(k), *(*polygons)[k])) return;
    if (shapes.workspace && !add("workspace", -1, *shapes.workspace)) return;
    for (std::size_t k = 0; shapes.bounds && k < 4; ++k) {
        const Ratio& bound = (*shapes.bounds)[k];
        if (!use(Extreme{"bounds", static_cast<Index>(k), bound.n, bound.d})) return;
    }
}

}  // namespace

std::optional<RangeFault> range_fault(const SceneShapes& shapes) {
    static const Int largest = boost::multiprecision::pow(Int(10), 150);
    if (auto wrong = radius_fault(shapes)) return wrong;
    Int widest = 0, widest_denominator = 1, scale = 1;
    std::optional<Extreme> finest;
    std::optional<RangeFault> too_far;
    for_each_extreme(shapes, [&](const Extreme& next) {
        const Int size = abs(next.value);
        if (size > largest * next.denominator) {
            too_far = RangeFault{std::string(next.kind), next.index, (next.is_radius ? "the radius " : "the coordinate ") +
                                                                         shown(floor_divide(next.value, next.denominator)) +
                                                                         " is larger than 1e150; scale the scene"};
            return false;
        }
        if (size * widest_denominator > widest * next.denominator) widest = size, widest_denominator = next.denominator;
        if (!finest || next.denominator > finest->denominator ||
            (next.denominator == finest->denominator && std::pair(next.kind, next.index) > std::pair(finest->kind, finest->index)))
            finest = next;
        if (scale % next.denominator != 0) scale = lcm(scale, next.denominator);
        return bits(scale) <= most_bits;
    });
    if (too_far) return too_far;
    const unsigned needed = std::max(bits(widest * scale / widest_denominator), bits(scale));
    if (needed <= most_bits) return {};
    return RangeFault{std::string(finest->kind), finest->index,
                      (finest->is_radius ? "with the denominator " + shown(finest->denominator) + " of its radius, "
                                         : "with its denominator " + shown(finest->denominator) + " ") +
                          "the scene's coordinates, over one common denominator, are integers of " + grouped(needed) +
                          " bits or more, and " + grouped(most_bits) +
                          " are allowed; keep lengths between 1e-150 and 1e150, in decimals or in few denominators"};
}

}  // namespace cfree

// Words to numbers, without rounding.
#include "reading.hpp"

#include <cmath>
#include <numbers>

#include "cfree/scene/coordinate_range.hpp"
#include "cfree/support/elementary.hpp"

namespace cfree {

namespace {

class Words {
public:
    explicit Words(std::string_view of) : rest(of) { next(); }
    std::string_view word() const { return current; }
    bool ended() const { return current.empty(); }
    void next() {
        const auto begin = rest.find_first_not_of(" \n");
        if (begin == rest.npos) {
            rest = current = {};
            return;
        }
        const auto end = std::min(rest.find_first_of(" \n", begin), rest.size());
        current = rest.substr(begin, end - begin);
        rest.remove_prefix(end);
    }
    Ratio number() {
        const auto value = ratio_of(current);
        if (!value) throw std::invalid_argument("expected a number or \"p/q\", got \"" + std::string(current.substr(0, 60)) + "\"");
        next();
        return *value;
    }

private:
    std::string_view rest, current;
};

bool begins_part(std::string_view word) {
    return word == "robot" || word == "obstacle" || word == "workspace" || word == "bounds" || word == "clearance";
}

RatioPoint point_of(Words& words) {
    Ratio x = words.number();
    return {std::move(x), words.number()};
}

bool begins_ring(std::string_view word) { return word == "ring" || word == "path" || word == "circle" || word == "grown"; }

// The second radius of an arc: the same length across the first, or it is that of an ellipse.
void refuse_ellipse(Words& words, const GivenCurve& arc) {
    words.next();
    const RatioPoint v = point_of(words);
    const Ratio ux = arc.start.x - arc.center.x, uy = arc.start.y - arc.center.y;
    if (ux * v.x + uy * v.y != Ratio{0, 1} || ux * ux + uy * uy != v.x * v.x + v.y * v.y)
        throw std::invalid_argument("an arc of an ellipse: the page takes lines and circular arcs; `cfree convert` with --outer writes polygons around others");
}

// "x y" is the end of a line, "arc x y about x y left" or ".. right" or "arc x y through x y" that of an arc. The ends are listed, too.
std::vector<GivenCurve> path_of(Words& words, RatioRing& ends, bool& has_arcs) {
    std::vector<GivenCurve> curves;
    const auto has_ended = [&] { return words.ended() || begins_part(words.word()) || begins_ring(words.word()); };
    if (has_ended()) return curves;
    const RatioPoint first = point_of(words);
    RatioPoint from = first;
    for (ends.push_back(first); !has_ended(); ends.push_back(from)) {
        const bool is_arc = words.word() == "arc";
        if (is_arc) words.next();
        const RatioPoint to = point_of(words);
        if (is_arc) {
            has_arcs = true;
            const bool is_through = words.word() == "through";
            words.next();
            const RatioPoint point = point_of(words);
            if (is_through) curves.push_back(arc_through(from, point, to));
            else {
                curves.push_back(arc_about(from, point, to, words.word() == "right"));
                words.next();
                if (words.word() == "conjugate") refuse_ellipse(words, curves.back());
            }
        } else if (to != from) curves.push_back({from, to});
        from = to;
    }
    if (from != first) curves.push_back({from, first});
    return curves;
}

GivenShape shape_of(Words& words, const std::string& name) try {
    GivenShape shape;
    std::vector<RatioRing> rings;
    bool has_arcs = false;
    while (!words.ended() && !begins_part(words.word())) {
        const auto kind = words.word();
        words.next();
        if (kind == "ring" || kind == "path") shape.rings.push_back(path_of(words, rings.emplace_back(), has_arcs)), shape.is_round |= kind == "path";
        else if (kind == "circle") {
            const RatioPoint center = point_of(words);
            shape.rings.push_back(circle_about(center, words.number()));
            shape.is_round = has_arcs = true;
        } else if (kind == "grown") {
            shape.grown = words.number(), shape.is_round = true;
            if (shape.grown < Ratio{0, 1}) throw std::invalid_argument("grown: give a length, 0 or more");
            if (has_arcs && shape.grown != Ratio{0, 1}) throw std::invalid_argument("grown: of polygons only; give the larger circle, or a path of points");
            if (name == "workspace" && shape.grown != Ratio{0, 1}) throw std::invalid_argument("grown: of robots and obstacles only");
        } else throw std::invalid_argument("no ring: " + std::string(kind.substr(0, 60)));
    }
    if (has_arcs) return shape;
    shape.polygon = std::make_shared<const Polygon>(std::move(rings));
    return shape;
} catch (const std::invalid_argument& error) {
    throw std::invalid_argument(name + ": " + error.what());
}

RationalPose pose_of(Words& words) {
    RationalPose pose;
    pose.x = words.number(), pose.y = words.number();
    if (words.word() == "inf") {
        words.next();
        pose.half = {0, 1};
        return pose;
    }
    const Ratio tau = words.number();
    pose.half = {tau.d, tau.n};
    return pose;
}

}  // namespace

GivenScene scene_of(std::string_view text) {
    GivenScene shapes;
    for (Words words(text); !words.ended();) {
        const auto kind = words.word();
        words.next();
        if (kind == "robot") shapes.robot.push_back(shape_of(words, "robot"));
        else if (kind == "obstacle") shapes.obstacles.push_back(shape_of(words, "obstacle " + std::to_string(shapes.obstacles.size())));
        else if (kind == "workspace") shapes.workspace = shape_of(words, "workspace");
        else if (kind == "bounds") {
            shapes.bounds.emplace();
            for (Ratio& x : *shapes.bounds) x = words.number();
            const auto& [x0, y0, x1, y1] = *shapes.bounds;
            if (!(x0 < x1 && y0 < y1)) throw std::invalid_argument("bounds: give xmin < xmax and ymin < ymax");
        } else if (kind == "clearance") {
            shapes.clearance = words.number();
            if (shapes.clearance < Ratio{0, 1}) throw std::invalid_argument("clearance: give a length, 0 or more");
        } else throw std::invalid_argument("no part of a scene: " + std::string(kind.substr(0, 60)));
    }
    if (shapes.robot.empty()) throw std::invalid_argument("the robot is empty; give at least one polygon");
    return shapes;
}

void refuse_range(const SceneShapes& shapes) {
    if (const auto fault = range_fault(shapes))
        throw std::invalid_argument(fault->kind + (fault->index < 0 ? "" : " " + std::to_string(fault->index)) + ": " + fault->message);
}

RationalPose pose_of(std::string_view text) {
    Words words(text);
    return pose_of(words);
}

GivenVehicle vehicle_of(std::string_view text) {
    Words words(text);
    const auto kind = words.word();
    if (kind != "car" && kind != "differential") throw std::invalid_argument("no vehicle: " + std::string(kind.substr(0, 60)));
    words.next();
    GivenVehicle vehicle{kind == "differential", true, {0, 1}, {0, 1}, {0, 1}, {0, 1}, {}};
    if (!vehicle.turns_in_place) {
        vehicle.left = words.number(), vehicle.right = words.number();
        if (!(Ratio{0, 1} < vehicle.left && Ratio{0, 1} < vehicle.right)) throw std::invalid_argument("turning radius: give a length above 0");
    }
    const RationalPose axle = pose_of(words);
    vehicle.x = axle.x, vehicle.y = axle.y, vehicle.heading = axle.half;
    vehicle.reverses = words.word() != "forward";
    return vehicle;
}

Wishes wishes_of(std::string_view text) {
    Words words(text);
    Wishes wishes;
    if (words.ended()) return wishes;
    wishes.is_clear = words.word() == "clear";
    words.next();
    for (double* factor : {&wishes.sideways, &wishes.backward, &wishes.turning}) {
        const Ratio value = words.number();
        *factor = nearest(value.n, value.d);
        if (!(*factor >= 1)) throw std::invalid_argument("preferences: give factors of 1 or more");
    }
    return wishes;
}

std::string words_of(const RationalPose& pose) {
    const auto& [q, p] = pose.half;
    return text_of(pose.x) + " " + text_of(pose.y) + " " + (q.is_zero() ? "inf" : text_of(reduced(p, q)));
}

HalfAngle half_angle_of(double theta, bool fine) {
    constexpr double right = 0.5 * std::numbers::pi, rest_of_right = 6.123233995736766e-17;
    const double turns = std::nearbyint(theta / right);
    const double rest = theta - turns * right - turns * rest_of_right;
    Ratio tau{0, 1};
    if (std::abs(rest) > std::abs(theta) * 0x1p-52) {
        const double value = tangent(0.5 * rest), margin = fine ? std::abs(value) * 0x1p-53 : 0x1p-21;
        tau = simplest_between(ratio_of(value - margin), ratio_of(value + margin));
    }
    Int q = tau.d, p = tau.n;
    for (int k = static_cast<int>(std::fmod(turns, 4) + 4) % 4; k > 0; --k) {  // turns by a right angle: (1, 1) times it
        const Int x = q - p, y = q + p;
        q = x, p = y;
    }
    const Int common = gcd(q, p);
    q /= common, p /= common;
    if (q < 0 || (q.is_zero() && p < 0)) q = -q, p = -p;
    return {q, p};
}

}  // namespace cfree

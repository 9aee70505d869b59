// JSON of answers: exact numbers, and beside them doubles, which are as near as the format asks for.
#include "answers.hpp"

#include <numbers>
#include <set>
#include <tuple>

#include "cfree/support/elementary.hpp"

namespace cfree {

namespace {

using Rational = std::array<Ratio, 2>;

std::string quoted(const std::string& text) { return '"' + text + '"'; }
std::string quoted(const Ratio& x) { return quoted(text_of(x)); }
std::string decimal(double x) { return text_of(x); }
template <class List, class Text>
std::string listed(const List& items, const Text& text, const char* between = ", ") {
    std::string all;
    for (const auto& item : items) all += (all.empty() ? "" : between) + text(item);
    return '[' + all + ']';
}
std::string exact(const Ratio& x, const Ratio& y) { return listed(std::array{x, y}, [](const Ratio& c) { return quoted(c); }); }
std::string decimals(double x, double y) { return listed(std::array{x, y}, decimal); }
std::string decimals(const Place& p) { return listed(std::array{p.x, p.y, p.theta}, decimal); }
std::string tau_of(const HalfAngle& half) { return quoted(half.q.is_zero() ? "inf" : text_of(reduced(half.p, half.q))); }
std::string exact(const RationalPose& q) {
    return '[' + quoted(q.x) + ", " + quoted(q.y) + ", {\"tau\": " + tau_of(q.half) + "}]";
}

std::vector<Rational> ring(const Polygon& polygon, std::size_t r) {
    std::vector<Rational> points;
    for (Index k = polygon.offsets[r]; k < polygon.offsets[r + 1]; ++k)
        points.push_back({reduced(polygon.vertices.X(k), polygon.denominator), reduced(polygon.vertices.Y(k), polygon.denominator)});
    return points;
}

// The square root, exact if it is rational, else rounded up as in src/cfree/curves/pieces.py.
Ratio root_above(const Ratio& square) {
    const Int n = sqrt(square.n), d = sqrt(square.d);
    if (n * n == square.n && d * d == square.d) return reduced(n, d);
    const auto bits = [](const Int& x) { return x.is_zero() ? 0 : static_cast<int>(msb(x)) + 1; };
    const int half = 60 + std::max(0, bits(square.d) - bits(square.n));
    return reduced(sqrt(Int((square.n << static_cast<unsigned>(2 * half)) / square.d)) + 1, Int(1) << static_cast<unsigned>(half));
}

// Greatest coordinate of a quarter turn of an arc, on an axis or, for sign -1, against it; irrational ones rounded up.
Ratio greatest(const GivenCurve& arc, const Ratio RatioPoint::*axis, int sign) {
    const auto signed_of = [&](const Ratio& c) { return Ratio{c.n * sign, c.d}; };
    const Ratio a = signed_of(arc.start.*axis - arc.center.*axis), b = signed_of(arc.end.*axis - arc.center.*axis);
    const RatioPoint u{arc.start.x - arc.center.x, arc.start.y - arc.center.y}, w{arc.end.x - arc.center.x, arc.end.y - arc.center.y};
    const auto rising = [&](const RatioPoint& p) {  // the derivative along the arc
        return Int((axis == &RatioPoint::x ? Int(-p.y.n) : p.x.n) * sign * arc.turn);
    };
    Ratio most = std::max(a, b);
    if (rising(u) > 0 && rising(w) < 0) most = root_above(u.x * u.x + u.y * u.y);
    return signed_of(arc.center.*axis) + most;
}

std::string text_of(const GivenCurve& curve) {
    const auto point = [](const RatioPoint& p) { return ' ' + text_of(p.x) + ' ' + text_of(p.y); };
    if (curve.turn == 0) return " line" + point(curve.end);
    const RatioPoint u{curve.start.x - curve.center.x, curve.start.y - curve.center.y};
    const RatioPoint v = curve.turn > 0 ? RatioPoint{-u.y, u.x} : RatioPoint{u.y, -u.x};
    return " arc" + point(curve.center) + point(u) + point(v) + ' ' + std::to_string(curve.quarters) + ' ' + text_of(curve.rest);
}

// The text that identifies a scene, as in src/cfree/scene/digest.py.
class SceneWriter {
public:
    std::string text = "cfree scene 1\n";
    void add(const char* word, const Polygon& polygon) {
        text += std::string(word) + '\n';
        for (std::size_t r = 0; r + 1 < polygon.offsets.size(); ++r) {
            text += r ? "hole" : "outer";
            for (const auto& [x, y] : ring(polygon, r)) text += ' ' + text_of(x) + ' ' + text_of(y);
            text += '\n';
        }
    }
    void add(const char* word, const GivenShape& shape) {
        if (!shape.is_round) return add(word, *shape.polygon);
        text += std::string(word) + '\n';
        for (std::size_t r = 0; r < shape.rings.size(); ++r) {
            text += r ? "hole" : "outer";
            for (const auto& curve : shape.rings[r]) text += text_of(curve);
            text += '\n';
        }
        if (!shape.grown.n.is_zero()) text += "grown " + text_of(shape.grown) + '\n';
    }
    void add(const std::optional<std::array<Ratio, 4>>& bounds) {
        if (!bounds) return;
        text += "bounds";
        for (const Ratio& x : *bounds) text += ' ' + text_of(x);
        text += '\n';
    }
};

std::string scene_text(const SceneShapes& shapes) {
    SceneWriter writer;
    for (const auto& part : shapes.robot) writer.add("robot", *part);
    for (const auto& obstacle : shapes.obstacles) writer.add("obstacle", *obstacle);
    if (shapes.workspace) writer.add("workspace", *shapes.workspace);
    writer.add(shapes.bounds);
    return writer.text;
}

std::string scene_text(const GivenScene& scene) {
    SceneWriter writer;
    for (const auto& part : scene.robot) writer.add("robot", part);
    for (const auto& obstacle : scene.obstacles) writer.add("obstacle", obstacle);
    if (scene.workspace) writer.add("workspace", *scene.workspace);
    writer.add(scene.bounds);
    return writer.text;
}

// The box around a robot.
class Around {
public:
    std::optional<std::array<Ratio, 4>> box;
    void add(const Ratio& x0, const Ratio& y0, const Ratio& x1, const Ratio& y1) {
        if (!box) box = {x0, y0, x1, y1};
        auto& [a, b, c, d] = *box;
        a = std::min(a, x0), b = std::min(b, y0), c = std::max(c, x1), d = std::max(d, y1);
    }
};

std::array<Ratio, 4> box_of(const World& world) {
    Around all;
    if (world.rounds)
        for (const auto& part : world.rounds->asked.robot) {
            const Ratio& r = part.grown;
            const auto add = [&](const RatioPoint& p) { all.add(p.x - r, p.y - r, p.x + r, p.y + r); };
            for (const auto& curve : part.rings.front()) {
                add(curve.start), add(curve.end);
                if (curve.turn != 0)
                    for (const auto& arc : quarters_of(curve))
                        all.add(-greatest(arc, &RatioPoint::x, -1), -greatest(arc, &RatioPoint::y, -1), greatest(arc, &RatioPoint::x, 1), greatest(arc, &RatioPoint::y, 1));
            }
        }
    else
        for (const auto& part : world.shapes.robot)
            for (const auto& [x, y] : ring(*part, 0)) all.add(x, y, x, y);
    return *all.box;
}

std::string head(const World& world, const char* kind, const RationalPose& start, const RationalPose& goal) {
    return std::string("{\"version\": 1,\n \"answer\": ") + quoted(kind) + ",\n \"scene\": {\"sha256\": \"{sha256}\", \"robot\": " +
           listed(box_of(world), [](const Ratio& x) { return quoted(x); }) + "},\n \"start\": " + decimals(start.place()) + ",\n \"goal\": " +
           decimals(goal.place()) + ",\n \"exact\": {\"start\": " + exact(start) + ", \"goal\": " + exact(goal) + "}";
}

// The clearance of an answer, if it has one.
std::string clearance_text(const World& world) {
    return world.rounds && world.rounds->asked.clearance.n > 0 ? ",\n \"clearance\": " + quoted(world.rounds->asked.clearance) : "";
}

std::string vehicle_text(const GivenVehicle& vehicle) {
    const std::string axle = "\"axle\": " + exact(vehicle.x, vehicle.y) + ", \"heading\": {\"tau\": " + tau_of(vehicle.heading) + "}";
    if (vehicle.turns_in_place) return "{\"type\": \"differential\", " + axle + "}";
    return "{\"type\": \"car\", \"turning_radius\": " + exact(vehicle.left, vehicle.right) + ", " + axle +
           (vehicle.reverses ? "}" : ", \"gears\": \"forward\"}");
}

std::string pair_text(Index a, Index b) { return '[' + std::to_string(a) + ", " + std::to_string(b) + ']'; }
std::string contact_text(const SceneFeatures& features, const Feature& f) {
    const auto i = static_cast<std::size_t>(f.robot), j = static_cast<std::size_t>(f.obstacle);
    const char* kind = f.kind == Kind::vertex_edge ? "vertex-edge" : f.kind == Kind::edge_vertex ? "edge-vertex" : "vertex-vertex";
    return std::string("{\"kind\": ") + quoted(kind) + ", \"robot\": " + pair_text(features.robot.polygon[i], features.robot.vertex[i]) +
           ", \"obstacle\": " + pair_text(features.obstacles.polygon[j], features.obstacles.vertex[j]) +
           (f.kind == Kind::vertex_vertex ? ", \"quadrant\": " + std::to_string(f.branch) : "") + "}";
}

// Motion from one pose to the next; theta is counted on.
std::string motion(const RationalPose& a, const RationalPose& b, double& theta) {
    const Ratio dx = b.x - a.x, dy = b.y - a.y;
    const auto to = [&] { return "\"to\": " + decimals({nearest(b.x.n, b.x.d), nearest(b.y.n, b.y.d), theta}); };
    if (a.half == b.half)
        return "{\"type\": \"translation\", \"vector\": " + decimals(nearest(dx.n, dx.d), nearest(dy.n, dy.d)) + ", " + to() +
               ", \"exact\": {\"vector\": " + exact(dx, dy) + "}}";
    // the pole is (a + b + (-dy, dx) / t) / 2, t the tangent of half the turn
    const HalfAngle turn = HalfAngle::along(a.half.q * b.half.q + a.half.p * b.half.p, a.half.q * b.half.p - a.half.p * b.half.q);
    const Ratio cot = reduced(turn.q, turn.p), half{1, 2};
    const Ratio x = half * (a.x + b.x - cot * dy), y = half * (a.y + b.y + cot * dx);
    const double angle = turn.q.is_zero() ? std::numbers::pi : 2 * arc_tangent(nearest(turn.p, turn.q));  // small ones keep their digits
    theta += angle;
    return "{\"type\": \"rotation\", \"pole\": " + decimals(nearest(x.n, x.d), nearest(y.n, y.d)) + ", \"angle\": " + decimal(angle) + ", " + to() +
           ", \"exact\": {\"pole\": " + exact(x, y) + ", \"tau\": " + tau_of(turn) + "}}";
}

// The way back: t = (r + tau) / (1 - r tau), and r goes from 0 to -tau.
ContactSlide reversed(const ContactSlide& s) {
    const Int &m = s.tau.d, &n = s.tau.n;
    const auto at_end = [&](const std::array<Int, 5>& f) { return f[0] * m * m * m * m + f[1] * n * m * m * m + f[2] * n * n * m * m + f[3] * n * n * n * m + f[4] * n * n * n * n; };
    const auto of_r = [&](const std::array<Int, 5>& f) {
        std::array<Int, 5> sum{};
        for (std::size_t k = 0; k < 5; ++k) {
            std::array<Int, 5> term{f[k]};
            for (std::size_t i = 0; i < 4; ++i) {
                const bool above = i < k;  // times m r + n, or m - n r
                for (std::size_t j = 5; j-- > 0;) term[j] = Int(term[j] * (above ? n : m)) + (j ? Int(term[j - 1] * (above ? m : Int(-n))) : Int(0));
            }
            for (std::size_t j = 0; j < 5; ++j) sum[j] += term[j];
        }
        return sum;
    };
    const Int x = at_end(s.x), y = at_end(s.y), d = at_end(s.d);
    ContactSlide back{s.to, s.from, s.contacts, of_r(s.x), of_r(s.y), of_r(s.d), reduced(Int(-n), m)};
    for (std::size_t j = 0; j < 5; ++j) {
        back.x[j] = Int(back.x[j] * d) - Int(back.d[j] * x), back.y[j] = Int(back.y[j] * d) - Int(back.d[j] * y);
        back.d[j] *= d;
    }
    return back;
}

std::string motion(const SceneFeatures& features, const ContactSlide& s, double& theta) {
    const double angle = 2 * arc_tangent(nearest(s.tau.n, s.tau.d));
    theta += angle;
    const auto contact = [&](const Feature& f) { return contact_text(features, f); };
    const auto terms = [&](const std::array<Int, 5>& of) { return listed(of, [&](const Int& c) { return quoted(reduced(c, s.d[0])); }); };
    const Place to = s.to.place();
    const Ratio dx = s.to.x - s.from.x, dy = s.to.y - s.from.y;
    return "{\"type\": \"slide\", \"contacts\": " + listed(s.contacts, contact) + ", \"vector\": " + decimals(nearest(dx.n, dx.d), nearest(dy.n, dy.d)) +
           ", \"angle\": " + decimal(angle) + ", \"to\": " + decimals({to.x, to.y, theta}) + ", \"exact\": {\"x\": " + terms(s.x) + ", \"y\": " +
           terms(s.y) + ", \"d\": " + terms(s.d) + ", \"tau\": " + quoted(s.tau) + "}}";
}

// A polygon, or the points of a thin one, without the end of the object.
std::string begun_text(const Polygon& polygon) {
    const auto points = [](const std::vector<Rational>& of) { return listed(of, [](const Rational& p) { return exact(p[0], p[1]); }); };
    if (polygon.is_thin()) return "{\"points\": " + points(ring(polygon, 0));
    std::string holes;
    for (std::size_t r = 1; r + 1 < polygon.offsets.size(); ++r) holes += (r > 1 ? ", " : "") + points(ring(polygon, r));
    return "{\"outer\": " + points(ring(polygon, 0)) + (holes.empty() ? "" : ", \"holes\": [" + holes + "]");
}
std::string polygon_text(const Polygon& polygon) { return begun_text(polygon) + "}"; }

// The grown cores that a proof is about.
std::string cores_text(const SceneShapes& shapes) {
    const auto grown = [](const Polygon& core, const Ratio& radius) { return begun_text(core) + ", \"radius\": " + quoted(radius) + "}"; };
    const auto all = [&](const auto& cores, const std::vector<Rounding>& rounding) {
        std::string text;
        for (std::size_t k = 0; k < cores.size(); ++k) text += (k ? ", " : "") + grown(*cores[k], rounding_of(rounding, k).radius);
        return "[" + text + "]";
    };
    return "{\"robot\": " + all(shapes.robot, shapes.robot_rounding) + ", \"obstacles\": " + all(shapes.obstacles, shapes.obstacle_rounding) + "}";
}

// The scene of polygons that a proof is about.
std::string polygons_text(const SceneShapes& shapes) {
    const auto all = [](const auto& polygons) { return listed(polygons, [](const auto& polygon) { return polygon_text(*polygon); }); };
    std::string text = "{\"robot\": " + all(shapes.robot) + ", \"obstacles\": " + all(shapes.obstacles);
    if (shapes.workspace) text += ", \"workspace\": " + polygon_text(*shapes.workspace);
    if (shapes.bounds) text += ", \"bounds\": " + listed(*shapes.bounds, [](const Ratio& x) { return quoted(x); });
    return text + "}";
}

// Kind, features and, if it is not 0, the branch.
std::string name(std::uint64_t code) {
    const Feature f = unpacked(code);
    std::vector<int> parts{static_cast<int>(f.kind), f.robot, f.obstacle};
    if (f.branch != 0) parts.push_back(f.branch & 3);
    return listed(parts, [](int k) { return std::to_string(k); });
}

std::string piece(const SceneFeatures& features, const Boundary& boundary, Index face) {
    const Trapezoids& t = boundary.trapezoids;
    const auto k = static_cast<std::size_t>(face);
    const auto end = [&](std::uint64_t first, std::uint64_t second, double lo, double hi, int place) {
        std::string names = first ? name(first) : "";
        if (second) names += (names.empty() ? "" : ", ") + name(second);
        return "{\"names\": [" + names + "], \"tau\": " + decimals(lo, hi) + (place ? ", \"place\": " + std::to_string(place) : "") + "}";
    };
    return "  {\"contact\": " + contact_text(features, boundary.patches.contact(t.patch[k])) + ", \"chart\": " + std::to_string(t.chart[k]) + ", \"from\": " +
           end(t.from_first[k], t.from_second[k], t.from_lo[k], t.from_hi[k], t.from_place[k]) + ", \"to\": " +
           end(t.to_first[k], t.to_second[k], t.to_lo[k], t.to_hi[k], t.to_place[k]) + ", \"lower\": " + name(t.lower[k]) + ", \"upper\": " +
           name(t.upper[k]) + "}";
}

// Points and lines that names use and no polygon has: diagonals of convex pieces, corners beyond the bounds.
std::vector<std::string> auxiliary(const SceneFeatures& features, const Boundary& boundary, const std::vector<Index>& faces) {
    std::set<std::tuple<bool, bool, Index>> used;  // obstacle or not, edge or not, number
    const Trapezoids& t = boundary.trapezoids;
    const auto is_owned = [](const Owners& of, Index k) { return static_cast<std::size_t>(k) < of.vertex.size() && of.vertex[static_cast<std::size_t>(k)] >= 0; };
    for (const Index face : faces) {
        const auto k = static_cast<std::size_t>(face);
        for (const std::uint64_t code : {t.lower[k], t.upper[k], t.from_first[k], t.from_second[k], t.to_first[k], t.to_second[k]}) {
            if (!code) continue;
            const Feature f = unpacked(code);
            if (!is_owned(features.robot, f.robot)) used.insert({false, f.kind != Kind::vertex_edge && f.kind != Kind::vertex_vertex, f.robot});
            if (!is_owned(features.obstacles, f.obstacle)) used.insert({true, f.kind != Kind::edge_vertex && f.kind != Kind::vertex_vertex, f.obstacle});
        }
    }
    std::vector<std::string> found;
    for (const auto& [of_obstacles, is_edge, number] : used) {
        const Shape& shape = of_obstacles ? features.scene->obstacles : features.scene->robot;
        const auto point = [&](Index v) { return exact(reduced(shape.X[v], features.scene->scale), reduced(shape.Y[v], features.scene->scale)); };
        const std::string points = is_edge ? point(shape.v[number]) + ", " + point(shape.w[number]) : point(number);
        found.push_back(std::string("{\"of\": ") + quoted(of_obstacles ? "obstacles" : "robot") + ", \"kind\": " + quoted(is_edge ? "edge" : "vertex") +
                        ", \"number\": " + std::to_string(number) + ", \"points\": [" + points + "]}");
    }
    return found;
}

std::string separation_text(const World& world, const World::Answer& answer, const Separation& proof) {
    const SceneFeatures& features = *proof.of->features;
    const Boundary& boundary = *proof.surface.boundary;
    std::set<Index> obstacles;
    for (const Index face : proof.surface.faces)
        obstacles.insert(features.obstacles.polygon[static_cast<std::size_t>(boundary.patches.contact(boundary.trapezoids.patch[static_cast<std::size_t>(face)]).obstacle)]);
    const auto same = [](const std::string& text) { return text; };
    const bool is_rounded = proof.of->scene().is_round;
    const std::string clearance = clearance_text(world);
    if (!clearance.empty() && !is_rounded) throw std::invalid_argument("the page does not save this proof about a clearance; `cfree plan --clearance` writes one");
    std::string text = head(world, "separated", answer.start, answer.goal) +
                       (world.proved && !is_rounded ? ",\n \"polygons\": " + polygons_text(world.proved->shapes) : "") +
                       ",\n \"of\": " + quoted(proof.is_closed ? "closed" : "interior") +
                       ",\n \"obstacles\": " + listed(obstacles, [](Index k) { return std::to_string(k); });
    const SceneShapes& smaller = proof.of->shapes();
    if (is_rounded) text += ",\n \"rounded\": " + cores_text(smaller);
    else if (proof.is_closed) text += ",\n \"smaller_robot\": " + listed(smaller.robot, [](const auto& part) { return polygon_text(*part); });
    if (proof.is_closed && smaller.bounds) text += ",\n \"larger_bounds\": " + listed(*smaller.bounds, [](const Ratio& x) { return quoted(x); });
    text += clearance;
    if (const auto more = auxiliary(features, boundary, proof.surface.faces); !is_rounded && !more.empty()) text += ",\n \"auxiliary\": " + listed(more, same);
    return text + ",\n \"surface\": " + listed(proof.surface.faces, [&](Index face) { return piece(features, boundary, face); }, ",\n") + "}\n";
}

}  // namespace

void write_answer(const World& world, Reply& reply) {
    if (!world.answer) throw std::invalid_argument("there is no answer yet");
    const World::Answer& answer = *world.answer;
    reply.text("scene", world.rounds ? scene_text(world.rounds->asked) : scene_text(world.shapes));
    if (const auto* proof = std::get_if<Separation>(&answer.found)) return reply.text("answer", separation_text(world, answer, *proof));
    const Poses& way = std::get<Poses>(answer.found);
    std::vector<std::string> motions;
    double theta = way.front().place().theta;
    for (std::size_t k = 1; k < way.size(); ++k) {
        const auto [slide, is_back] = slide_between(answer.slides, way[k - 1], way[k]);
        motions.push_back(slide ? motion(world.features, is_back ? reversed(*slide) : *slide, theta) : motion(way[k - 1], way[k], theta));
    }
    reply.text("answer", head(world, "path", way.front(), way.back()) +
                             (answer.vehicle ? ",\n \"vehicle\": " + vehicle_text(*answer.vehicle) : "") + clearance_text(world) + ",\n \"decimals\": \"approximate\",\n \"motions\": " +
                             listed(motions, [](const std::string& text) { return "\n  " + text; }, ",") + "}\n");
}

}  // namespace cfree

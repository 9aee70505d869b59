// Decisions whether poses and motions are free. Motions are integers; see motion_checker.hpp.
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <numbers>

#include "arrays.hpp"
#include "cfree/arcs/motion_checker.hpp"
#include "cfree/collision/edge_distances.hpp"
#include "cfree/collision/motion_checker.hpp"
#include "cfree/polygons/polygon.hpp"
#include "cfree/support/elementary.hpp"
#include "given_motions.hpp"
#include "given_poses.hpp"
#include "watched.hpp"

using namespace nb::literals;
using cfree::Int, cfree::MotionChecker, cfree::PoseChecker;

static void check(const PoseChecker& c, const In<double, 2>& poses, int threads, const Out<std::uint8_t, 1>& out) {
    require(poses.shape(1) == 3 && out.shape(0) == poses.shape(0), "poses must have three columns and as many rows as out");
    watched([&] { c.check(poses.data(), poses.shape(0), threads, reinterpret_cast<cfree::Verdict*>(out.data())); });
}

// True or False for a `Pose`, or for x, y and theta in doubles; a list of that for a table of one such row. None for other
// tuples and lists, and for a `Pose` that doubles leave open and that is not known to be within the limits. Angles of rows
// are brought to [0, 2 pi) in doubles, as those of `Poses` are.
static nb::object is_free(const PoseChecker& c, nb::handle poses, bool is_within) {
    if (length(poses) < 0) return nb::cast(c.is_free(pose_of(poses), is_within));
    const bool is_table = length(poses) == 1;
    const auto given = doubles_of(is_table ? item(poses, 0) : poses);
    if (!given) return nb::none();
    auto [x, y, theta] = *given;
    constexpr double turn = 2 * std::numbers::pi;
    if (is_table && !(0 <= theta && theta < turn)) {
        theta = std::fmod(theta, turn);
        if (theta < 0) theta += turn;
        if (!(theta < turn)) theta = 0;
    }
    const auto found = c.is_free(x, y, theta);
    if (!found) return nb::none();
    const nb::bool_ verdict(*found);
    if (!is_table) return verdict;
    nb::list one;
    one.append(verdict);
    return one;
}

// c, s, w, x, y, unit; vx, vy; start, q, p
using MotionIntegers = std::array<nb::int_, 11>;

static cfree::Motion motion(bool turns, const MotionIntegers& n) {
    const auto at = [&](int k) { return integer(n[static_cast<std::size_t>(k)]); };
    return {at(0), at(1), at(2), at(3), at(4), at(5), turns, at(6), at(7), at(8), at(9), at(10)};
}

// A `Translation` or a `Rotation` from a pose, in doubles or as a `Pose`: is it free? None for other poses.
static std::optional<bool> is_motion_free(const MotionChecker& checker, nb::handle from, nb::handle motion, bool turns) {
    const auto m = given_motion(checker.scene->scale, from, motion, turns);
    if (!m) return {};
    return !checker.begins_outside(*m) && checker.is_free(*m);
}

// c, s, w, q, p; and five coefficients each of x, y, d
using SlideIntegers = std::array<nb::int_, 20>;

static cfree::Slide slide(const SlideIntegers& n) {
    const auto at = [&](int k) { return integer(n[static_cast<std::size_t>(k)]); };
    const auto five = [&](int k) { return std::array<cfree::Int, 5>{at(k), at(k + 1), at(k + 2), at(k + 3), at(k + 4)}; };
    return {at(0), at(1), at(2), at(3), at(4), five(5), five(10), five(15)};
}

// The polynomial that grows through zero; pieces of the robot and the obstacles; kind, robot and obstacle feature.
using Collision = std::tuple<std::vector<nb::int_>, int, int, int, int, int>;

static std::optional<Collision> first_collision(const MotionChecker& checker, bool turns, const MotionIntegers& numbers) {
    const auto found = checker.first_collision(motion(turns, numbers));
    if (!found) return {};
    return Collision{integers(found->at.p), found->robot_piece, found->obstacle_piece, found->kind, found->robot, found->obstacle};
}

using cfree::EdgeDistances;

static double rounded(const cfree::Ratio& x) { return cfree::nearest(x.n, x.d); }

// The edges of polygons, rounded.
static std::vector<EdgeDistances::Segment> segments_of(const std::vector<const cfree::Polygon*>& polygons) {
    std::vector<EdgeDistances::Segment> segments;
    for (const cfree::Polygon* p : polygons) {
        const auto end = [&](cfree::Index k) -> std::array<double, 2> {
            return {cfree::nearest(p->vertices.X(k), p->denominator), cfree::nearest(p->vertices.Y(k), p->denominator)};
        };
        for (std::size_t ring = 0; ring + 1 < p->offsets.size(); ++ring)
            for (cfree::Index k = p->offsets[ring]; k < p->offsets[ring + 1]; ++k) {
                const auto [x, y] = end(k);
                const auto [u, v] = end(k + 1 < p->offsets[ring + 1] ? k + 1 : p->offsets[ring]);
                segments.push_back({x, y, u, v});
            }
    }
    return segments;
}

static cfree::MeasuredPose measured(const cfree::GivenPose& pose) {
    const auto& [x, y, q, p, theta] = pose;
    const Int w = q * q + p * p;
    return {rounded(x), rounded(y), theta, cfree::ratio(q * q - p * p, w), cfree::ratio(2 * p * q, w)};
}

// An angle from -pi to pi: a `Rotation` by half a turn goes either way.
static double signed_angle(const Int& q, const Int& p) {
    const double half = abs(p) <= q ? cfree::arc_tangent(cfree::ratio(p, q))
                                    : std::copysign(0.5 * std::numbers::pi, p.sign()) - cfree::arc_tangent(cfree::ratio(q, p));
    return 2 * half;
}

// The motions from pose to pose; `robot` are points of the robot, of which slides are asked how far they move;
// None if there are no slides.
static std::tuple<double, double, int, double, int, int> least(const EdgeDistances& distances, nb::handle poses, nb::handle motions,
                                                               nb::handle robot, double tolerance) {
    static const Attribute kind("kind"), pole("pole"), turn("turn"), tau("tau"), clockwise("clockwise"), reach("reach");
    static const std::array<Attribute, 3> terms{Attribute("x"), Attribute("y"), Attribute("d")};
    std::vector<cfree::MeasuredMotion> moved;
    cfree::GivenPose from = pose_of(item(poses, 0));
    for (Py_ssize_t k = 0; k < length(motions); ++k) {
        const nb::handle motion = item(motions, k);
        cfree::GivenPose to = pose_of(item(poses, k + 1));
        auto& m = moved.emplace_back(measured(from), measured(to), cfree::Straight{});
        const auto name = nb::cast<std::string_view>(kind.of(motion));
        if (name == "rotation") {
            const nb::object center = pole.of(motion), half = tau.of(motion);
            const auto apart = [](const cfree::Ratio& a, const cfree::Ratio& b) { return cfree::nearest(b.n * a.d - a.n * b.d, a.d * b.d); };
            const bool is_back = clockwise.of(motion).is(nb::handle(Py_True));
            const cfree::Ratio tangent = half.is_none() ? cfree::Ratio{is_back ? -1 : 1, 0} : ratio_of(half);
            m.kind = cfree::Turning{apart(from.x, to.x), apart(from.y, to.y), rounded(ratio_of(item(center, 0))),
                                    rounded(ratio_of(item(center, 1))), signed_angle(tangent.d, tangent.n)};
        } else if (name == "slide") {
            cfree::Sliding slide{{}, {}, {}, nb::cast<double>(turn.of(motion)), 0};
            std::array<std::array<double, 5>*, 3> of{&slide.x, &slide.y, &slide.d};
            for (std::size_t i = 0; i < 3; ++i) {
                const nb::object given = terms[i].of(motion);
                for (Py_ssize_t n = 0; n < length(given); ++n) (*of[i])[static_cast<std::size_t>(n)] = rounded(ratio_of(item(given, n)));
            }
            slide.reach = nb::cast<double>(reach.of(motion)(item(poses, k), robot));
            m.kind = slide;
        }
        from = std::move(to);
    }
    const auto found = watched([&] { return distances.least(moved, tolerance); });
    return {found.least, found.found, found.motion, found.share, found.edge, found.other};
}

// tau = p / q as (p, q), half a turn (1, 0); the angle in [0, 2 pi), and the bound of its distance from 2 atan(tau).
static std::optional<std::tuple<nb::int_, nb::int_, double, double>> read_radians(double theta) {
    const auto found = cfree::read_radians(theta);
    if (!found) return {};
    return std::tuple{integer(found->p), integer(found->q), found->theta, found->error};
}

void bind_checkers(nb::module_& m) {
    m.def("read_radians", &read_radians, "theta"_a);
    nb::class_<PoseChecker>(m, "PoseChecker")
        .def(nb::init<std::shared_ptr<const cfree::Scene>, std::array<double, 4>>(), "scene"_a, "limits"_a)
        .def("check", &check, "poses"_a, "threads"_a, "out"_a)
        .def("sweep_is_free", &PoseChecker::sweep_is_free, "start"_a, "by"_a)
        .def("is_free", &is_free, "poses"_a, "is_within"_a = false);
    nb::class_<EdgeDistances>(m, "EdgeDistances")
        .def("__init__", [](EdgeDistances* x, const std::vector<const cfree::Polygon*>& robot,
                            const std::vector<const cfree::Polygon*>& others) {
            new (x) EdgeDistances(segments_of(robot), segments_of(others));
        }, "robot"_a, "others"_a)
        .def("least", &least, "poses"_a, "motions"_a, "robot"_a.none(), "tolerance"_a);
    nb::class_<MotionChecker>(m, "MotionChecker")
        .def(nb::init<std::shared_ptr<const cfree::Scene>, std::shared_ptr<const cfree::ArcMotionChecker>>(), "scene"_a,
             "round"_a = nb::none())
        .def("is_free", &is_motion_free, "pose"_a, "motion"_a, "turns"_a)
        .def("is_slide_free", [](const MotionChecker& checker, const SlideIntegers& numbers) {
            return checker.is_free(slide(numbers));
        }, "numbers"_a)
        .def("first_collision", &first_collision, "turns"_a, "numbers"_a);
}

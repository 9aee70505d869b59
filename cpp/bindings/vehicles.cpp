// Vehicles: words made exact, and ways along paths.
#include "cfree/planning/driving.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/unique_ptr.h>

#include <algorithm>
#include <chrono>

#include "rational_poses.hpp"
#include "watched.hpp"

namespace nb = nanobind;
using namespace nb::literals;
using cfree::Driving, cfree::Shortening;

namespace {

using Fraction = std::pair<nb::int_, nb::int_>;
// Whether it turns in place, and reverses; radii to the left and to the right, axle point, and q, p of its heading.
using VehicleNumbers = std::tuple<bool, bool, Fraction, Fraction, Fraction, Fraction, nb::int_, nb::int_>;

cfree::Ratio ratio_of(const Fraction& f) { return {integer(f.first), integer(f.second)}; }

cfree::GivenVehicle vehicle_of(const VehicleNumbers& v) {
    return {std::get<0>(v), std::get<1>(v), ratio_of(std::get<2>(v)), ratio_of(std::get<3>(v)), ratio_of(std::get<4>(v)),
            ratio_of(std::get<5>(v)), {integer(std::get<6>(v)), integer(std::get<7>(v))}};
}

struct Shortened {
    std::shared_ptr<const Driving> by;
    Shortening path;
    Shortened(std::shared_ptr<const Driving> driving, Shortening shortening) : by(std::move(driving)), path(std::move(shortening)) {}
};

// --- words alone, for tests and times ---

// Axle poses in a scene whose integers are the user's units.
cfree::Configuration axle_at(const PoseNumbers& numbers) {
    const cfree::RationalPose pose = pose_of(numbers);
    cfree::Configuration q = pose.configuration(cfree::Scene{});
    const cfree::Place place = pose.place();
    q.px = place.x, q.py = place.y, q.theta = cfree::wrapped(place.theta);
    return q;
}

using Joints = std::vector<PoseTuple>;

std::optional<Joints> joints_of(const std::optional<cfree::ExactWord>& word) {
    if (!word) return {};
    Joints joints;
    for (const cfree::Configuration& q : word->joints)
        joints.push_back(tuple_of(cfree::RationalPose{cfree::reduced(q.x, q.unit), cfree::reduced(q.y, q.unit), cfree::HalfAngle::along(q.hx, q.hy)}));
    return joints;
}

void bind_words(nb::module_& m) {
    using Steps = std::vector<std::pair<int, double>>;
    const auto steps_of = [](const cfree::Word& word) {
        Steps steps;
        for (int k = 0; k < word.count; ++k)
            steps.emplace_back(static_cast<int>(word.kind[static_cast<std::size_t>(k)]), word.length[static_cast<std::size_t>(k)]);
        return steps;
    };
    m.def("vehicle_words", [steps_of](double x, double y, double theta, bool forward_only) {
        std::vector<cfree::Word> words;
        if (forward_only) cfree::dubins_words(x, y, theta, words);
        else cfree::reeds_shepp_words(x, y, theta, words);
        std::vector<Steps> all;
        for (const cfree::Word& word : words) all.push_back(steps_of(word));
        return all;
    }, "x"_a, "y"_a, "theta"_a, "forward_only"_a);
    m.def("shortest_word", [steps_of](double x, double y, double theta) { return steps_of(cfree::shortest_word(x, y, theta)); },
          "x"_a, "y"_a, "theta"_a);
    m.def("exact_words", [](const VehicleNumbers& numbers, const PoseNumbers& from, const PoseNumbers& to, const std::string& kind,
                            double angle) {
        const cfree::Vehicle v = cfree::vehicle_of(vehicle_of(numbers), cfree::Scene{});
        const cfree::Configuration a = axle_at(from), b = axle_at(to);
        std::vector<std::optional<Joints>> found;
        if (kind == "steer") found.push_back(joints_of(cfree::steer(v, 0, a, b)));
        if (kind == "biarc") found.push_back(joints_of(cfree::biarc(v, 0, a, b)));
        if (kind == "zigzag") found.push_back(joints_of(cfree::zigzag(v, 0, a, b, angle)));
        if (kind == "turns")
            for (const bool second : {false, true}) {
                found.push_back(joints_of(cfree::turn_drive_turn(v, 0, a, b, second)));
                found.push_back(joints_of(cfree::arc_and_turn(v, 0, a, b, second)));
            }
        if (kind == "words") {
            const cfree::Place local = cfree::seen_from(a, b);
            const double radius = v.radius * cfree::slack;
            std::vector<cfree::Word> words;
            if (v.reverses) cfree::reeds_shepp_words(local.x / radius, local.y / radius, local.theta, words);
            else cfree::dubins_words(local.x / radius, local.y / radius, local.theta, words);
            std::stable_sort(words.begin(), words.end(), [](const auto& p, const auto& q) { return p.total() < q.total(); });
            for (const cfree::Word& word : words) found.push_back(joints_of(cfree::exact_word(v, 0, a, b, word, radius)));
        }
        return found;
    }, "vehicle"_a, "start"_a, "goal"_a, "kind"_a, "angle"_a);
    m.def("exact_word", [](const VehicleNumbers& numbers, const PoseNumbers& from, const PoseNumbers& to,
                           const std::vector<std::pair<int, double>>& steps, double radius) {
        cfree::Word word;
        if (steps.size() > word.kind.size()) throw std::invalid_argument("a word has at most five pieces");
        for (const auto& [kind, length] : steps) {
            const auto k = static_cast<std::size_t>(word.count++);
            word.kind[k] = static_cast<signed char>(kind), word.length[k] = length;
        }
        return joints_of(cfree::exact_word(cfree::vehicle_of(vehicle_of(numbers), cfree::Scene{}), 0, axle_at(from), axle_at(to), word, radius));
    }, "vehicle"_a, "start"_a, "goal"_a, "word"_a, "radius"_a);
    m.def("time_words", [](const VehicleNumbers& numbers, const PoseNumbers& from, const PoseNumbers& to, int count) {
        const cfree::Vehicle v = cfree::vehicle_of(vehicle_of(numbers), cfree::Scene{});
        const cfree::Configuration a = axle_at(from), b = axle_at(to);
        const cfree::Place local = cfree::seen_from(a, b);
        const double radius = v.radius * cfree::slack;
        using Clock = std::chrono::steady_clock;
        const auto seconds = [&](auto&& work) {
            const auto begin = Clock::now();
            for (int k = 0; k < count; ++k) work(k);
            return std::chrono::duration<double>(Clock::now() - begin).count() / count;
        };
        double sum = 0;
        const double in_doubles = seconds([&](int k) { sum += cfree::shortest_word(local.x / radius + 1e-9 * k, local.y / radius, local.theta).total(); });
        const cfree::Word word = cfree::shortest_word(local.x / radius, local.y / radius, local.theta);
        std::size_t joints = 0;
        const double exactly = seconds([&](int) {
            if (const auto found = cfree::exact_word(v, 0, a, b, word, radius)) joints += found->joints.size();
        });
        return std::tuple(in_doubles, exactly, sum, joints);
    }, "vehicle"_a, "start"_a, "goal"_a, "count"_a);
}

// Boxes that a car without reverse gear may reach: shapes in the axle's frame and in the world, bounds of the reference
// point, its place, radii; x, y, side and step of the grid, its columns, rows and slices; start and goal of the axle.
void bind_boxes(nb::module_& m) {
    using Shapes = std::vector<cfree::Convex>;
    using Three = std::array<double, 3>;
    nb::class_<cfree::Boxes>(m, "Boxes")
        .def("__init__", [](cfree::Boxes* of, Shapes robot, Shapes obstacles, const std::optional<std::array<double, 4>>& bounds,
                            std::array<double, 2> reference, std::array<double, 2> radii, const std::array<double, 4>& grid,
                            const std::array<int, 3>& counts, const Three& start, const Three& goal) {
            cfree::ForwardCar car{std::move(robot), std::move(obstacles), {}, reference[0], reference[1], radii[0], radii[1]};
            if (bounds) car.bounds = cfree::Area{(*bounds)[0], (*bounds)[1], (*bounds)[2], (*bounds)[3]};
            const cfree::BoxGrid sizes{grid[0], grid[1], grid[2], grid[3], counts[0], counts[1], counts[2]};
            const cfree::Place from{start[0], start[1], start[2]}, to{goal[0], goal[1], goal[2]};
            watched([&] { new (of) cfree::Boxes(car, sizes, from, to); });
        }, "robot"_a, "obstacles"_a, "bounds"_a.none(), "reference"_a, "radii"_a, "grid"_a, "counts"_a, "start"_a, "goal"_a)
        .def("run", [](cfree::Boxes& of, long long most) { return watched([&] { return of.run(most); }); }, "most"_a)
        .def_prop_ro("meets_goal", &cfree::Boxes::meets_goal)
        .def_prop_ro("count", &cfree::Boxes::count)
        .def_prop_ro("worked", &cfree::Boxes::worked)
        .def("steps_to", [](const cfree::Boxes& of, const Three& axle) { return of.steps_to({axle[0], axle[1], axle[2]}); }, "axle"_a)
        .def_prop_ro("bits", [](const cfree::Boxes& of) {
            const std::vector<std::uint8_t> bits = of.bits();
            return nb::bytes(bits.data(), bits.size());
        });
}

}  // namespace

void bind_vehicles(nb::module_& m) {
    bind_words(m);
    bind_boxes(m);
    nb::class_<Shortened>(m, "Drive")
        .def("join_far", [](Shortened& of) { watched([&] { of.path.join_far(); return true; }); })
        .def("run", [](Shortened& of, int rounds) { watched([&] { of.path.run(rounds); return true; }); }, "rounds"_a)
        .def_prop_ro("cost", [](const Shortened& of) { return of.path.cost() / of.by->unit; })
        .def_prop_ro("cusps", [](const Shortened& of) { return of.path.cusps(); })
        .def_prop_ro("looked", [](const Shortened& of) { return of.path.by().looked; })
        .def_prop_ro("without_gain", [](const Shortened& of) { return of.path.without_gain(); })
        .def_prop_ro("poses", [](const Shortened& of) { return list_of(of.by->poses(of.path.legs())); });
    nb::class_<Driving>(m, "Driving")
        .def("__init__", [](Driving* of, std::shared_ptr<const cfree::KnownScene> scene, const VehicleNumbers& vehicle,
                            const std::vector<EndNumbers>& way, const std::array<double, 8>& wishes) {
            const auto [backward, cusp, stop, in_place, size, radius, share, most] = wishes;
            new (of) Driving(std::move(scene), vehicle_of(vehicle), ends_of(way), {backward, cusp, stop, in_place, size, radius, share, most});
        }, "scene"_a, "vehicle"_a, "way"_a, "wishes"_a)
        .def_prop_ro("distance", &Driving::distance)
        .def("search_forward", [](const std::shared_ptr<Driving>& of, std::uint64_t seed, int poses) -> std::unique_ptr<Shortened> {
            auto found = watched([&] { return of->search_forward(seed, poses); });
            return found ? std::make_unique<Shortened>(of, of->shortening(std::move(*found), seed)) : nullptr;
        }, "seed"_a, "poses"_a, nb::sig("def search_forward(self, seed: int, poses: int) -> Drive | None"))
        .def("search_in_boxes", [](const std::shared_ptr<Driving>& of, const cfree::Boxes& boxes, int poses) -> std::unique_ptr<Shortened> {
            auto found = watched([&] { return of->search_in_boxes(boxes, poses); });
            return found ? std::make_unique<Shortened>(of, of->shortening(std::move(*found), 0)) : nullptr;
        }, "boxes"_a, "poses"_a, nb::sig("def search_in_boxes(self, boxes: Boxes, poses: int) -> Drive | None"))
        // the words along the path, and the share of the path that they reach
        .def("follow", [](const std::shared_ptr<Driving>& of, long long most, std::uint64_t seed) {
            auto found = watched([&] { return of->follow(most); });
            return std::tuple(found.is_whole, found.share, new Shortened{of, of->shortening(std::move(found.legs), seed)});
        }, "most"_a, "seed"_a, nb::rv_policy::take_ownership);
}

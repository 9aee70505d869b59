// Searches and shorter paths.
#include "cfree/planning/searcher.hpp"

#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/unique_ptr.h>

#include "rational_poses.hpp"
#include "watched.hpp"

namespace nb = nanobind;
using namespace nb::literals;
using cfree::Searcher;

namespace {

std::vector<cfree::Place> places_of(const std::vector<std::array<double, 3>>& given) {
    std::vector<cfree::Place> places;
    for (const auto& [x, y, theta] : given) places.push_back({x, y, theta});
    return places;
}

struct Search {
    std::shared_ptr<const Searcher> by;
    cfree::RrtConnect trees;
};
struct Shortener {
    std::shared_ptr<const Searcher> by;
    cfree::Shortcut path;
};

}  // namespace

void bind_search(nb::module_& m) {
    using Way = std::vector<EndNumbers>;
    using Places = std::vector<std::array<double, 3>>;
    nb::class_<Search>(m, "Search").def("run", [](Search& search, int guesses) {
        return list_of(search.by->poses(watched([&] { return search.trees.run(guesses); })));
    }, "guesses"_a);
    nb::class_<Shortener>(m, "Shortener")
        .def("run", [](Shortener& of, int checks) { of.path.run(checks); }, "checks"_a, nb::call_guard<nb::gil_scoped_release>())
        .def("merge", [](Shortener& of) { of.path.merge(); }, nb::call_guard<nb::gil_scoped_release>())
        .def("turn_less", [](Shortener& of) { of.path.turn_less(); }, nb::call_guard<nb::gil_scoped_release>())
        .def("length", [](const Shortener& of) { return of.path.length() / of.by->unit; })
        .def("path", [](const Shortener& of) { return list_of(of.by->poses(of.path.path())); });
    nb::class_<Searcher>(m, "Searcher")
        .def("__init__", [](Searcher* of, std::shared_ptr<const cfree::KnownScene> scene, const Places& places,
                            const std::array<double, 4>& costs, const std::array<double, 3>& axle,
                            const std::optional<std::array<double, 2>>& center) {
            const cfree::Costs given{costs[0], costs[1], costs[2], costs[3], {axle[0], axle[1], axle[2]}};
            std::optional<cfree::Place> middle;
            if (center) middle = {(*center)[0], (*center)[1], 0};
            new (of) Searcher(std::move(scene), places_of(places), given, middle);
        }, "scene"_a, "places"_a, "costs"_a, "axle"_a, "center"_a.none())
        .def("search", [](std::shared_ptr<const Searcher> by, const EndNumbers& start, const EndNumbers& goal, std::uint64_t seed) {
            return new Search{by, by->search(end_of(start), end_of(goal), seed)};
        }, "start"_a, "goal"_a, "seed"_a, nb::rv_policy::take_ownership)
        .def("shortener", [](std::shared_ptr<const Searcher> by, const Way& way, std::uint64_t seed) {
            return new Shortener{by, by->shortener(ends_of(way), seed)};
        }, "way"_a, "seed"_a, nb::rv_policy::take_ownership)
        .def("balanced", [](std::shared_ptr<const Searcher> by, const Way& way, std::uint64_t seed, double radii) {
            return watched([&, ends = ends_of(way)] { return new Shortener{by, by->balanced(ends, seed, radii)}; });
        }, "way"_a, "seed"_a, "radii"_a, nb::rv_policy::take_ownership);
    m.def("search_area", [](const cfree::KnownScene& scene, const Places& places, double radius) {
        const auto [x0, y0, x1, y1] = cfree::search_area(scene, places_of(places), radius);
        return std::tuple(x0, y0, x1, y1);
    }, "scene"_a, "places"_a, "radius"_a);
}

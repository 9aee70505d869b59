// Halve a path until words join its poses; it ends by Lemma 3, if the path touches nothing; theory, "Vehicles".
#include <algorithm>
#include <cmath>

#include "cfree/support/lookout.hpp"
#include "cfree/vehicles/driver.hpp"

namespace cfree {

namespace {

constexpr int tries_of_words = 4, deep = 8, deepest = 60, bits_at_depth = 2, most_bits = 20;
constexpr double hopeless_after = 0.1, most_times = 2000;  // the rest would take so many times the words that are left

}  // namespace

Followed follow(Driver& driver, const Marked& path, long long most) {
    struct Part {
        double from, to;
        Configuration a, b;
        int depth;
    };
    const Route& route = path.route;
    const auto& mark = path.mark;
    const Vehicle& vehicle = driver.vehicle;
    const double end = mark.back();
    std::vector<Part> todo{{0, end, vehicle.axle_of(route.front()), vehicle.axle_of(route.back()), 0}};
    Followed found;
    const long long until = driver.looked + most;
    while (!todo.empty()) {
        heed_stop();
        const Part part = todo.back();
        todo.pop_back();
        auto leg = driver.join(part.a, part.b, part.from, part.to, HUGE_VAL, driver.vehicle.turns_in_place ? 3 * tries_of_words : tries_of_words,
                               driver.vehicle.turns_in_place || part.depth > deep);
        if (leg) {
            found.legs.push_back(std::move(*leg)), found.share = end > 0 ? part.to / end : 1;
            continue;
        }
        if (driver.looked > until || part.depth >= deepest) return found;
        const double used = static_cast<double>(driver.looked - (until - most)), all = static_cast<double>(most);
        if (used > hopeless_after * all && used > most_times * all * found.share) return found;
        // at a pose of the path between the two, the nearest to the middle, or else there
        const double middle = 0.5 * (part.from + part.to);
        double at = middle;
        auto next = static_cast<std::size_t>(std::lower_bound(mark.begin(), mark.end(), middle) - mark.begin());
        if (next > 0 && (next == mark.size() || middle - mark[next - 1] < mark[next] - middle)) --next;
        const double margin = (part.to - part.from) / 8;
        Place place;
        if (mark[next] > part.from + margin && mark[next] < part.to - margin) at = mark[next], place = route[next].place();
        else {
            auto k = static_cast<std::size_t>(std::upper_bound(mark.begin(), mark.end(), middle) - mark.begin());
            k = std::min(std::max<std::size_t>(k, 1), mark.size() - 1);
            const double length = mark[k] - mark[k - 1];
            place = along(route[k - 1], route[k], length > 0 ? (middle - mark[k - 1]) / length : 0.5);
        }
        const Place axle = vehicle.axle_of(place);
        const Configuration m = driver.rounded(axle, std::min(most_bits, bits_at_depth * std::max(0, part.depth - 2)));
        todo.push_back({at, part.to, m, part.b, part.depth + 1});
        todo.push_back({part.from, at, part.a, m, part.depth + 1});
    }
    found.is_whole = true;
    return found;
}

}  // namespace cfree

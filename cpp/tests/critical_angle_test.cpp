#include "cfree/forbidden/critical_angle.hpp"

#include <algorithm>
#include <map>

#include "cfree/forbidden/boundary.hpp"
#include "check.hpp"
#include "shapes.hpp"

using namespace cfree;

// Compare a boundary's angles of each short name with exact comparison. Returns the number of names that agree on an angle of one chord.
static int names_of_one_chord(const std::vector<Ring>& robot, const std::vector<Ring>& obstacles) {
    const auto boundary = compute_boundary(scene_of(robot, obstacles));
    const Scene& scene = *boundary->scene;
    int joined = 0;
    for (const int chart : {0, 1}) {
        std::map<CriticalAngle::ShortName, std::map<CriticalAngle::Name, CriticalAngle>> groups;
        const auto add = [&](const CriticalAngle& x) { groups[x.short_name(scene)].emplace(x.name(scene), x); };
        const Trapezoids& t = boundary->trapezoids;
        for (Index k = 0; k < static_cast<Index>(t.patch.size()); ++k)
            if (t.chart[k] == chart) add(angle_from(boundary->patches, t, k)), add(angle_to(boundary->patches, t, k));
        for (const auto& [short_name, named] : groups) {
            const CriticalAngle& one = named.begin()->second;
            for (const auto& [name, x] : named) {
                if (name == named.begin()->first) continue;
                ++joined;
                RealRoot p = one.exact(scene), q = x.exact(scene);
                CHECK(compare(p, q) == 0 && order(scene, one, x) == 0);
            }
        }
    }
    return joined;
}

// True if there is no bracket, or if it holds a root, between opposite signs.
static bool is_narrow_around(const std::optional<Predicates::Bracket>& bracket, const RealRoot& root) {
    if (!bracket) return true;
    const Dyadic below = Dyadic::from((*bracket)[0]), above = Dyadic::from((*bracket)[1]);
    const bool is_narrow = (*bracket)[1].hi - (*bracket)[0].hi < 0x1p-50;
    return is_narrow && compare(root, below) > 0 && compare(root, above) < 0 && sign_at(root.p, below) * sign_at(root.p, above) < 0;
}

// Compare orders of angles whose intervals overlap with those of their exact roots. Returns how many have one value and two names.
static int names_of_one_angle(const std::vector<Ring>& robot, const std::vector<Ring>& obstacles) {
    const auto boundary = compute_boundary(scene_of(robot, obstacles));
    const Scene& scene = *boundary->scene;
    const Trapezoids& t = boundary->trapezoids;
    int equal = 0;
    for (const int chart : {0, 1}) {
        std::vector<CriticalAngle> all;
        for (Index k = 0; k < static_cast<Index>(t.patch.size()); ++k)
            if (t.chart[k] == chart) all.push_back(angle_from(boundary->patches, t, k)), all.push_back(angle_to(boundary->patches, t, k));
        std::sort(all.begin(), all.end(), [](const auto& x, const auto& y) { return x.lo < y.lo; });
        for (std::size_t k = 0; k < all.size(); ++k)
            for (std::size_t l = k + 1; l < all.size() && all[l].lo <= all[k].hi; ++l) {
                CriticalAngle x = all[k], y = all[l];
                if (x.name(scene) == y.name(scene)) continue;
                const int quick = order(scene, x, y), narrowing = x.narrowing_order(scene, y);
                RealRoot p = x.exact(scene), q = y.exact(scene);
                CHECK(is_narrow_around(x.bracket(scene), p) && is_narrow_around(y.bracket(scene), q));
                const int exact = compare(p, q);
                CHECK(quick == exact && narrowing == exact);
                if (exact == 0) ++equal;
            }
    }
    return equal;
}

int main() {
    std::vector<Ring> in_line, about;
    for (long k = 0; k < 12; ++k) {
        const long x = 9 * (k % 4), y = 11 * (k / 4);
        in_line.push_back({{x, y}, {x + 3, y}, {x + 5, y + 4}, {x + 1, y + 4}});
        about.push_back({{x, y}, {x + 3, y - k % 3}, {x + 5, y + 4}, {x + 1, y + 5 - k % 2}});
    }
    const Ring plate{{-9, -4}, {2, -7}, {8, -1}, {7, 5}, {-1, 8}, {-8, 3}};
    CHECK(names_of_one_chord({plate}, in_line) > 0);
    CHECK(names_of_one_chord({plate}, about) > 0);
    CHECK(names_of_one_chord({{{-1, -1}, {2, -1}, {0, 2}}, {{4, -1}, {7, -1}, {5, 2}}}, in_line) > 0);
    // copies, also turned by the angle of the triangle 3, 4, 5; the nudge moves one vertex
    const auto copy = [&](long x, long y, bool is_turned, long size, long nudge) {
        Ring ring;
        for (const auto& [a, b] : plate) {
            const auto [c, s] = is_turned ? std::pair(3, 4) : std::pair(5, 0);
            ring.push_back({size * (x + c * a - s * b), size * (y + s * a + c * b)});
        }
        ring[0].first += nudge;
        return ring;
    };
    for (const long nudge : {0, 1}) {
        const long size = 100000;
        const std::vector copies{copy(0, 0, false, size, 0), copy(110, 0, true, size, nudge), copy(0, 110, true, size, 0),
                                 copy(110, 115, false, size, -nudge)};
        CHECK(names_of_one_angle({copy(0, 0, false, size, 0)}, copies) > 0);
    }
    CHECK(names_of_one_angle({{{0, 0}, {6, 0}, {6, 3}, {0, 3}}}, {{{0, 0}, {6, 0}, {6, 3}, {0, 3}}, {{9, 0}, {15, 0}, {15, 3}, {9, 3}}}) > 0);
    return failures > 0;
}

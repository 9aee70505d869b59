#include "cfree/forbidden/critical_angle.hpp"

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
    return failures > 0;
}

// Trim patches here and there; multiples of the golden section lie evenly among all, whatever the order of patches.
#include "cfree/forbidden/sampled_count.hpp"

#include <algorithm>
#include <cstdint>

#include "forbidden/patch_trimming.hpp"

namespace cfree {

Count sampled_count(const Scene& whole, Index samples) {
    const Scene& near = whole.near();
    const std::optional<Scene> with_others = with_short_doubles(near);
    const PatchTrimming one(with_others ? *with_others : near, false);
    const auto patches = static_cast<std::uint64_t>(one.patches.size()), count = std::min<std::uint64_t>(samples, patches);
    PatchTrimming::Scratch scratch = one.scratch();
    std::vector<Trapezoid> live, thin;
    Count sum;
    for (std::uint64_t k = 0; k < count; ++k) {
        heed_stop();
        const auto patch = static_cast<Index>(count == patches ? k : (k * 0x9e3779b9u & 0xffffffffu) * patches >> 32);
        one.pillars_near(one.patches.obstacle[patch], scratch.near);
        one.trim(patch, scratch, live, thin, sum);
        live.clear(), thin.clear();
    }
    return sum;
}

}  // namespace cfree

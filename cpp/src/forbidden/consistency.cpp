// Checks of sizes and signs of a boundary from outside; theory, "The trimmed boundary".
#include "cfree/forbidden/consistency.hpp"

#include <algorithm>
#include <stdexcept>

#include "cfree/forbidden/critical_angle.hpp"
#include "support/parallel.hpp"

namespace cfree {

namespace {

bool is_there(const Scene& scene, const Feature& f) {
    const auto vertices = [](const Shape& s) { return static_cast<Index>(s.X.size()); };
    const auto edges = [](const Shape& s) { return static_cast<Index>(s.v.size()); };
    const Shape &A = scene.robot, &O = scene.obstacles;
    switch (f.kind) {
        case Kind::vertex_edge: return f.robot < vertices(A) && f.obstacle < edges(O);
        case Kind::edge_vertex: return f.robot < edges(A) && f.obstacle < vertices(O);
        case Kind::vertex_vertex: return f.robot < vertices(A) && f.obstacle < vertices(O);
        case Kind::edge_edge: return f.robot < edges(A) && f.obstacle < edges(O);
        default: return false;
    }
}

// True for a helix on the surface, or a surface whose line is not always parallel to its line.
bool is_curve(const Scene& scene, const Surface& on, const Feature& f) {
    if (!is_there(scene, f) || f.kind == Kind::edge_edge) return false;
    if (f.kind == Kind::vertex_vertex) return Predicates(scene, on).vanishes(f, {});
    if (f.kind == Kind::vertex_edge && on.contact.kind == f.kind)
        return scene.obstacles.direction[f.obstacle] != scene.obstacles.direction[on.contact.obstacle];
    if (f.kind == Kind::edge_vertex && on.contact.kind == f.kind)
        return scene.robot.direction[f.robot] != scene.robot.direction[on.contact.robot];
    return f.kind == Kind::vertex_edge ? scene.obstacles.has_extent(f.obstacle) : scene.robot.has_extent(f.robot);
}

bool is_angle(const Scene& scene, const CriticalAngle& x) {
    if (x.is_chart_end()) return x.second.kind == Kind::none && x.lo == x.hi && std::abs(x.lo) == 1 && x.place == 0;
    if (!is_there(scene, x.first)) return false;
    const bool alone = x.second.kind == Kind::none;
    if (alone && x.first.kind != Kind::edge_edge && x.first.kind != Kind::vertex_vertex) return false;
    if (!alone && (!is_curve(scene, x.on(), x.first) || !is_curve(scene, x.on(), x.second))) return false;
    return Predicates(scene, x.on()).isolates({x.first, x.second, x.lo, x.hi}, x.place);
}

bool is_possible(const Scene& scene, const Patches& patches, const Trapezoids& t, Index k) {
    const Surface on = surface_of(patches, t, k);
    const CriticalAngle from = angle_from(patches, t, k), to = angle_to(patches, t, k);
    const Feature lower = unpacked(t.lower[k]), upper = unpacked(t.upper[k]);
    if (!is_angle(scene, from) || !is_angle(scene, to)) return false;
    if (!is_curve(scene, on, lower) || !is_curve(scene, on, upper)) return false;
    Predicates here(scene, on);
    const Event first = from.event(here), last = to.event(here);
    return here.order(first, last) < 0 && here.are_limits(lower, upper, first, last);
}

}  // namespace

bool are_patches_of(const Scene& scene, const Patches& patches) {
    const Patches own = list_patches(scene);
    return own.kind == patches.kind && own.robot == patches.robot && own.obstacle == patches.obstacle;
}

std::optional<Index> first_impossible(const Scene& scene, const Patches& patches, const Trapezoids& t, int threads) {
    constexpr Index chunk = 256;
    const auto count = static_cast<Index>(t.patch.size());
    std::atomic<bool> stop = false;
    std::atomic<Index> next = 0, found = count;
    in_parallel(std::min(threads, count / chunk + 1), stop, [&] {
        for (Index begin; (begin = next.fetch_add(chunk)) < found && !stop;)
            for (Index k = begin; k < std::min(count, begin + chunk); ++k) {
                heed_stop();
                bool possible = false;
                try {
                    possible = is_possible(scene, patches, t, k);
                } catch (const std::logic_error&) {  // impossible for a scene's own trapezoids
                }
                if (possible) continue;
                for (Index least = found; k < least && !found.compare_exchange_weak(least, k);) {}
                break;
            }
    });
    return found < count ? std::optional<Index>(found) : std::nullopt;
}

std::optional<Index> first_impossible(const Scene& scene, const Patches& patches, const IsolatedParts& x) {
    const auto on = [&](Index patch, Index k) { return Surface{patches.contact(patch), x.parts.chart[k]}; };
    for (Index k = 0; k < static_cast<Index>(x.parts.patch.size()); ++k) {
        heed_stop();
        const auto angle = [&](Index patch, std::uint64_t first, std::uint64_t second, double lo, double hi, int place) {
            return CriticalAngle(on(patch, k), {unpacked(first), unpacked(second), lo, hi}, place);
        };
        const auto& p = x.parts;
        const auto from = angle(x.from_patch[k], p.from_first[k], p.from_second[k], p.from_lo[k], p.from_hi[k], p.from_place[k]);
        const auto to = angle(x.to_patch[k], p.to_first[k], p.to_second[k], p.to_lo[k], p.to_hi[k], p.to_place[k]);
        if (!is_angle(scene, from) || !is_angle(scene, to) || !is_curve(scene, on(x.lower_patch[k], k), unpacked(p.lower[k])) ||
            !is_curve(scene, on(x.upper_patch[k], k), unpacked(p.upper[k])) || order(scene, from, to) > 0)
            return k;
    }
    return {};
}

std::string misfit(const Boundary& b, int threads) {
    const Scene& scene = *b.scene;
    if (!are_patches_of(scene, b.patches)) return "contact";
    if (const auto k = first_impossible(scene, b.patches, b.trapezoids, threads)) return "trapezoid " + std::to_string(*k);
    if (const auto k = first_impossible(scene, b.patches, b.isolated)) return "isolated part " + std::to_string(*k);
    return {};
}

}  // namespace cfree

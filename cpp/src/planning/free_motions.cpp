// Convert motions between rational poses to integers; theory, "Motions".
#include "cfree/planning/free_motions.hpp"

#include "cfree/support/lookout.hpp"

namespace cfree {

bool FreeMotions::join(const Poses& way) const {
    for (std::size_t k = 1; k < way.size(); ++k) {
        heed_stop();
        if (!checker.is_free(motion_between(way[k - 1].configuration(scene), way[k].configuration(scene)))) return false;
    }
    return true;
}

std::optional<Poses> FreeMotions::first_free(std::initializer_list<Poses> ways) const {
    for (const Poses& way : ways)
        if (join(way)) return way;
    return {};
}

bool FreeMotions::along_curve(const RationalPose& from, const RationalPose& to, const Sheet& sheet, std::size_t side) const {
    const Feature curve = unpacked(sheet.curves[side]);
    if (curve.kind == Kind::vertex_vertex) return join({from, to});
    auto slide = free_slide(scene, checker, from, to, sheet.contact, curve);
    if (!slide) return false;
    slides.add(std::move(*slide));
    return true;
}

std::optional<Ratio> FreeMotions::free_share(const RationalPose& from, const Ratio& dx, const Ratio& dy) const {
    const auto r = from.half.rotation();
    const Int unit = lcm(lcm(from.x.d, from.y.d), lcm(dx.d, dy.d));
    const auto whole = [&](const Ratio& x) { return Int(x.n * (unit / x.d) * scene.scale); };
    return checker.free_share({r.c, r.s, r.w, whole(from.x), whole(from.y), unit, false, whole(dx), whole(dy), 1, 1, 0});
}

}  // namespace cfree

// One motion as users give it.
#pragma once
#include "cfree/collision/motion_checker.hpp"
#include "given_poses.hpp"

// A `Translation` or a `Rotation` from a pose, in doubles or as a `Pose`; nothing for other poses. `of_unit`: the scene's
// integers in a unit.
inline std::optional<cfree::Motion> given_motion(const cfree::Int& of_unit, nanobind::handle from, nanobind::handle motion, bool turns) {
    static const Attribute vector("vector"), pole("pole"), tau("tau"), clockwise("clockwise");
    const auto given = given_pose(from);
    if (!given) return {};
    const nanobind::object pair = (turns ? pole : vector).of(motion);
    const cfree::Ratio vx = ratio_of(item(pair, 0)), vy = ratio_of(item(pair, 1));
    const auto& [x, y, q, p, theta] = *given;
    using cfree::common_multiple, cfree::Int;
    const Int unit = common_multiple(common_multiple(x.d, y.d), common_multiple(vx.d, vy.d)), scale = unit * of_unit;
    const auto whole = [&](const cfree::Ratio& c) { return Int(c.d == unit ? c.n * of_unit : c.n * (scale / c.d)); };
    cfree::Motion m{q * q - p * p, 2 * p * q, q * q + p * p, whole(x), whole(y), unit, turns, whole(vx), whole(vy), 1, 1, 0};
    if (turns) {
        const nanobind::object half = tau.of(motion);
        if (half.is_none()) {
            m.q = 0, m.p = clockwise.of(motion).is(nanobind::handle(Py_True)) ? -1 : 1;
        } else {
            const cfree::Ratio tangent = ratio_of(half);
            m.q = tangent.d, m.p = tangent.n;
        }
        m.start = cfree::root_below(m.q * m.q + m.p * m.p);
    }
    return m;
}

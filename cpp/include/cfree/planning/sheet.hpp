// Exact trapezoid of a boundary: poses on it at rational t and tau, rational ends included.
#pragma once
#include <initializer_list>
#include <optional>
#include <span>
#include <utility>

#include "cfree/forbidden/cell_complex.hpp"
#include "cfree/planning/moving_line.hpp"
#include "cfree/planning/rational_pose.hpp"

namespace cfree {

inline constexpr unsigned trusted_bits = 32;  // bits of tau with which doubles are trusted

class Sheet {
public:
    // ends: all orientations from the first to the second, in its chart, are strictly within.
    Sheet(const Scene& scene, const Feature& contact, int chart, std::array<std::uint64_t, 2> curves, Ratio low, Ratio high);
    // Sheet of a face; `points` refines its ends.
    static Sheet of(const Boundary& boundary, const PointLocation& points, Index face);

    // Sheet of an isolated part: both its curves are the part, or name its ends; see IsolatedParts. Its ends are not refined.
    static Sheet isolated(const Boundary& boundary, Index part);

    const Feature contact;
    const int chart;
    const std::array<std::uint64_t, 2> curves;  // below and above
    const Index face = -1;
    Ratio low, high;
    // Refine the ends of a face to within 2^-bits of its first and last orientation.
    void refine(unsigned bits);

    // Positions (P + t U) / w in the scene's integers.
    struct Line {
        Vec<Int> P, U;
        Int w;
    };
    Line at(const HalfAngle& half) const;
    Line at(const Ratio& tau) const { return at(HalfAngle::of(chart, tau)); }
    // Limits of t at an orientation from the first to the last; if a curve's formula has no value, the limit around there.
    std::pair<Ratio, Ratio> limits(const Ratio& tau) const;
    Ratio middle(const Ratio& tau) const;  // a simple t well within
    RationalPose pose(const Ratio& t, const Ratio& tau) const { return pose(t, HalfAngle::of(chart, tau)); }
    // Pose at any orientation, also outside its own: the same points touch, on their lines.
    RationalPose pose(const Ratio& t, const HalfAngle& half) const;
    // Name of one of its curves in its chart: the same for the same positions.
    std::vector<Int> trace(std::size_t side) const;
    // t of a pose on its line, at this orientation.
    Ratio t_of(const RationalPose& pose, const Ratio& tau) const;

private:
    Sheet(const Boundary& boundary, const PointLocation& points, Index face);
    Ratio limit(std::uint64_t curve, const HalfAngle& half, const Line& line, const Ratio& tau) const;
    Ratio limit_around(const ContactLine<Int>& other, const Ratio& tau) const;
    Ratio along(const Feature& helix) const;
    MovingLine moving(const ContactLine<Int>& of) const;

    const Scene& scene;
    const PointLocation* points = nullptr;
    unsigned bits = 0;
    const ContactLine<Int> line;
};

// Pose in the middle of a trapezoid or an isolated part, at an orientation strictly within.
RationalPose middle_of(const Boundary& boundary, const Trapezoids& table, Index row, const Ratio& tau);
// An orientation strictly within sheets that share a part of a curve; refines them.
Ratio common_tau(std::span<Sheet* const> sheets);
Ratio common_tau(std::initializer_list<Sheet*> sheets);
// t on two sheets at orientations at which they are adjacent: in the middle of their common part, if there is one.
std::optional<std::pair<Ratio, Ratio>> common_part(const Sheet& f, const Ratio& sigma, const Sheet& g, const Ratio& tau);

}  // namespace cfree

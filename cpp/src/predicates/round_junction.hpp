// Lines and circles of grown shapes at one critical angle, and just before and after it: see Junction.
#pragma once
#include <functional>
#include <memory>
#include <optional>

#include "cfree/predicates/junction.hpp"
#include "predicates/round_places.hpp"

namespace cfree {

// A place on a surface at the critical angle: the end of a curve of it, or t on its line.
struct RoundSpot {
    Feature on, curve;
    Code code = 0;                        // of the curve
    bool jumps = false, is_after = false; // if the curve jumps here: on which side it ends
    bool is_limit = false;                // if the lines of both surfaces are parallel here: reached by continuity
    std::optional<Ratio> given = {};
};

class RoundJunction {
public:
    using Spot = RoundSpot;
    RoundJunction(const Scene& scene, int chart, double lo, double hi, std::function<LongRoot()> exact,
                  std::function<std::optional<Predicates::Bracket>()> narrow = nullptr);

    // From now on `turn`, `outside` and `ahead` are 0 where doubles leave them open.
    void ask_doubles_only() { is_quick = true; }

    // Enter an edge of the robot and one of the obstacles that are parallel here.
    void know_parallel(Index g, Index f);

    // Enter two curves of a surface that meet here, and nowhere else between two numbers.
    void know_meeting(const Feature& on, const Feature& first, const Feature& second, double from, double to);

    // Enter a surface and one that touches it here.
    void know_touch(const Feature& on, const Feature& other);

    // See Junction.
    int turn(const Feature& x, const Feature& y);
    int parallel(const Feature& x, const Feature& y);
    int side(const Feature& x, const Feature& y);
    Interval offset(const Feature& x, const Feature& y) const;
    int across(const Feature& x, const Feature& y, const Spot& p, const Spot& q, bool after);

    // End of a curve on a surface, of a trapezoid after this angle or before it.
    Spot spot(const Feature& on, const Feature& curve, bool is_after);
    // On a quadrant t is the tangent of half the angle from its beginning.
    double value(const Feature& surface, const Spot& p);
    Interval range(const Feature& surface, const Spot& p) const;
    // Order along a line, or counter-clockwise on a circle, of two places that are on this surface or on one equal to it here.
    int order(const Feature& surface, const Spot& p, const Spot& q);
    // A place between two others in this order, by halving.
    Spot between(const Feature& surface, const Spot& low, const Spot& high);
    // True if two circles, or quadrants of them, are equal here.
    bool are_one_circle(const Feature& x, const Feature& y);

    // A place against other surfaces than its own, of one angle and without jumps: 1 outside the surface's pillar, -1 inside, 0 on it;
    // if it is on the surface, whether it is between two places there, and in the quadrant of a circle; whether two places are one.
    int outside(const Feature& surface, const Spot& p);
    bool is_between(const Feature& surface, const Spot& low, const Spot& high, const Spot& p);
    bool are_one_place(const Spot& p, const Spot& q);
    // Sign of the product of a line's direction and the vector from a circle's centre to a place.
    int ahead(const Feature& line, const Feature& circle, const Spot& p);

    // The place, on a line that is that of its own surface here; in the ring of surd polynomials also where it is a limit.
    CurvePlace<SurdPoly> place_exactly(const Feature& surface, const Spot& p, int axis) const;
    LongRoot& here();

private:
    template <class K, class Ring>
    auto place(const Feature& surface, const Spot& p, int axis, const Ring& in) const;
    // Sign here of a form that is available in balls and exactly.
    template <class F>
    int sign(const F& form);
    template <class K, class Ring>
    auto point(const Spot& p, const Ring& in) const;
    template <class F>
    int sign_of_place(const F& place_in);
    template <class F, class G>
    int order_of_places(const F& first, const G& second, bool is_exact);

    const Scene& scene;
    int chart;
    double lo, hi, kappa;
    bool is_quick = false;
    std::function<LongRoot()> exact;
    std::function<std::optional<Predicates::Bracket>()> narrow;
    std::optional<LongRoot> root;  // computed when needed, as the next
    std::optional<std::optional<Predicates::Bracket>> bracket;
    std::optional<Ball> near_ball();
    bool have_one_sense(const Feature& x, const Feature& y) const;  // of circles
    std::optional<Feature> common_circle(const Feature& x, const Feature& y);
    bool are_one_line(const Feature& x, const Feature& y);
    bool are_one_curve(const Spot& p, const Spot& q);
    bool is_known(const Feature& surface, const Spot& p, const Spot& q) const;
    bool do_cross(const Spot& p, const Spot& q) const;
    MeetingNames known;            // parallel edges; two curves that meet, and their surface
    struct Meeting {
        MeetingNames::Name name;  // without branches
        double lo, hi;
    };
    std::vector<Meeting> meetings;
    std::vector<std::array<Code, 2>> touching;  // names of two surfaces, without branches
};

}  // namespace cfree

// Configuration of several contact lines at one critical angle, and just before and after it.
#pragma once
#include <functional>
#include <memory>

#include "cfree/predicates/meeting_names.hpp"
#include "cfree/predicates/predicates.hpp"

namespace cfree {

// A place on a contact line at the critical angle: the end of a curve of the surface.
struct Spot {
    struct Place {  // t = n / d
        Int n, d;
    };
    Feature curve;
    Code code = 0;  // 0: none
    Feature on = {};
    std::shared_ptr<const Place> given = nullptr;  // if the curve runs along the line: t on the surface `on`, by continuity
};

// Interval that certainly contains a number.
struct Interval {
    double lo, hi;
};

class Junction {
public:
    using Spot = cfree::Spot;
    // Junction at an angle of a chart, in an interval; a narrow one, and the exact angle, are computed when needed.
    Junction(const Scene& scene, int chart, double lo, double hi, std::function<RealRoot()> exact,
             std::function<std::optional<Predicates::Bracket>()> bracket);

    // Enter three surfaces, or a helix and a surface and nothing, that meet here: see CriticalAngle::name.
    void know(const std::array<Code, 3>& name) { known.insert(name); }
    // Enter an edge of the robot and one of the obstacles that are parallel here.
    void know_parallel(Index g, Index f);

    // Directions of two contact lines: 1 if y's is to the left of x's, -1 to the right, 0 parallel.
    int turn(const Feature& x, const Feature& y);
    // Directions of two lines: 1 equal, -1 opposite, 0 not parallel.
    int parallel(const Feature& x, const Feature& y);
    // Side of parallel lines: y is left of x (1), right (-1), or the same line (0).
    int side(const Feature& x, const Feature& y);
    // Side of x's line on which the point b_b - R a_a lies.
    int side(const Feature& x, Index a, Index b);
    // Distance of parallel lines: y to the left of x, in a unit that depends on x alone.
    Interval offset(const Feature& x, const Feature& y) const;
    // End of a curve on a surface.
    Spot spot(const Feature& on, const Feature& curve) const;
    // Place t of a spot on a surface whose line goes through it: an interval, and a double near it, if doubles suffice.
    struct Reading {
        Interval t;
        std::optional<double> near;
    };
    Reading reading(const Feature& line, const Spot& p) const;
    // The same of the place on a surface's line beside a helix, its orthogonal projection.
    Interval beside(const Feature& line, const Feature& helix) const { return reading(line, {helix}).t; }
    // A double near t in any case.
    double value(const Feature& line, const Spot& p) const;
    // Side of x's line on which a place on another surface's line lies.
    int side(const Feature& x, const Feature& line, const Spot& p);
    // Order of two places along the line of a surface through both.
    int order(const Feature& line, const Spot& p, const Spot& q);
    // Order of two surfaces with one line here, just after this angle or before it, between two places on the patch of x: x is
    // left of y (1) or right (-1); 0: they are one surface.
    int across(const Feature& x, const Feature& y, const Spot& p, const Spot& q, bool after);

private:
    template <class T>
    Trig<T> along(const Feature& x, Index a, Index b) const;  // U . (b_b - R a_a - P)
    template <class T>
    Vec<T> direction(const Feature& x) const;  // U, or -U turned back for an edge of the robot
    template <class T>
    Trig<T> directions_dot(const Feature& x, const Feature& y) const;
    template <class T>
    Trig<T> directions_cross(const Feature& x, const Feature& y) const;
    template <class T>
    std::array<Trig<T>, 2> position(const Feature& line, const Spot& p) const;
    Interval range(const Filtered& f) const;
    std::optional<double> between(const Feature& line, const Spot& p, const Spot& q) const;
    RealRoot& here() const;
    const Ball* dyadic() const;
    const Ball* narrow() const;
    template <class Question>
    std::optional<int> by_balls(const Question& question) const;
    int order_exactly(const Feature& line, const Spot& p, const Spot& q);
    std::array<Code, 2> helices(const Feature& f) const;  // both ends of a surface, or the helix itself
    bool meets(const Feature& surface, Code helix) const;
    void know_meeting(const Feature& surface, Code helix);
    std::array<Code, 3> parallels(Index g, Index f) const;
    bool are_one_line(const Feature& x, const Feature& y);
    int turn_of_kind(const Feature& x, const Feature& y);
    bool is_known(const Feature& line, const Spot& p, const Spot& q);
    template <class F>
    int sign(const F& trig) const;
    Poly polynomial(const Trig<Int>& f) const;
    Filtered filtered(const Trig<Approx>& f) const;

    const Scene& scene;
    Predicates on_any;  // for what is the same on every surface
    double lo, hi;
    std::function<RealRoot()> exact;
    mutable std::optional<RealRoot> root;  // computed when needed
    mutable std::optional<Ball> few_digits;
    mutable std::function<std::optional<Predicates::Bracket>()> bracket;  // called at most once
    mutable std::optional<Ball> narrowed;
    mutable std::optional<Coefficients<Ball>> zero_here;  // a quadratic, not zero everywhere
    MeetingNames known;
};

}  // namespace cfree

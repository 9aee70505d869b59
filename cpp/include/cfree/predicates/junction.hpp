// What several contact lines look like at one critical angle, and just before and after it.
#pragma once
#include <functional>
#include <set>

#include "cfree/predicates/predicates.hpp"

namespace cfree {

// A place on a contact line at the critical angle: where a curve of the surface arrives.
struct Spot {
    Feature curve;
    Code code;
    bool is_given = false;  // where the curve runs along the line: at t = n / d of the surface `on`, by continuity
    Feature on;
    Int n = 0, d = 1;
};

class Junction {
public:
    // At an angle of a chart, in an interval, and exactly when asked for.
    Junction(const Scene& scene, int chart, double lo, double hi, std::function<RealRoot()> exact);

    // Three surfaces, or a helix and a surface and nothing, known to meet here: see CriticalAngle::name.
    void know(const std::array<Code, 3>& name) { known.insert(name); }

    // Directions of two contact lines: 1 the same, -1 opposite, 0 not parallel.
    int parallel(const Feature& x, const Feature& y);
    // Of parallel lines: y is left of x (1), right (-1), or the same line.
    int side(const Feature& x, const Feature& y);
    // The side of x's line on which the point b_b - R a_a lies.
    int side(const Feature& x, Index a, Index b);
    // Where a curve on a surface ends.
    Spot spot(const Feature& on, const Feature& curve) const;
    // About where that is: t on a surface whose line goes through it.
    double value(const Feature& line, const Spot& p) const;
    // The side of x's line on which a place on another surface's line lies.
    int side(const Feature& x, const Feature& line, const Spot& p);
    // Order of two places along a line, that of a surface through both.
    int order(const Feature& line, const Spot& p, const Spot& q);
    // Two surfaces with one line here: whether, just after this angle or before it and between two places on the patch of x,
    // x is left of y (1) or right (-1); 0: they are one surface.
    int across(const Feature& x, const Feature& y, const Spot& p, const Spot& q, bool after);

private:
    Predicates on(const Feature& x) const { return {scene, {x, chart}}; }
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
    RealRoot& here() const;
    bool is_known(const Feature& line, const Spot& p, const Spot& q) const;
    template <class F>
    int sign(const F& trig) const;
    Poly polynomial(const Trig<Int>& f) const;
    Filtered filtered(const Trig<Approx>& f) const;

    const Scene& scene;
    int chart;
    double lo, hi;
    std::function<RealRoot()> exact;
    mutable std::optional<RealRoot> root;  // once needed
    std::set<std::array<Code, 3>> known;
};

}  // namespace cfree

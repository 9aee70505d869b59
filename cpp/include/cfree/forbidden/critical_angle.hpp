// A critical angle with the surface that names it, so that angles of different surfaces can be compared.
#pragma once
#include <memory>

#include "cfree/forbidden/columns.hpp"
#include "cfree/predicates/junction.hpp"

namespace cfree {

class CriticalAngle {
public:
    CriticalAngle(const Surface& s, const Event& x, int place_there)
        : lo(x.lo), hi(x.hi), first(x.first), second(x.second), place(place_there), surface(s) {}
    // The end of a chart.
    CriticalAngle(int chart, int side) : CriticalAngle({{}, chart}, {{}, {}, double(side), double(side)}, 0) {}

    double lo, hi;
    Feature first, second;
    int place;
    bool is_chart_end() const { return first.kind == Kind::none; }
    int chart() const { return surface.chart; }
    // Name of the features that meet there, the same on every surface: three surfaces, a helix and a surface, two parallel
    // edges, or the end of a chart.
    using Name = std::array<Code, 3>;
    Name name(const Scene& scene) const;
    // If two of these put two vertices of one shape on the line of an edge of the other, the chord and the edge's direction: there is
    // one angle in a chart at which they are parallel, whatever else meets there. Otherwise the name.
    using ShortName = std::pair<Name, bool>;  // true: the name of a chord
    ShortName short_name(const Scene& scene) const;
    // True if angles with one short name are proved equal. Each is the only root of one polynomial in its interval.
    static bool are_one(const Scene& scene, const ShortName& name, const std::vector<CriticalAngle>& same);
    const RealRoot& exact(const Scene& scene) const;
    LongRoot& exact_among_grown(const Scene& scene) const;  // where shapes are grown; comparisons narrow it
    const std::optional<Predicates::Bracket>& bracket(const Scene& scene) const;
    // Sign of this angle minus another of its chart; narrows both.
    int narrowing_order(const Scene& scene, CriticalAngle& other);
    Event event(Predicates& on) const { return on.restored({first, second, lo, hi}, place); }
    const Surface& on() const { return surface; }

private:
    std::optional<Name> chord(const Scene& scene, const Feature& x, const Feature& y) const;
    std::optional<Name> chord(const Scene& scene) const;
    Name name_among_grown(const Scene& scene) const;
    Surface surface;
    mutable std::shared_ptr<RealRoot> root;  // computed when needed
    mutable std::shared_ptr<LongRoot> long_root;
    mutable std::optional<std::optional<Predicates::Bracket>> narrow;
};

// Enter the features that meet at an angle into a junction there.
void know(Junction& at, const Scene& scene, const CriticalAngle& angle);

// Sign of x - y, both in one chart.
int order(const Scene& scene, const CriticalAngle& x, const CriticalAngle& y);

// Angles of trapezoid k, on its patch or on the surface of its owner.
CriticalAngle angle_from(const Patches& patches, const Trapezoids& t, Index k);
CriticalAngle angle_to(const Patches& patches, const Trapezoids& t, Index k);
CriticalAngle angle_from(const Surface& on, const Trapezoids& t, Index k);
CriticalAngle angle_to(const Surface& on, const Trapezoids& t, Index k);
Surface surface_of(const Patches& patches, const Trapezoids& t, Index k);

}  // namespace cfree

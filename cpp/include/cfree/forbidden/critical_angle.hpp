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
    // What meets there, the same whoever says it: three surfaces, a helix and a surface, two parallel edges, or the end of a chart.
    using Name = std::array<Code, 3>;
    Name name(const Scene& scene) const;
    // If two of these put two vertices of one shape on the line of an edge of the other, the chord and the edge's direction: there is
    // one angle in a chart at which they are parallel, whatever else meets there. Otherwise the name.
    using ShortName = std::pair<Name, bool>;  // and whether it is that of a chord
    ShortName short_name(const Scene& scene) const;
    // Of angles with one short name: whether they are seen to be one. Each is the only root of one polynomial in its interval.
    static bool are_one(const Scene& scene, const ShortName& name, const std::vector<CriticalAngle>& same);
    const RealRoot& exact(const Scene& scene) const;
    const std::optional<Predicates::Bracket>& bracket(const Scene& scene) const;
    // Sign of this one minus another of its chart; of both more is known afterwards.
    int narrowing_order(const Scene& scene, CriticalAngle& other);
    Event event(Predicates& on) const { return on.restored({first, second, lo, hi}, place); }
    const Surface& on() const { return surface; }

private:
    std::optional<Name> chord(const Scene& scene, const Feature& x, const Feature& y) const;
    std::optional<Name> chord(const Scene& scene) const;
    Surface surface;
    mutable std::shared_ptr<RealRoot> root;  // once needed
    mutable std::optional<std::optional<Predicates::Bracket>> narrow;
};

// What meets at an angle, told to a junction there.
void know(Junction& at, const Scene& scene, const CriticalAngle& angle);

// Sign of x - y, of one chart.
int order(const Scene& scene, const CriticalAngle& x, const CriticalAngle& y);

// The angles of trapezoid k: of a patch, or of what its owner says.
CriticalAngle angle_from(const Patches& patches, const Trapezoids& t, Index k);
CriticalAngle angle_to(const Patches& patches, const Trapezoids& t, Index k);
CriticalAngle angle_from(const Surface& on, const Trapezoids& t, Index k);
CriticalAngle angle_to(const Surface& on, const Trapezoids& t, Index k);
Surface surface_of(const Patches& patches, const Trapezoids& t, Index k);

}  // namespace cfree

// Orders of curves on a contact surface of grown shapes, and the angles at which they change; theory, "Rounded shapes".
//
// On a line the place of a curve is t, on a quadrant of a circle a coordinate of the unit vector u. Both are of the form
// (a + b sqrt(d)) / c, with b = 0 for a joint, for the end of a quadrant and for a line on a line.
#pragma once
#include "cfree/exact/radicals.hpp"
#include "predicates/isolation.hpp"
#include "predicates/round_places.hpp"

namespace cfree {

class RoundOrders {
public:
    RoundOrders(const Scene& scene, const Surface& on);

    // Sign of p - q if it is certainly the same everywhere between two angles, else 0; in doubles.
    int order_on(const Feature& p, const Feature& q, double lo, double hi) const;
    // Sign of the radius of the surface, a circle, minus that of another one.
    int compare_radius(const Feature& circle) const;
    // Bounds of a curve's place between two angles, or of all.
    std::array<double, 2> range(const Feature& curve, double lo, double hi) const;
    // Sign of p - q at an angle, in balls if that is certain; exactly at a sample; and by whichever decides it first.
    std::optional<int> order_in_balls(const Feature& p, const Feature& q, const Ball& tau) const;
    int order_exactly(const Feature& p, const Feature& q, const Sample& at) const;
    int order_at(const Feature& p, const Feature& q, const Sample& at) const;
    // True if the two curves certainly meet between two angles: they go through one another; or, if they have a joint at every
    // angle, it is on the surface there, and they are on its branch.
    bool do_meet(const Feature& p, const Feature& q, double lo, double hi) const;
    // True if two curves without a joint meet at a root of the polynomial of their surfaces.
    bool meet_at(const Feature& p, const Feature& q, LongRoot& root) const;
    // Branch on which a line and a circle that is smooth with it go through their joint where that is on the surface, if it
    // is certain everywhere between two angles; and at a root.
    std::optional<int> joint_branch(const Feature& line, const Feature& circle, double lo, double hi) const;
    int joint_branch(const Feature& line, const Feature& circle, LongRoot& root) const;
    // True if both curves are on a branch; a line meets a line only once.
    bool are_on(int branch, const Feature& p, const Feature& q) const {
        const auto is_there = [&](const Feature& f) { return f.branch == branch || (is_line(f) && is_line(surface.contact)); };
        return is_there(p) && is_there(q);
    }

    // Sign at a root of p - q, places at which no denominator is zero there.
    int order_at(const Feature& p, const Feature& q, LongRoot& root) const;
    // Unit vector to a joint of a circle with a line, or to an end of a quadrant, times a positive number, nearly: within 8 u m of the
    // truth, m the magnitude of both coordinates together.
    struct Direction {
        Feature to;
        double x, y, m;
    };
    Direction direction(const Feature& to, const Sample& at) const;
    // Sign of u x v for two of them.
    int turn(const Direction& u, const Direction& v, const Sample& at) const;
    // Sign at a sample of a coordinate of a curve on a circle, see `place`.
    int coordinate_sign(const Feature& curve, int axis, const Sample& at) const;

    // True if the polynomials of two events are quadratics, and equal up to a factor.
    bool are_proportional(const Event& x, const Event& y) const;
    // Rotation at a double, and vectors there with the sum of the magnitudes of their coordinates: of a line, and from the surface's
    // site to the centre of a circle.
    struct Turned {
        double cosine, sine;
    };
    struct Vector {
        double x, y, m;
    };
    Turned turned_to(double tau) const;
    Vector along(const Feature& line, const Turned& at) const;
    Vector to_centre(const Feature& circle, const Turned& at) const;
    // Sign at a double of the event of a line and a circle at its end, 0 if not certain, from their vectors and the surface's, if that
    // is a line.
    int joint_sign(const Feature& line, const Vector& along, const Feature& circle, const Vector& to_centre, const Vector& surface_along) const;
    // Sign of an event's polynomial at a double, and on all of an interval, 0 if not certain.
    int sign(const Feature& first, const Feature& second, double tau) const;
    int sign_on(const Feature& first, const Feature& second, double lo, double hi) const;
    // Polynomial of an event's features, times a power of 1 + tau^2.
    RoundForm form(const Feature& first, const Feature& second) const;  // in doubles
    // Brackets of its roots in doubles, at least of those between two angles; false if signs do not suffice.
    bool isolate(const Feature& first, const Feature& second, double lo, double hi, Brackets& found) const;
    Coefficients<Ball> in_balls(const Feature& first, const Feature& second) const;
    const NormedPoly& exactly(const Feature& first, const Feature& second) const;  // until the next question
    // The only root of that between two doubles.
    LongRoot root_between(const Feature& first, const Feature& second, double lo, double hi) const;

private:
    // Angles at a sample, and around it if that is no double.
    Between around(const Sample& at) const {
        return {at.tau, at.fine ? at.fine->rounded_up() : at.tau, kappa};
    }
    // p - q is the value over the product of the two denominators.
    struct Difference {
        Radicals value;
        SurdPoly first, second;
    };
    Difference difference(const Feature& p, const Feature& q) const;
    template <class K>
    std::optional<Trig<K>> quadratic(const Feature& first, const Feature& second) const;
    template <class K>
    Trig<K> joint_direction(const Feature& line, const Feature& circle) const;
    template <class K, class Ring>
    auto place(const Feature& curve, int axis, const Ring& in) const {
        return place_of_curve<K>(scene, surface.contact, curve, axis, in);
    }

    // What is asked for again and again, in tables by the names of features; doubles in one of the thread, with the number of these
    // orders.
    using Name = std::uint64_t;  // a feature with its branch
    static Name name(const Feature& f) {
        return static_cast<Name>(f.kind) << 61 | static_cast<Name>(f.branch & 3) << 59 | static_cast<Name>(f.robot) << 31 |
               static_cast<Name>(f.obstacle);
    }
    // Functions of which a curve's place is made, the same between any angles, and its range between the two that have been asked for
    // last: nothing if a denominator may be zero.
    struct KeptPlace {
        std::uint64_t owner = 0;
        Name curve = 0;
        int axis = -1;
        PlaceParts<Filtered> parts;
        double lo = 1, hi = 0;
        std::optional<Bounds> range;
    };
    KeptPlace& kept_place(const Feature& curve, int axis) const;
    CurvePlace<Bounds> place(const Feature& curve, int axis, const Between& in) const {
        return place_of_parts<Approx>(kept_place(curve, axis).parts, curve.branch, in);
    }
    std::optional<Bounds> kept_range(const Feature& curve, int axis, const Between& in) const;
    // Quadratic of an event in doubles, and its roots in the chart once they are asked for; null if its polynomial is of a higher
    // degree.
    struct KeptQuadratic {
        std::uint64_t owner = 0;
        Name first = 0, second = 0;
        bool is_quadratic = false;
        Filtered p;
        std::optional<bool> is_isolated = {};
        Few<std::array<double, 2>, 2> roots = {};
    };
    KeptQuadratic* kept_quadratic(const Feature& first, const Feature& second) const;
    // The same exactly, the polynomial, and its root between two doubles: near ties ask for few of them.
    struct KeptExactly {
        Name first = 0, second = 0;
        std::optional<Trig<RootSum>> quadratic;
        std::optional<NormedPoly> polynomial;
        double lo = 1, hi = 0;
        std::optional<LongRoot> root;
    };
    KeptExactly& kept_exactly(const Feature& first, const Feature& second) const;
    Vector turned(const Vec<Approx>& v, const Turned& at) const;

    const Scene& scene;
    Surface surface;
    double kappa;
    std::uint64_t number;  // of all orders that are made, so that none takes what another one has kept
    mutable std::vector<KeptExactly> exact;
};

}  // namespace cfree

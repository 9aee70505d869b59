// Exact location of poses: the closed surfaces of a boundary around a pose are those that the ray from it towards -x, at its
// orientation, crosses an odd number of times. Every crossing is the sign of a polynomial in tau at a rational number.
#pragma once
#include <memory>
#include <mutex>
#include <optional>
#include <span>

#include "cfree/forbidden/cell_complex.hpp"
#include "cfree/forbidden/tau_index.hpp"

namespace cfree {

// Position (X, Y) / W in the scene's integers, and the orientation tau = p / r in [-1, 1] of a chart; W, r > 0.
struct ExactPose {
    Int X, Y, W;
    int chart;
    Int p, r;
    // Exact pose of given doubles, in the user's units.
    static ExactPose from(double x, double y, int chart, double tau, const Int& scale);
};

class PointLocation {
public:
    // component: by trapezoid, its closed surface
    PointLocation(SharedBoundary boundary, std::vector<Index> component);

    // Components around every component, in order, and whether space is free just inside it.
    struct Nesting {
        std::vector<Index> start, around;
        std::vector<std::uint8_t> free_inside;
    };
    Nesting nesting() const;
    // A ray towards -x in general position, for every component, from a pose on one of its trapezoids: the trapezoids that it
    // crosses, and whether it begins on the left of that one, its forbidden side.
    struct Ray {
        ExactPose pose;
        Index from;
        bool is_on_left;
        std::vector<Index> crossed;
    };
    std::vector<Ray> rays() const;
    // Among grown shapes, a ray from just left of a trapezoid, and a pose just right of it, from which a ray crosses the same
    // trapezoids and this one; each attempt gives others, or nothing, and poses are closer by powers of four.
    std::optional<std::pair<Ray, ExactPose>> beside(Index trapezoid, int attempt, int closer) const;
    // Trapezoids that a ray from a pose crosses, just after its orientation or at it, in the order of crossing; and whether it
    // arrives at their left sides.
    struct Crossing {
        Index trapezoid;
        bool to_left;
    };
    std::vector<Crossing> in_order(const ExactPose& pose, const std::vector<Index>& crossed, bool after) const;

    // Cell of a pose, -1 if it is forbidden, from the cells that surfaces bound. On the boundary, the first cell bounded there.
    struct Cells {
        std::span<const Index> depth, cell;  // number of components around each component, the cell it bounds
        std::span<const std::uint8_t> free_inside;
        Index outside;                       // the cell inside no component
    };
    Index locate(const ExactPose& q, const Cells& cells) const;
    // Cell of a free pose, or on the boundary all cells that it bounds; -1 for a forbidden pose.
    std::vector<Index> cells_at(const ExactPose& q, const Cells& cells) const;
    // Cells of many poses in doubles, in the user's units.
    void locate(const double* xy, const int* chart, const double* tau, std::size_t count, int threads, const Cells& cells,
                Index* out) const;

    // Trapezoids at a pose: those that hold it, ends included, with -1 if one begins at its orientation, 1 if one ends
    // there, else 0; those that the ray from it towards -x crosses just after its orientation, once per crossing; and true if
    // none of these has a critical angle there.
    struct Nearby {
        std::vector<Index> on, crossed;
        std::vector<std::int8_t> end;
        bool generic = true;
    };
    Nearby nearby(const ExactPose& q) const;
    // Trapezoids that may hold a pose, by heights in doubles.
    std::vector<Index> at_height_of(const ExactPose& q) const;

    // Places where the line from a pose towards -x, at its orientation, crosses trapezoids other than its own: x = n / d in the
    // scene's integers, and whether space is free to the left. Nothing if a critical angle is on the line, or the pose is on
    // another trapezoid.
    struct Passage {
        Index trapezoid;
        Int n, d;
        bool is_free_before;
    };
    std::optional<std::vector<Passage>> passages(const ExactPose& q, Index own = -1) const;
    // A pose on a trapezoid, strictly between its angles and its curves, and whether space is free to the left of it; each
    // attempt gives another one, or nothing.
    std::optional<std::pair<ExactPose, bool>> pose_on(Index trapezoid, int attempt) const;

    // A critical angle as the only root of a polynomial in an interval; the polynomial is empty if both ends are the angle.
    const std::vector<Index>& components() const { return component; }
    // Interval no wider than 2^-bits around the first or last angle of a trapezoid; both ends are the angle if it is dyadic.
    std::array<Dyadic, 2> angle(Index trapezoid, bool last, unsigned bits) const;

private:
    struct View;
    enum class When { at, after };  // `at` the orientation, or just `after` it
    enum class By { tree, list };  // the list is faster for one question about a part
    Nearby look(const View& q, When when, Index own, By by = By::tree) const;
    void look_on(const View& q, Nearby& seen) const;
    std::vector<Index> surfaces(const std::vector<Index>& crossed) const;
    bool may_be_on(const Feature& contact, const View& q) const;
    bool is_on(Index k, const View& q, bool is_end) const;
    int order(bool of_end, Index k, const View& q) const;
    struct Probe;
    std::optional<Probe> probe(Index k, int attempt) const;
    // Extent of a trapezoid's segments while tau is in a part: heights, the left end, and the top of all below in the tree.
    struct Extent {
        double low, high, left, top;
        Index trapezoid;
    };
    Extent extent(Index k, double from, double to) const;
    static double plant(std::span<Extent> extents);
    std::span<const Extent> tree(Index part) const;
    // Trapezoids that the ray from a point towards -x may cross.
    template <class F>
    static void stab(std::span<const Extent> in, double x, double y, F&& report) {
        while (!in.empty()) {
            const std::size_t middle = in.size() / 2;
            const Extent& e = in[middle];
            if (e.top < y) return;
            stab(in.first(middle), x, y, report);
            if (e.low > y) return;
            if (e.high >= y && e.left <= x) report(e.trapezoid);
            in = in.subspan(middle + 1);
        }
    }
    // The same where shapes are grown (round_location.cpp).
    Nearby nearby_among_grown(const ExactPose& q) const;
    Nearby look_among_grown(const ExactPose& q) const;
    std::vector<Ray> rays_among_grown() const;
    Extent extent_among_grown(Index k, double from, double to) const;

    SharedBoundary boundary;
    const Scene& scene;
    const Patches& patches;
    const Trapezoids& trapezoids;
    std::vector<Index> component;
    TauIndex index;
    struct Part {
        std::once_flag once;
        std::vector<Extent> extents;
    };
    // Extents of each list of the index, made when a pose of its orientations is asked for first. Each is a tree: in order of
    // `low`, the root in the middle.
    std::unique_ptr<Part[]> parts;
};

}  // namespace cfree

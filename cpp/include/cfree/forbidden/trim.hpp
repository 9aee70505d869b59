// Trimming of one contact patch: the rest of it after all pillars have been subtracted.
//
// The patch's domain is (t, theta). A pillar Q = O_k (+) -R A_p covers, at each theta, one open interval of t: its bands on
// the patch. `live` starts as the whole domain and loses one band after another; it is a list of trapezoids, each
// bounded by two angles and two curves. Areas are closed and bands are open, so that parts without width can remain: a curve,
// a piece of the line at one angle, a point. Those are `thin`.
#pragma once
#include <algorithm>
#include <array>
#include <initializer_list>
#include <limits>
#include <utility>
#include <vector>

#include "cfree/predicates/predicates.hpp"

namespace cfree {

// A patch, one band and the four trapezoids it leaves; t grows to the right, theta upwards:
//
//     t = 0                            t = 1
//       +--------------------------------+ the patch's last angle
//       |              A                 |
//       |.......____________.............| the band's `to`
//       |      /            \            |
//       |  B  /     band     \     C     | covered: the open part between the band's curves `lower` and `upper`
//       |    /                \          |
//       |...+------------------+.........| the band's `from`
//       |              D                 |
//       +--------------------------------+ the patch's first angle
//
// B lies between the curve t = 0, its `lower`, and the band's lower curve, its `upper`; C between the band's upper curve and
// t = 1. A, B, C and D are closed. The two curves of a trapezoid may meet at its first or last angle.
//
// Parts without width remain where bands touch. The fields tell the kinds of parts apart:
//
//     part               | list | from, to  | lower, upper
//     trapezoid          | live | from < to | two curves
//     curve              | thin | from < to | the same curve
//     piece of the line  | thin | the same  | two curves; one point if they meet at this angle
//     point              | thin | the same  | the same curve
struct Trapezoid {
    Index patch = 0;
    int chart = 0;
    Feature lower, upper;  // the surfaces, or helices, that meet the patch in its two curves
    Event from, to;
    int from_place = 0, to_place = 0;  // see Predicates::place
};

// Range of a patch in slices, and the least and greatest live t in each; nothing is live if low > high.
struct Slices {
    static constexpr int most = 16;
    int count = 0;
    double kappa = 1;      // see Predicates
    double at[most + 1];   // tau; slice s is from at[s] to at[s + 1]
    double low[most], high[most];
    // Slices from one to another, both included.
    struct Part {
        int first, last;
        bool may_pinch;  // see Shadows
        bool empty() const { return first > last; }
    };
    void cut(double lo, double hi, int chart);
    // Meeting of the tangents at two rotations, x and y in tau; the arc between these is in the triangle of all three.
    Vec<double> corner(double x, double y) const {
        const double w = kappa / (1 + x * y);
        return {(1 - x * y) * w, (x + y) * w};
    }
};

// Lists of a trimmer. Each patch begins with empty ones; those of the patch before it have room already.
struct TrimLists {
    struct Span {
        Index from, to;  // events
    };
    struct Area {
        Index from, to, lower, upper;  // two events, two curves
        double t_min, t_max;           // bounds of its t
        double lower_max = std::numeric_limits<double>::infinity(), upper_min = -lower_max;  // of its curves, if known
        struct Side {
            Index curve;
            double min, max;  // bounds of its t
        };
        Side low() const { return {lower, t_min, lower_max}; }
        Side high() const { return {upper, upper_min, t_max}; }
    };
    std::vector<Event> events;
    std::vector<Curve> curves;
    std::vector<Index> slots;  // hash table of curves; -1: empty
    std::vector<Area> live, next, open;  // areas now, areas of the next state, and those of the next state without end
    std::vector<Area> thin, fresh;
    std::vector<Index> pinches;  // angles at which a pillar's edge touches the surface along the line
    std::vector<Span> todo;
    mutable std::vector<double> heights[2];  // scratch of state_at
    void clear();
};

class Trimmer : protected TrimLists {
public:
    // Start with the part of a patch between two angles of one chart.
    Trimmer(const Scene& scene, const Surface& surface, const Event& from, const Event& to, TrimLists lists = {});
    virtual ~Trimmer() = default;

    // Subtract the pillar of robot piece p and obstacle piece k, which covers nothing live outside this part.
    void cover(Index p, Index k, const Slices& slices, const Slices::Part& part);
    // Update the live range of each slice, if it has changed.
    void left(Slices& slices);
    // Subtract the part that another patch of the same surface owns, between two angles.
    void cede(const Feature& owner, const Event& from, const Event& to);
    // Cut the live areas along a helix, if they continue on both sides of it.
    void split(const Feature& helix);
    bool empty() const { return live.empty() && thin.empty(); }
    // Write the live areas in order, neighbours with the same curves joined; and the live parts without width: lower = upper or
    // from = to.
    void finish(Index patch, std::vector<Trapezoid>& out, std::vector<Trapezoid>& thin_out);
    // Give its lists to another one; it has no use afterwards.
    TrimLists released() { return std::move(static_cast<TrimLists&>(*this)); }

    Predicates decide;

protected:
    // With nothing live yet.
    Trimmer(const Scene& s, const Surface& on) : decide(s, on), scene(s), surface(on) {}
    // All between the first two events and the two ends.
    void fill();
    // An edge of the pillar: an obstacle edge with a robot vertex, or a robot edge with an obstacle vertex.
    struct PillarEdge {
        Feature feature;
        Index s0, v0, s1, v1;  // its first and last vertex b_v - R a_s
        Index around[2];       // edges of the other shape before and after its supporting vertex, -1 if it is a point
    };
    // A pillar at one orientation, and the patch's line through it or beside it; t grows upwards along the line:
    //
    //        never_left               crosses                never_right
    //
    //        ^                           ^                           ^
    //        |   +---+              +----|--upper-+       +---+      |
    //        |  /     \             |    |        |      /     \     |
    //        | (s,v)   |            |    |        |     |   (s,v)    |
    //        |  \     /             |    |        |      \     /     |
    //        |   +---+              +----|--lower-+       +---+      |
    //        |                           |                           |
    //
    //     meets       | no vertex is     | lower, upper            | curves         | s, v, robot_around, obstacle_around
    //     never_left  | left of the line | not set                 | not set        | of the vertex farthest to the left
    //     never_right | right of it      | not set                 | not set        | of the vertex farthest to the right
    //     crosses     |                  | the edges by which the  | both edges', by| not set
    //                 |                  | line enters and leaves  | `find_curves`  |
    //
    // One of the three holds at every orientation. A pillar whose vertices are all on the line is `never_left`. Only `crosses`
    // gives a band. In the others the vertex may touch the line; `lifetime` passes these angles to `pinches` or `meet`.
    enum class Meets { never_left, never_right, crosses };
    struct State {
        Meets meets;
        PillarEdge lower, upper;
        Index curves[2];
        Index s, v;
        Index robot_around[2], obstacle_around[2];  // edges before and after the vertex in each piece, -1 if it is a point
    };
    struct Condition {
        bool is_offset;
        Index robot, obstacle;
        int sign;
        bool may_vanish;  // an offset that is identically zero also counts
        Filtered value;
    };
    // holds: the span has been narrowed to where the state lives. wrong: a sign contradicts it. resample: a sign is zero at the
    // sample, which is a critical angle itself.
    enum class Verdict { holds, wrong, resample };
    // A part to take from a patch, in three kinds:
    //
    //     made by  | p, k           | state     | area                               | at its border
    //     add_band | of the pillar  | `crosses` | between the curves of two edges    | open: parts without width remain
    //     cede     | -1             | null      | between an owner's two helices     | closed: nothing without width remains
    //     split    | -1             | null      | lower = upper: a helix, no inside  | the trapezoids on both sides end there
    struct Band {
        Area area;
        Index p, k;
        const State* state;
    };

    // A band against an area, over the angles of both.
    struct Overlap {
        Overlap(const Area& of, const Band& with) : area(of), band(with) {}
        const Area& area;
        const Band& band;
        Index from = -1, to = -1;
        // Orders of the band's lower (upper) curve against the area's, and angles at which an order changes.
        enum Which { lower_to_upper, upper_to_lower, lower_to_lower, upper_to_upper };
        Predicates::Order orders[4];
        struct Cut {
            Index event;
            int which;
        };
        Few<Cut, 24> cuts;
        int position[4] = {0, 0, 0, 0};  // place among the signs of each order
        bool low_meets = false, high_meets = false;  // true if two lower, two upper curves meet at the last cut
        int sign(Which which) const { return orders[which].sign[position[which]]; }
    };
    // Coverage of an area by a band between two cuts: some of its inside; its lower, its upper curve. Both curves matter only
    // if `inside` is true.
    struct Cover {
        bool inside, low, high;
    };
    // A band against a curve of `thin`, between the angles where both are.
    struct CurveOverlap {
        CurveOverlap(const Area& thin_curve, const Band& taken) : curve(thin_curve), band(taken) {}
        const Area& curve;
        const Band& band;
        Index from = -1, to = -1;
        Predicates::Order low, high;  // the band's lower and its upper curve against this one
        struct Cut {
            Index event;
            bool is_low;
        };
        std::vector<Cut> cuts;  // the angles where one of the two orders changes
        std::size_t next = 0;   // the first cut that is still ahead
        int low_position = 0, high_position = 0;  // among the signs of each order
        bool is_covered() const { return low.sign[low_position] < 0 && high.sign[high_position] > 0; }
    };

    template <class T>
    class PillarView;
    template <class T>
    std::vector<T>* scratch() const;
    template <class T>
    State state_at(Index p, Index k, const Sample& at) const;
    Verdict lifetime(const State& state, const Sample& at, Span& span);
    bool holds_but_at_ends(const Condition& x, const Span& span) const;
    // Bounds of t of what may be live between two angles; the first is greater if nothing is.
    std::array<double, 2> live_between(double lo, double hi) const;
    bool is_beyond(const State& state, double low, double high, double lo, double hi);
    int conditions(const State& state, Condition* out, bool& wrong);
    bool lies_on_line(Index s, Index v) const;
    void find_curves(State& state);
    void add_band(const State& state, const Span& span, Index p, Index k);
    bool covers_at(const Band& band, Index event);
    // True if a band's end is that of a quadrant: the pillar covers more of the circle beyond it.
    bool goes_on_beyond(Index end_of_band) const { return curves[end_of_band].feature.kind == Kind::seam; }
    // Remember that something at the end of a quadrant, which a pillar covers, was between two angles.
    void stretch(Index from, Index to) { first_end = std::min(first_end, events[from].lo), last_end = std::max(last_end, events[to].hi); }
    virtual bool crosses_at(const Band& band, Index event);
    virtual int order_at(Index event, Index p, Index q);
    // Order of a band's end and a curve at an angle; `beyond` if the end has no place there, but the band goes on.
    virtual int order_of_end(Index event, Index end_of_band, Index curve, int) { return order_at(event, end_of_band, curve); }
    bool touches_along(const State& state) const;
    void cut_at(Index event);
    Index curve_of(const Feature& feature, bool flipped);
    Feature normal_form(const Feature& feature) const;
    virtual double extreme(const Curve& curve, double lo, double hi, bool want_max) const;
    virtual void bounds(Area& area) const;
    // Treatment of a band, and of a state in which the line does not pass through the pillar.
    virtual void take(const Band& band) { subtract(band); }
    virtual void pass(const State&, const Span&) {}
    // Treatment, in such a state, of an angle at which the nearest vertex just touches the line.
    virtual void meet(const State&, Index) {}
    void subtract(const Band& band);
    void subtract_from_live(const Band& band);
    bool may_meet(const Area& area, const Area& band) const;
    bool subtract_from(const Area& area, const Band& band);
    bool compare(Overlap& x);
    void sort_cuts(Overlap& x);
    void keep_around(const Overlap& x, Index start, const Cover& cover);
    void keep_touched_curves(const Overlap& x, Index start, Index end, const Cover& cover);
    void keep_at(const Overlap& x, Index at, const Cover* before_it, const Cover* after_it);
    void go_on(Index at, std::initializer_list<std::array<Index, 2>> parts, bool after_tip);
    void subtract_from_thin(const Band& band);
    void subtract_from_segment(const Area& segment, const Band& band);
    void subtract_from_curve(const Area& curve, const Band& band);
    bool compare(CurveOverlap& x);
    void sort_cuts(CurveOverlap& x);
    Index pass_cuts(CurveOverlap& x);
    void keep_pieces(CurveOverlap& x);
    bool leaves_point(const CurveOverlap& x, Index event);
    void add_thin(Index from, Index to, Index lower, Index upper) { fresh.push_back({from, to, lower, upper, 0, 1}); }
    Index intern(const Event& event);
    bool equal(Index x, Index y) { return x == y || decide.order(events[x], events[y]) == 0; }
    bool before(Index x, Index y) { return x != y && decide.order(events[x], events[y]) < 0; }

    const Scene& scene;
    Surface surface;
    Feature ends[2];  // the helices at t = 0 and t = 1
    double first_end = 2, last_end = -2;  // see `stretch`: pillars are looked at there as well, so that angles keep their names
    bool has_changed = true;   // true if the live areas have changed since the last `left`
    mutable std::vector<Ball> ball_heights[2];
    mutable std::vector<Int> exact_heights[2];
};

}  // namespace cfree

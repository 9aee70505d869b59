// Trimming of a patch among grown shapes: a pillar is a convex region of arcs and edges, and a patch is a line or a quadrant of a
// circle.
//
// A pillar's state is how the line, or the circle, enters and leaves it. It changes only where a joint of the features passes
// by which it does, where one of them appears or vanishes, or where they are touched; theory, "Rounded shapes".
#pragma once
#include <span>

#include "cfree/forbidden/trim.hpp"
#include "predicates/round_orders.hpp"

namespace cfree {

class RoundTrimmer final : public Trimmer {
public:
    // The part of a patch between two angles of one chart. A quadrant starts with the parts of it that are in the cones of its
    // two vertices; a joint with an edge of obstacles at its centre bounds it also if it is in an end of the quadrant.
    RoundTrimmer(const Scene& scene, const Surface& surface, const Event& from, const Event& to, const std::vector<Index>& edges_at_centre);
    // Subtract the pillar of robot piece p and obstacle piece k, which covers nothing outside these slices.
    void cover(Index p, Index k, const Slices& slices, const Slices::Part& part);
    // Subtract what is forbidden by a fillet, of the robot or else of the obstacles, and a vertex of the other shape; if that is a
    // convex arc, where the fillet is in its directions.
    void cover_fillet(const Shape::Fillet& fillet, bool of_robot, Index vertex, const Shape::Wedge* directions, const Slices& slices,
                      const Slices::Part& part);
    // Subtract what another pair of vertices with the same circle owns of the quadrant.
    void cede_circle(const Feature& owner);
    // Cut what is live where others touch from the free side: along curves, at every angle, or at one angle along a segment. These are
    // of the pieces near the patch.
    void split_at_touches(const std::vector<Index>& pieces);

private:
    struct Touch;
    std::vector<Touch> touches(const std::vector<Index>& pieces) const;
    void find_pinches(const std::vector<Index>& pieces);
    // A pillar at a sample: arcs[k] is followed counter-clockwise by edges[k]. A point has one arc and no edge.
    struct Arc {
        Index s, v;
        Feature circle() const { return {Kind::vertex_vertex, s, v}; }
    };
    struct Edge {
        Feature line;
        Index around[2];  // edges of the other shape before and after its supporting vertex, -1 if it is a point
    };
    struct Pillar {
        std::vector<Arc> arcs;
        std::vector<Edge> edges;
        bool has_arcs = false;  // true if a piece has one that is an arc of its shape
        int count() const { return static_cast<int>(edges.size()); }
        // By any number, once around and again.
        const Edge& edge(int k) const { return edges[static_cast<std::size_t>(k + count()) % edges.size()]; }
        Feature circle(int k) const { return arcs[static_cast<std::size_t>(k) % arcs.size()].circle(); }
    };
    struct Joint {
        int edge, arc;
    };
    // A sign that holds as long as a state does.
    struct Watch {
        Feature first, second;  // see Event
        int sign;
        bool may_vanish;
    };
    // A curve by which the circle enters the pillar, or leaves it.
    struct Crossing {
        Feature curve;
        bool enters;
    };
    struct Cover {
        std::vector<std::array<Feature, 2>> bands;
        std::vector<Watch> watched;
        std::vector<std::array<Feature, 2>> left_out = {};  // parts that the bands do not cover, in order
        std::optional<std::vector<std::array<Feature, 2>>> within = {};  // parts outside of which they cover nothing
        void clear() { bands.clear(), watched.clear(), left_out.clear(), within.reset(); }
    };
    template <class Find>
    void cover_by(Index p, Index k, const Slices& slices, const Slices::Part& part, const Find& find);
    bool is_left_between(const Span& span) const;
    void take_part(const std::array<Feature, 2>& band, const Cover& cover, const Span& span);
    bool shape(Index p, Index k, const Sample& at, Pillar& out);
    bool has_extent(const Feature& circle) const;  // its radius is not 0
    bool is_stub(const Feature& line) const;
    bool is_opposite(const Feature& circle) const;
    Feature circle_of(const Pillar& pillar, const Joint& joint) const;
    std::optional<int> known_sign(const Feature& line, const Feature& circle) const;
    Joint joint(const Pillar& pillar, int k) const;
    void watch_joint(const Pillar& pillar, int k, int sign, Cover& out) const;
    void watch_edge(const Edge& edge, Cover& out) const;
    void watch_arc(const Pillar& pillar, int k, Cover& out) const;
    void watch_direction(const Feature& line, int sign, Cover& out) const;
    Feature feature_after(const Pillar& pillar, int joint, int branch) const;
    const std::vector<int>& joint_signs(const Pillar& pillar, const Sample& at);
    std::optional<std::array<Feature, 2>> crossed_once(const Pillar& pillar, const std::vector<int>& sign, int before, Cover& out) const;
    // To an empty cover.
    void on_line(const Pillar& pillar, const Sample& at, Cover& out);
    void on_circle(const Pillar& pillar, const Sample& at, Cover& out);
    void on_any_circle(const Pillar& pillar, const std::vector<int>& sign, const Sample& at, Cover& out);
    std::array<Feature, 2> foot(const Pillar& pillar, int edge, int arc) const;
    int foot_sign(const Pillar& pillar, int edge, int arc, const Sample& at);
    void watch_cone(const Pillar& pillar, int k, Cover& out) const;
    void clip(std::span<const Crossing> crossings, const Sample& at, Cover& out);
    void clip_between(const Feature& enters, const Feature& leaves, const Sample& at, Cover& out);
    void turn_bands(Cover& out) const;
    bool narrow(Cover& cover, const Sample& at, Span& span);
    int cross_with_line(const Feature& line, const Sample& at);
    std::array<Feature, 2> quadrant() const;
    std::array<Feature, 2> ends_of_quadrant() const;
    std::vector<Area> in_cones(const Feature& contact);
    std::vector<Span> spans_between(std::vector<Event> cuts, Index first = 0, Index last = 1);
    bool crosses_at(const Band& band, Index event) override;
    int order_at(Index event, Index p, Index q) override;
    int order_of_end(Index event, Index end_of_band, Index curve, int beyond) override;
    void bounds(Area& area) const override;
    double extreme(const Curve& curve, double lo, double hi, bool want_max) const override;

    int sign_of(const Feature& first, const Feature& second, const Sample& at);

    const RoundOrders& orders;
    const std::vector<Index>& edges_at_centre;
    const bool has_arcs;       // true if a shape has
    const bool has_concave;    // true if a shape has concave ones
    const bool is_concave;     // true if the surface is of one: its circle is free inside
    bool is_critical = false;  // true if the sample is itself a critical angle
    // Of the last state, kept for their memory.
    Pillar pillar;
    std::vector<int> signs;  // of joint_signs
    Cover found;
};

}  // namespace cfree

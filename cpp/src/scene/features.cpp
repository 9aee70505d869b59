// Number points, lines and directions; put frames around bounds and workspace; theory, "Surfaces that coincide".
#include "cfree/scene/features.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "scene/facing_arcs.hpp"

namespace cfree {

namespace {

constexpr int far = 1 << 10;       // in sizes: shapes farther away are measured from a place near them
constexpr int largest_bits = 100;  // bits of the core's doubles: products of four of their products stay finite

struct Box {
    Int x0, y0, x1, y1;
    void add(const Int& x, const Int& y) {
        if (x < x0) x0 = x;
        if (x > x1) x1 = x;
        if (y < y0) y0 = y;
        if (y > y1) y1 = y;
    }
    Box grown(const Int& radius) const { return {x0 - radius, y0 - radius, x1 + radius, y1 + radius}; }
};

Box box_of(const std::vector<Int>& x, const std::vector<Int>& y) {
    Box box{x[0], y[0], x[0], y[0]};
    for (std::size_t k = 1; k < x.size(); ++k) box.add(x[k], y[k]);
    return box;
}

// A step for numbers that should rarely change with the scene: the least power of two, in units of the user, of at least an
// eighth of a box's longer side; but a multiple of the denominator's fraction.
Int coarse_step(const Box& box, const Int& scale) {
    const Int size = std::max(Int(box.x1 - box.x0), Int(box.y1 - box.y0));
    Int step = scale >> lsb(scale);
    while (8 * step < size) step <<= 1;
    return step;
}

// The box with a margin, then outwards to multiples of a step.
Box outwards(const Box& box, const Int& margin, const Int& step) {
    const auto down = [&](const Int& c) { return Int(floor_divide(c - margin, step) * step); };
    const auto up = [&](const Int& c) { return Int(-floor_divide(-c - margin, step) * step); };
    return {down(box.x0), down(box.y0), up(box.x1), up(box.y1)};
}

Points rectangle(const Int& x0, const Int& y0, const Int& x1, const Int& y1) { return {{x0, x1, x1, x0}, {y0, y0, y1, y1}}; }

// A radius times the common denominator.
Int scaled(const Ratio& radius, const Int& scale) { return radius.n * (scale / radius.d); }

// An edge of a shape with arcs; see Shape.
struct ArcEdge {
    Index v, w, first, last;
    bool is_stub = false;
    Index ring = -1;  // of a piece: its number as an edge of a ring, if it is one
};

// Order of radii: from 0 on, then those below 0.
bool is_before(const Int& x, const Int& y) { return (x.sign() < 0) != (y.sign() < 0) ? y.sign() < 0 : x < y; }

// Builder of a shape from polygons. Its rings' vertices come first; others, ends of arcs and of stubs, are put behind them in the
// end, and are numbered from -1 downwards until then.
struct Builder {
    const Int& scale;
    std::vector<Int> radii{0};  // that occur, in order
    std::vector<Index> vertex_radius;
    std::vector<Int> x, y;
    std::vector<Index> next, previous, layer, piece{0}, piece_vertex, piece_layer;
    Owners owners;
    std::vector<char> convex, emit;
    // Only of polygons with arcs: other vertices and their radii; edges of rings by the vertices where they start, and of pieces by
    // the places of these; vertices that are arcs.
    std::vector<Vec<Int>> others;
    std::vector<Index> other_radius;
    std::map<Index, ArcEdge> ring_edges;
    std::map<std::size_t, ArcEdge> piece_edges;
    std::vector<Index> arcs;
    // Of concave arcs: their vertices, the vertices at their ends, their fillets without edges, and stubs at their ends.
    std::vector<Index> concave, concave_ends;
    std::vector<Shape::Fillet> fillets;
    std::vector<ArcEdge> more_stubs;
    // Of convex arcs that face concave ones.
    std::vector<Shape::Wedge> wedges;
    std::vector<Shape::Probe> probes;

    explicit Builder(const Int& common) : scale(common) {}

    void reserve(const std::vector<std::shared_ptr<const Polygon>>& polygons) {
        std::size_t total = 0;
        for (const auto& polygon : polygons) total += static_cast<std::size_t>(polygon->vertices.size());
        x.reserve(total), y.reserve(total);
    }

    Index count() const { return static_cast<Index>(x.size()); }

    // Number the radii that occur, and those of the other shape times -1 where they meet fillets; before polygons are added.
    void number_radii(const std::vector<Rounding>& all, const FacingArcs& other) {
        bool has_fillets = false, has_arcs = false;
        for (const Rounding& rounding : all) {
            radii.push_back(scaled(rounding.radius, scale));
            for (const Arc& arc : rounding.arcs) {
                const Int radius = scaled(arc.radius, scale);
                radii.push_back(scaled(rounding.radius, scale) + (arc.beyond ? Int(-radius) : radius));
                (arc.beyond ? has_fillets : has_arcs) = true;
            }
        }
        if (has_fillets)
            for (const auto* list : {&other.discs, &other.arcs})
                for (const Ratio& radius : *list) radii.push_back(-scaled(radius, scale));
        if (has_arcs)
            for (const Ratio& radius : other.hollows) radii.push_back(scaled(radius, scale));
        facing = &other;
        std::sort(radii.begin(), radii.end(), is_before);
        radii.erase(std::unique(radii.begin(), radii.end()), radii.end());
    }
    const FacingArcs* facing = nullptr;  // radii of the other shape
    bool is_round() const { return radii.size() > 1; }
    const Int& radius(Index v) const { return radii[vertex_radius[v]]; }
    Index class_of(const Int& radius) const {
        return static_cast<Index>(is_round() ? std::lower_bound(radii.begin(), radii.end(), radius, is_before) - radii.begin() : 0);
    }

    // Set the class of the radius of the latest vertices.
    void set_radius(Index radius_class) { vertex_radius.resize(x.size(), radius_class); }

    // Close a ring of the latest vertices, from `first` on.
    void close_ring(Index first) {
        const Index n = count() - first;
        for (Index k = 0; k < n; ++k)
            next.push_back(first + (k + 1) % n), previous.push_back(first + (k + n - 1) % n);
    }

    Index add_vertex(const Int& at_x, const Int& at_y, bool is_convex, bool emits, Index owner, Index number) {
        x.push_back(at_x), y.push_back(at_y);
        convex.push_back(is_convex), emit.push_back(emits), layer.push_back(body_layer);
        owners.polygon.push_back(owner), owners.vertex.push_back(number);
        return count() - 1;
    }
    Index add_other(const Vec<Int>& p, Index radius_class, Index owner) {
        others.push_back(p);
        other_radius.push_back(radius_class), owners.polygon_of_end.push_back(owner);
        return -static_cast<Index>(others.size());
    }

    template <class Owner>
    void add_polygon(const Polygon& polygon, const Rounding& rounding, Index owner, bool emit_outer, Owner owner_of) {
        if (!rounding.arcs.empty()) return add_with_arcs(polygon, rounding, owner, emit_outer, owner_of);
        const Int factor = scale / polygon.denominator;
        const Index first = count();
        for (std::size_t r = 0; r + 1 < polygon.offsets.size(); ++r) {
            const Index start = count();
            for (Index k = polygon.offsets[r]; k < polygon.offsets[r + 1]; ++k)
                add_vertex(polygon.vertices.X(k) * factor, polygon.vertices.Y(k) * factor, polygon.convex[k], emit_outer || r > 0, owner,
                           owner_of(r, k));
            close_ring(start);
        }
        set_radius(class_of(scaled(rounding.radius, scale)));
        for (const auto& vertices : polygon.pieces()) {
            for (const Index v : vertices) piece_vertex.push_back(first + v);
            close_piece(body_layer);
        }
    }

    void number_others();
    template <class Owner>
    void add_with_arcs(const Polygon& polygon, const Rounding& rounding, Index owner, bool emit_outer, Owner owner_of);

    void close_piece(Index of_layer) {
        piece.push_back(static_cast<Index>(piece_vertex.size()));
        piece_layer.push_back(of_layer);
    }

    // Add vertices of the bounds as a ring.
    void add_bound_ring(const Points& ring, bool is_convex) {
        const Index start = count();
        for (Index k = 0; k < ring.size(); ++k) {
            x.push_back(ring.X(k)), y.push_back(ring.Y(k));
            convex.push_back(is_convex), emit.push_back(1), layer.push_back(reference_layer);
            owners.polygon.push_back(bounds_owner), owners.vertex.push_back(k);
        }
        close_ring(start);
    }
};

// Put the other vertices behind those of rings and bounds.
void Builder::number_others() {
    const auto numbered = [base = count()](Index& v) {
        if (v < 0) v = base - 1 - v;
    };
    for (Index k = 0; k < static_cast<Index>(others.size()); ++k) {
        x.push_back(others[k].x), y.push_back(others[k].y);
        vertex_radius.push_back(other_radius[k]);
    }
    for (Index& v : piece_vertex) numbered(v);
    for (auto& [e, edge] : ring_edges) numbered(edge.v), numbered(edge.w);
    for (auto& [k, edge] : piece_edges) numbered(edge.v), numbered(edge.w), numbered(edge.first), numbered(edge.last);
    for (ArcEdge& edge : more_stubs) numbered(edge.v), numbered(edge.w), numbered(edge.first), numbered(edge.last);
    for (Shape::Fillet& fillet : fillets)
        for (Index& v : fillet.vertex) numbered(v);
    for (Shape::Wedge& triangle : wedges)
        for (Index& v : triangle.vertex) numbered(v);
    for (Shape::Probe& probe : probes) numbered(probe.vertex);
    for (Index& v : concave_ends) numbered(v);
}

// The ring has a vertex for each corner and for each arc, its centre. Where an arc is smooth with its neighbour there is no corner.
// A convex piece for each convex arc, between it and its chord, joins those of the polygon; a concave arc has a fillet.
template <class Owner>
void Builder::add_with_arcs(const Polygon& polygon, const Rounding& rounding, Index owner, bool emit_outer, Owner owner_of) {
    const Int factor = scale / polygon.denominator, grown = scaled(rounding.radius, scale);
    const Index at_corner = class_of(grown), count_of_points = polygon.vertices.size();
    std::vector<Vec<Int>> points;
    for (Index k = 0; k < count_of_points; ++k) points.push_back({polygon.vertices.X(k) * factor, polygon.vertices.Y(k) * factor});
    const auto place = [&](const RatioPoint& p) { return Vec<Int>{scaled(p.x, scale), scaled(p.y, scale)}; };
    const auto key = [](const Vec<Int>& p, const Vec<Int>& q) { return std::array{p.x, p.y, q.x, q.y}; };
    std::map<std::array<Int, 4>, const Arc*> arc_of;
    for (const Arc& arc : rounding.arcs) arc_of[key(place(arc.from), place(arc.beyond ? (*arc.beyond)[0] : arc.to))] = &arc;
    struct Side {
        Index from, to;  // points; to is -1 if from is the vertex between the sides of a concave arc
        const Arc* arc;
        Vec<Int> centre;
        Index vertex = 0;                // of the arc
        std::array<Vec<Int>, 2> towards;  // directions at its ends
    };
    std::vector<Side> sides;  // by their first points
    std::vector<char> is_beyond(static_cast<std::size_t>(count_of_points));
    for (std::size_t r = 0; r + 1 < polygon.offsets.size(); ++r)
        for (Index k = polygon.offsets[r]; k < polygon.offsets[r + 1]; ++k) {
            const Index to = k + 1 < polygon.offsets[r + 1] ? k + 1 : polygon.offsets[r];
            const auto arc = arc_of.find(key(points[k], points[to]));
            is_beyond[to] = arc != arc_of.end() && arc->second->beyond;
        }
    std::vector<Index> before(static_cast<std::size_t>(count_of_points));
    std::size_t matched = 0;
    for (std::size_t r = 0; r + 1 < polygon.offsets.size(); ++r)
        for (Index k = polygon.offsets[r]; k < polygon.offsets[r + 1]; ++k) {
            const auto after = [&](Index p) { return p + 1 < polygon.offsets[r + 1] ? p + 1 : polygon.offsets[r]; };
            if (is_beyond[k]) {
                sides.push_back({k, -1, nullptr, {}, 0, {}});
                continue;
            }
            Index to = after(k);
            const auto arc = arc_of.find(key(points[k], points[to]));
            if (arc != arc_of.end() && arc->second->beyond) to = after(to);
            Side side{k, to, arc == arc_of.end() ? nullptr : arc->second, {}, 0, {points[to] - points[k], points[to] - points[k]}};
            if (side.arc) {
                side.centre = place(side.arc->centre);
                for (const int end : {0, 1}) {
                    const Vec<Int> from_centre = points[end ? to : k] - side.centre;
                    Vec<Int>& towards = side.towards[static_cast<std::size_t>(end)];
                    towards = {-from_centre.y, from_centre.x};
                    if (side.arc->beyond) towards = {-towards.x, -towards.y};
                }
                ++matched;
            }
            sides.push_back(side), before[to] = k;
        }
    if (matched != rounding.arcs.size()) throw BrokenInvariant("an arc that is no side of its polygon");
    // vertices of the rings: of each point, if it is a corner, and of each arc
    std::vector<Index> vertex(static_cast<std::size_t>(count_of_points));
    std::vector<char> is_corner(vertex.size());
    const Index first = count();
    for (std::size_t r = 0; r + 1 < polygon.offsets.size(); ++r) {
        const Index start = count();
        for (Index k = polygon.offsets[r]; k < polygon.offsets[r + 1]; ++k) {
            if (is_beyond[k]) continue;
            Side &in = sides[before[k]], &out = sides[k];
            const Int turn = cross(in.towards[1], out.towards[0]);
            is_corner[k] = (!in.arc && !out.arc) || !turn.is_zero() || dot(in.towards[1], out.towards[0]).sign() < 0;
            if (is_corner[k]) {
                vertex[k] = add_vertex(points[k].x, points[k].y, turn.sign() >= 0, emit_outer || r > 0, owner, owner_of(r, count() - first));
                vertex_radius.push_back(at_corner);
            }
            if (!out.arc) continue;
            const bool is_convex = !out.arc->beyond;
            out.vertex = add_vertex(out.centre.x, out.centre.y, is_convex, emit_outer || r > 0, owner, owner_of(r, count() - first));
            const Int radius = scaled(out.arc->radius, scale);
            vertex_radius.push_back(class_of(is_convex ? Int(grown + radius) : Int(grown - radius)));
            arcs.push_back(out.vertex);
            if (!is_convex) concave.push_back(out.vertex);
        }
        close_ring(start);
    }
    for (Index k = 0; k < count_of_points; ++k)
        if (!is_corner[k]) vertex[k] = add_other(points[k], at_corner, owner);
    const auto stub = [&](Index k, const Vec<Int>& towards, Index first, Index last) {
        return ArcEdge{vertex[k], add_other({points[k].x + towards.x, points[k].y + towards.y}, at_corner, owner), first, last, true};
    };
    const auto begin = [&](const Side& side) { return is_corner[side.from] ? vertex[side.from] : sides[before[side.from]].vertex; };
    for (const Side& in : sides) {  // edges of the rings
        if (in.to < 0) continue;
        const Index to = in.to;
        const Side& out = sides[to];
        const Index last = is_corner[to] ? vertex[to] : out.vertex;
        if (!in.arc) ring_edges[begin(in)] = {vertex[in.from], vertex[to], begin(in), last};
        else if (is_corner[to] || out.arc) ring_edges[in.vertex] = stub(to, in.towards[1], in.vertex, last);
        if (out.arc && is_corner[to]) ring_edges[vertex[to]] = stub(to, out.towards[0], vertex[to], out.vertex);
    }
    for (const auto& corners : polygon.pieces()) {
        for (std::size_t n = 0; n < corners.size(); ++n) {
            const Index k = corners[n], to = corners[n + 1 < corners.size() ? n + 1 : 0];
            const bool is_side = sides[k].to == to && !sides[k].arc;
            piece_edges[piece_vertex.size()] = {vertex[k], vertex[to], vertex[k], vertex[to], false, is_side ? begin(sides[k]) : -1};
            piece_vertex.push_back(vertex[k]);
        }
        close_piece(body_layer);
    }
    for (const Side& side : sides) {
        if (!side.arc) continue;
        if (side.arc->beyond) {
            more_stubs.push_back(stub(side.from, side.towards[0], vertex[side.from], side.vertex));
            more_stubs.push_back(stub(side.to, side.towards[1], side.vertex, vertex[side.to]));
            concave_ends.insert(concave_ends.end(), {vertex[side.from], vertex[side.to]});
            for (const auto& [radius, is_for_arcs, corners] : quadrangles(*side.arc, rounding.radius, *facing)) {
                Shape::Fillet fillet{side.vertex, {}, {}, is_for_arcs};
                for (std::size_t n = 0; n < 4; ++n) fillet.vertex[n] = add_other(place(corners[n]), class_of(-scaled(radius, scale)), owner);
                fillets.push_back(fillet);
            }
            continue;
        }
        piece_edges[piece_vertex.size()] = stub(side.to, side.towards[1], side.vertex, vertex[side.to]);
        piece_vertex.push_back(side.vertex);
        piece_edges[piece_vertex.size()] = {vertex[side.to], vertex[side.from], vertex[side.to], vertex[side.from]};
        piece_vertex.push_back(vertex[side.to]);
        piece_edges[piece_vertex.size()] = stub(side.from, side.towards[0], vertex[side.from], side.vertex);
        piece_vertex.push_back(vertex[side.from]);
        close_piece(body_layer);
        if (!facing->has_concave()) continue;
        for (const Index end : {side.from, side.to}) probes.push_back({vertex[end], side.vertex});
        for (const auto& [hollow, corners] : cfree::wedges(*side.arc, rounding.radius, *facing)) {
            Shape::Wedge triangle{side.vertex, {}, {}};
            for (std::size_t n = 0; n < 3; ++n) triangle.vertex[n] = add_other(place(corners[n]), class_of(scaled(hollow, scale)), owner);
            wedges.push_back(triangle);
        }
        for (const RatioPoint& p : cfree::probes(*side.arc, rounding.radius, *facing))
            probes.push_back({add_other(place(p), at_corner, owner), side.vertex});
    }
}

// Number items in order of appearance, equal ones alike; `before` orders them.
template <class Before>
std::vector<Index> classes(std::size_t count, Before before) {
    std::vector<Index> order(count), number(count);
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), before);
    std::vector<Index> first(count);  // least of equal items
    for (std::size_t k = 0, beyond; k < count; k = beyond) {
        Index least = order[k];
        for (beyond = k + 1; beyond < count && !before(order[k], order[beyond]); ++beyond) least = std::min(least, order[beyond]);
        for (std::size_t m = k; m < beyond; ++m) first[order[m]] = least;
    }
    Index known = 0;
    for (std::size_t k = 0; k < count; ++k) number[k] = first[k] == static_cast<Index>(k) ? known++ : number[first[k]];
    return number;
}

// Place of each of the first items among those of its group, by a pair of keys, then by number.
template <class Key>
std::vector<Index> ranks(const std::vector<Index>& group, std::size_t count, Key key) {
    std::vector<Index> order(count), rank(count);
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
        if (group[a] != group[b]) return group[a] < group[b];
        const auto one = key(a), other = key(b);
        return one != other ? one < other : a < b;
    });
    for (std::size_t k = 1; k < count; ++k)
        rank[order[k]] = group[order[k]] == group[order[k - 1]] ? rank[order[k - 1]] + 1 : 0;
    return rank;
}

// Number of places before that of each vertex.
std::vector<Index> place_orders(const Points& points) {
    std::vector<Index> order(static_cast<std::size_t>(points.size())), place(order.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](Index p, Index q) { return points.before(p, q); });
    for (std::size_t k = 1; k < order.size(); ++k) place[order[k]] = place[order[k - 1]] + !points.same(order[k - 1], order[k]);
    return place;
}

// Add radii and lengths, without their doubles, and where circles of arcs touch. Returned for each edge is a key, the same for edges of one direction whose
// lines, moved outwards by their radii s, are one: their offset times |D|, v x D + s |D|, for the least integer vector D along
// the edge. If |D| is irrational the two parts are equal only one by one, and are a pair.
std::vector<std::pair<Int, Int>> add_radii(Shape& s, Builder& from, const Points& points) {
    for (const Int& radius : from.radii) s.radii.push_back({radius, {}});
    s.vertex_radius = std::move(from.vertex_radius);
    std::vector<std::pair<Int, Int>> keys(s.v.size());
    s.lengths.resize(s.v.size());
    for (Index e = 0; e < static_cast<Index>(s.v.size()); ++e) {
        const Index v = s.v[e], w = s.w[e];
        if (points.same(v, w)) continue;
        const Vec<Int> E{points.X(w) - points.X(v), points.Y(w) - points.Y(v)};
        const Int divisor = gcd(abs(E.x), abs(E.y)), &radius = s.radius_of(v).exact;
        const Vec<Int> D{E.x / divisor, E.y / divisor};
        const Int square = dot(D, D), root = root_below(square), offset = cross(Vec<Int>{points.X(v), points.Y(v)}, D);
        const bool is_rational = root * root == square;
        s.lengths[e] = is_rational ? Length{divisor * root, 1, {}} : Length{divisor, square, {}};
        keys[e] = is_rational ? std::pair{Int(offset + radius * root), Int(0)} : std::pair{offset, radius};
    }
    return keys;
}

// Enter which vertices are arcs, and where circles touch in joints of stubs.
void add_touches(Shape& s, const std::vector<Index>& arcs) {
    s.is_arc.assign(s.point.size(), 0);
    for (const Index v : arcs) s.is_arc[v] = 1;
    for (Index e = 0; e < static_cast<Index>(s.v.size()); ++e) {
        if (!s.stub[e]) continue;
        const std::array points{s.point[s.v[e]], s.point[s.first[e]], s.point[s.last[e]]};
        for (const auto& [p, q] : {std::pair{points[0], points[1]}, {points[0], points[2]}, {points[1], points[2]}})
            if (p != q) s.touches.push_back({std::min(p, q), std::max(p, q), e});
    }
    std::sort(s.touches.begin(), s.touches.end());
    s.touches.erase(std::unique(s.touches.begin(), s.touches.end(), [](const auto& x, const auto& y) {
        return x.first == y.first && x.second == y.second;
    }), s.touches.end());
}

Shape finished(Builder&& from, int shift, bool is_round) {
    Shape s;
    from.number_others();
    Points points(std::move(from.x), std::move(from.y));
    s.ring_vertices = static_cast<Index>(from.next.size());
    s.v.resize(from.next.size()), s.w = from.next;
    std::iota(s.v.begin(), s.v.end(), 0);
    if (!from.arcs.empty()) s.first = s.v, s.last = s.w, s.stub.assign(s.v.size(), 0);
    const auto set_edge = [&](Index e, const ArcEdge& edge) {
        s.v[e] = edge.v, s.w[e] = edge.w, s.first[e] = edge.first, s.last[e] = edge.last, s.stub[e] = edge.is_stub;
    };
    for (const auto& [e, edge] : from.ring_edges) set_edge(e, edge);
    // pieces run along edges of rings and along diagonals, each in one direction once
    for (std::size_t p = 0; p + 1 < from.piece.size(); ++p)
        for (Index k = from.piece[p]; k < from.piece[p + 1]; ++k) {
            if (const auto given = from.piece_edges.find(static_cast<std::size_t>(k)); given != from.piece_edges.end()) {
                const ArcEdge& edge = given->second;
                s.piece_edge.push_back(edge.ring >= 0 ? edge.ring : static_cast<Index>(s.v.size()));
                if (edge.ring >= 0) continue;
                for (auto* column : {&s.v, &s.w, &s.first, &s.last}) column->push_back(0);
                s.stub.push_back(0);
                set_edge(s.piece_edge.back(), edge);
                continue;
            }
            const Index v = from.piece_vertex[k], w = from.piece_vertex[k + 1 < from.piece[p + 1] ? k + 1 : from.piece[p]];
            if (v < s.ring_vertices && from.next[v] == w) {
                s.piece_edge.push_back(v);
            } else {
                s.piece_edge.push_back(static_cast<Index>(s.v.size()));
                s.v.push_back(v), s.w.push_back(w);
                if (!from.arcs.empty()) s.first.push_back(v), s.last.push_back(w), s.stub.push_back(0);
            }
        }
    const auto add_edge = [&](const ArcEdge& edge) {
        for (auto* column : {&s.v, &s.w, &s.first, &s.last}) column->push_back(0);
        s.stub.push_back(0);
        set_edge(static_cast<Index>(s.v.size()) - 1, edge);
    };
    for (const ArcEdge& edge : from.more_stubs) add_edge(edge);
    const auto add_sides = [&](auto& figure) {
        for (std::size_t n = 0; n < figure.vertex.size(); ++n) {
            const Index v = figure.vertex[n], w = figure.vertex[(n + 1) % figure.vertex.size()];
            figure.edge[n] = static_cast<Index>(s.v.size());
            add_edge({v, w, v, w});
        }
    };
    for (Shape::Fillet& fillet : from.fillets) add_sides(fillet);
    for (Shape::Wedge& triangle : from.wedges) add_sides(triangle);
    if (!from.concave.empty()) {
        s.concave.assign(static_cast<std::size_t>(s.ring_vertices), 0);
        for (const Index v : from.concave) s.concave[v] = 1;
    }
    s.fillets = std::move(from.fillets), s.fillet_ends = std::move(from.concave_ends);
    s.wedges = std::move(from.wedges), s.probes = std::move(from.probes);
    std::sort(s.fillet_ends.begin(), s.fillet_ends.end());
    s.fillet_ends.erase(std::unique(s.fillet_ends.begin(), s.fillet_ends.end()), s.fillet_ends.end());
    const std::vector<Index> place = place_orders(points);
    const auto low = [&](Index e) { return place[s.v[e]] < place[s.w[e]] ? s.v[e] : s.w[e]; };
    const auto high = [&](Index e) { return place[s.v[e]] < place[s.w[e]] ? s.w[e] : s.v[e]; };
    // upright vectors along the edges, and the origin: their doubles have all digits
    std::vector<Int> along_x, along_y;
    along_x.reserve(s.v.size() + 1), along_y.reserve(s.v.size() + 1);
    for (Index e = 0; e < static_cast<Index>(s.v.size()); ++e) {
        along_x.push_back(points.X(high(e)) - points.X(low(e)));
        along_y.push_back(points.Y(high(e)) - points.Y(low(e)));
    }
    along_x.push_back(0), along_y.push_back(0);
    const Points vectors(std::move(along_x), std::move(along_y));
    const auto origin = static_cast<Index>(s.v.size());
    std::vector<std::pair<Int, Int>> offset_line;
    if (is_round) offset_line = add_radii(s, from, points);
    s.point = classes(place.size(), [&](Index p, Index q) {
        return place[p] != place[q] ? place[p] < place[q] : is_round && s.vertex_radius[p] < s.vertex_radius[q];
    });
    s.direction = classes(s.v.size(), [&](Index e, Index f) {
        if (!s.has_extent(e) || !s.has_extent(f)) return !s.has_extent(e) && s.has_extent(f);
        return vectors.turn(origin, e, origin, f) > 0;
    });
    s.line = classes(s.v.size(), [&](Index e, Index f) {
        if (s.direction[e] != s.direction[f]) return s.direction[e] < s.direction[f];
        if (!s.has_extent(e)) return e < f;
        const bool backward = low(e) != s.v[e], other_backward = low(f) != s.v[f];
        if (backward != other_backward) return other_backward;
        return is_round ? offset_line[e] < offset_line[f] : points.orient(low(e), high(e), low(f)) > 0;
    });
    // geometry, not numbering, decides the owner of coinciding features
    const std::size_t rings = from.next.size();
    s.vertex_rank = ranks(s.point, rings, [&](Index v) { return std::pair(place[from.next[v]], place[from.previous[v]]); });
    s.edge_rank = ranks(s.line, rings, [&](Index e) { return std::pair(place[s.v[e]], place[s.w[e]]); });
    if (!from.arcs.empty()) add_touches(s, from.arcs);
    s.previous = std::move(from.previous), s.layer = std::move(from.layer);
    s.convex = std::move(from.convex), s.emit = std::move(from.emit);
    s.piece = std::move(from.piece), s.piece_vertex = std::move(from.piece_vertex), s.piece_layer = std::move(from.piece_layer);
    auto [exact_x, exact_y] = points.coordinates();
    s.set_coordinates(std::move(exact_x), std::move(exact_y), shift, from.scale);
    return s;
}

// Add the forbidden region of a workspace: a frame around it and all else, thicker than the robot of that size, and its holes.
void add_workspace(const Polygon& workspace, const Box& size, Builder& obstacles, const std::optional<Box>& others) {
    const Int factor = obstacles.scale / workspace.denominator;
    std::vector<Int> x, y;
    for (Index k = 0; k < workspace.vertices.size(); ++k)
        x.push_back(workspace.vertices.X(k) * factor), y.push_back(workspace.vertices.Y(k) * factor);
    const Points corners(x, y);
    Box around = box_of(x, y);
    if (others) around.add(others->x0, others->y0), around.add(others->x1, others->y1);
    const Int thickness = 1 + 2 * (abs(size.x0) + abs(size.y0) + abs(size.x1) + abs(size.y1));
    const Box rim = outwards(around, thickness, coarse_step(around, obstacles.scale));
    const Points frame = rectangle(rim.x0, rim.y0, rim.x1, rim.y1);
    for (std::size_t r = 0; r + 1 < workspace.offsets.size(); ++r) {
        std::vector<Index> ring;
        for (Index k = workspace.offsets[r]; k < workspace.offsets[r + 1]; ++k) ring.push_back(k);
        const Points points = corners.chosen(ring);
        const Polygon part(r ? std::vector{points} : std::vector{frame, points}, obstacles.scale);
        // turned around, its first point kept; the frame's rim stands for infinity, and has no owner
        obstacles.add_polygon(part, {}, workspace_owner, r > 0, [&](std::size_t of_part, Index k) -> Index {
            if (r == 0 && of_part == 0) return -1;
            const Index n = static_cast<Index>(ring.size()), place = k - (r == 0 ? 4 : 0);
            return ring[place ? n - place : 0];
        });
    }
}

// Add the reference point and the complement of the bounds: overlapping rectangles that reach past every pillar.
void add_bounds(Builder& robot, Builder& obstacles, const std::vector<Int>& inner, const Box& outer) {
    robot.add_bound_ring({{0}, {0}}, true);
    robot.piece_vertex.push_back(robot.count() - 1);
    robot.close_piece(reference_layer);
    const Int &x0 = inner[0], &y0 = inner[1], &x1 = inner[2], &y1 = inner[3];
    obstacles.add_bound_ring({{x0, x0, x1, x1}, {y0, y1, y1, y0}}, false);  // a hole: clockwise
    for (const Points& side : {rectangle(outer.x0, outer.y0, x0, outer.y1), rectangle(x1, outer.y0, outer.x1, outer.y1),
                               rectangle(outer.x0, outer.y0, outer.x1, y0), rectangle(outer.x0, y1, outer.x1, outer.y1)}) {
        for (Index k = 0; k < 4; ++k) {
            obstacles.piece_vertex.push_back(obstacles.count());
            obstacles.x.push_back(side.X(k)), obstacles.y.push_back(side.Y(k));
        }
        obstacles.close_piece(reference_layer);
    }
    robot.set_radius(0), obstacles.set_radius(0);
}

Int widest_of(const Box& box, const Vec<Int>& from) {
    Int widest = 0;
    for (const Int& size : {Int(abs(box.x0 - from.x)), Int(abs(box.x1 - from.x)), Int(abs(box.y0 - from.y)), Int(abs(box.y1 - from.y))})
        if (size > widest) widest = size;
    return widest;
}

int shift_of(const Int& widest) {
    return widest.is_zero() ? 0 : std::max(0, static_cast<int>(msb(widest)) + 1 - largest_bits);
}

constexpr std::size_t digits_at_a_time = 6, most_groups = 3;  // of decimals

struct OddPart {
    std::size_t groups = 0;  // of decimals
    Int beyond_5 = 1;
    bool is_long() const { return groups > most_groups || msb(beyond_5) >= 16; }  // or doubles would have few bits left
};

OddPart odd_part(const Int& denominator) {
    OddPart result;
    result.beyond_5 = denominator >> lsb(denominator);
    std::size_t digits = 0;
    for (; result.beyond_5 % 5 == 0; ++digits) result.beyond_5 /= 5;
    result.groups = (digits + digits_at_a_time - 1) / digits_at_a_time;
    return result;
}

void include_short(Int& short_part, const OddPart& odd) {
    if (odd.is_long()) return;
    const Int both = lcm(short_part, Int(odd.beyond_5 * pow(Int(5), static_cast<unsigned>(digits_at_a_time * odd.groups))));
    if (msb(both) < 46) short_part = both;
}

// Middle of vertices that are far away, on a coarse grid; else 0.
Vec<Int> place_near(const Box& box, const Int& scale) {
    const Int size = std::max(Int(box.x1 - box.x0), Int(box.y1 - box.y0));
    Int widest = 0;
    for (const Int* c : {&box.x0, &box.y0, &box.x1, &box.y1})
        if (abs(*c) > widest) widest = abs(*c);
    if (widest <= far * size) return {0, 0};
    const Int step = coarse_step(box, scale);
    return {floor_divide(box.x0 + box.x1, 2 * step) * step, floor_divide(box.y0 + box.y1, 2 * step) * step};
}

bool is_rounded(const Rounding& rounding) { return !rounding.radius.n.is_zero() || !rounding.arcs.empty(); }

// How far a rounded polygon reaches beyond its corners, at most: an arc is as near to them as its radius.
Ratio reach_beyond_corners(const Rounding& rounding) {
    Ratio most{0, 1};
    for (const Arc& arc : rounding.arcs)
        if (most < arc.radius) most = arc.radius;
    return most + rounding.radius;
}

template <class Use>
void for_each_number(const Rounding& rounding, Use use) {
    use(rounding.radius);
    for (const Arc& arc : rounding.arcs) {
        for (const RatioPoint* p : {&arc.from, &arc.to, &arc.centre}) use(p->x), use(p->y);
        use(arc.radius);
        if (!arc.beyond) continue;
        for (const RatioPoint& p : *arc.beyond) use(p.x), use(p.y);
    }
}

}  // namespace

const Rounding& rounding_of(const std::vector<Rounding>& all, std::size_t k) {
    static const Rounding none;
    return all.empty() ? none : all.at(k);
}

Ratio SceneShapes::robot_radius() const {
    Ratio most{0, 1};
    for (const Rounding& rounding : robot_rounding)
        if (const Ratio reach = reach_beyond_corners(rounding); most < reach) most = reach;
    return most;
}

Int floor_divide(const Int& n, const Int& d) {
    Int q, rest;
    divide_qr(n, d, q, rest);
    return rest.sign() < 0 ? Int(q - 1) : q;
}

void SharedDenominators::add(const Polygon& polygon) {
    const OddPart odd = odd_part(polygon.denominator);
    vertices += polygon.offsets.back();
    if (odd.is_long()) return;
    for (std::size_t group = 1; group <= odd.groups; ++group) with_groups[group - 1] += polygon.offsets.back();
    with_factor[static_cast<unsigned>(odd.beyond_5)] += polygon.offsets.back();
}

Int SharedDenominators::short_part() const {
    const auto is_shared = [&](Index count) { return count > 0 && 4 * count >= vertices; };
    Int result = 1;
    include_short(result, {static_cast<std::size_t>(std::count_if(with_groups.begin(), with_groups.end(), is_shared))});
    for (const auto& [factor, count] : with_factor)
        if (is_shared(count)) include_short(result, {0, factor});
    return result;
}

void WholeScene::add(const Polygon& polygon, const Rounding& rounding) {
    std::vector<Int> denominators{polygon.denominator};
    const auto use = [&](const Ratio& x) { denominators.push_back(x.d); };
    shared.add(polygon);
    if (is_rounded(rounding)) {
        if (!of_obstacles) of_robot = std::make_shared<FacingArcs>(robot), of_obstacles = std::make_shared<FacingArcs>(facing);
        if (of_obstacles->add(rounding)) facing.push_back(rounding);
        for_each_number(rounding, use);
        for_each_point(rounding, *of_robot, [&](const RatioPoint& p) { use(p.x), use(p.y); });
        is_round = true;
    }
    for (const Int& denominator : denominators) {
        if (scale % denominator == 0) continue;
        const Int more = lcm(scale, denominator) / scale;
        scale *= more;
        if (box)
            for (Int& c : *box) c *= more;
    }
    const Int factor = scale / polygon.denominator, reach = scaled(reach_beyond_corners(rounding), scale);
    for (Index k = 0; k < polygon.offsets[1]; ++k) {
        const Int x = polygon.vertices.X(k) * factor, y = polygon.vertices.Y(k) * factor;
        if (!box) box = {x - reach, y - reach, x + reach, y + reach};
        auto& [x0, y0, x1, y1] = *box;
        x0 = std::min(x0, Int(x - reach)), y0 = std::min(y0, Int(y - reach));
        x1 = std::max(x1, Int(x + reach)), y1 = std::max(y1, Int(y + reach));
    }
}

namespace {

// Of the obstacles what many of them share, of all else everything: an obstacle that is moved changes it rarely.
Int short_part_of(const SceneShapes& shapes, const WholeScene& whole) {
    const auto of_obstacles = [&] {
        SharedDenominators shared;
        for (const auto& polygon : shapes.obstacles) shared.add(*polygon);
        return shared.short_part();
    };
    Int result = whole.short_part ? *whole.short_part : of_obstacles();
    for (const auto& polygon : shapes.robot) include_short(result, odd_part(polygon->denominator));
    if (shapes.workspace) include_short(result, odd_part(shapes.workspace->denominator));
    if (shapes.bounds)
        for (const Ratio& bound : *shapes.bounds) include_short(result, odd_part(bound.d));
    return result;
}

}  // namespace

SceneFeatures scene_features(const SceneShapes& shapes, const WholeScene& whole) {
    SceneFeatures result;
    result.shapes = shapes;
    Int scale = whole.scale;  // the common denominator
    const auto include = [&](const Int& denominator) {
        if (scale % denominator != 0) scale = lcm(scale, denominator);
    };
    for (const auto* polygons : {&shapes.obstacles, &shapes.robot})
        for (const auto& polygon : *polygons) include(polygon->denominator);
    if (shapes.workspace) include(shapes.workspace->denominator);
    const Int short_part = short_part_of(shapes, whole);
    for (const auto* all : {&shapes.robot_rounding, &shapes.obstacle_rounding})
        for (const Rounding& rounding : *all) for_each_number(rounding, [&](const Ratio& x) { include(x.d); });
    std::vector<Rounding> facing = shapes.obstacle_rounding;
    facing.insert(facing.end(), whole.facing.begin(), whole.facing.end());
    const FacingArcs of_obstacles(facing), of_robot(shapes.robot_rounding);
    for (const auto& [all, other] : {std::pair{&shapes.robot_rounding, &of_obstacles}, {&shapes.obstacle_rounding, &of_robot}})
        for (const Rounding& rounding : *all) for_each_point(rounding, *other, [&](const RatioPoint& p) { include(p.x.d), include(p.y.d); });
    std::vector<Int> bounds;
    if (shapes.bounds) {
        for (const Ratio& bound : *shapes.bounds) include(bound.d);
        for (const Ratio& bound : *shapes.bounds) bounds.push_back(bound.n * (scale / bound.d));
    }
    Builder robot(scale), obstacles(scale);
    robot.reserve(shapes.robot), obstacles.reserve(shapes.obstacles);
    robot.number_radii(shapes.robot_rounding, of_obstacles), obstacles.number_radii(shapes.obstacle_rounding, of_robot);
    const bool is_round = whole.is_round || robot.is_round() || obstacles.is_round();
    const auto own = [](std::size_t, Index k) { return k; };
    for (std::size_t k = 0; k < shapes.robot.size(); ++k)
        robot.add_polygon(*shapes.robot[k], rounding_of(shapes.robot_rounding, k), static_cast<Index>(k), true, own);
    const std::size_t first_frame = shapes.obstacles.size() - static_cast<std::size_t>(shapes.frames);
    for (std::size_t k = 0; k < first_frame; ++k)
        obstacles.add_polygon(*shapes.obstacles[k], rounding_of(shapes.obstacle_rounding, k),
                              static_cast<Index>(k), true, own);
    // the rim of the frame stands for infinity; vertices are numbered from the first one of its hole
    const Index frame_start = obstacles.count() + 4;
    const auto of_workspace = [&](std::size_t, Index) -> Index { return obstacles.count() - frame_start; };
    for (std::size_t k = first_frame; k < shapes.obstacles.size(); ++k)
        obstacles.add_polygon(*shapes.obstacles[k], rounding_of(shapes.obstacle_rounding, k), workspace_owner, k > first_frame, of_workspace);
    const Int robot_radius = scaled(shapes.robot_radius(), scale);
    std::optional<Box> given;  // box around all obstacles of the whole, with their radii, and bounds
    const auto give = [&](const Int& x, const Int& y) { given ? given->add(x, y) : void(given = Box{x, y, x, y}); };
    if (whole.box) {
        const Int more = scale / whole.scale;
        const auto& [x0, y0, x1, y1] = *whole.box;
        give(x0 * more, y0 * more), give(x1 * more, y1 * more);
    }
    const auto give_all = [&] {
        for (Index k = 0; k < obstacles.count(); ++k) {
            const Int &x = obstacles.x[k], &y = obstacles.y[k];
            give(x, y);
            if (!is_round) continue;
            const Int& radius = obstacles.radius(k);
            give(x - radius, y - radius), give(x + radius, y + radius);
        }
    };
    give_all();
    for (std::size_t k = 0; k < bounds.size(); k += 2) give(bounds[k], bounds[k + 1]);
    if (shapes.workspace) add_workspace(*shapes.workspace, box_of(robot.x, robot.y).grown(robot_radius), obstacles, given);
    if (shapes.workspace || shapes.bounds || shapes.frames) {
        give_all();
        Int reach_x = 0, reach_y = 0;
        for (Index k = 0; k < robot.count(); ++k) {
            if (abs(robot.x[k]) > reach_x) reach_x = abs(robot.x[k]);
            if (abs(robot.y[k]) > reach_y) reach_y = abs(robot.y[k]);
        }
        const Int step = coarse_step(*given, scale);  // so that doubles can distinguish it
        const Box outer = outwards(*given, reach_x + reach_y + 2 * robot_radius + step, step);
        result.rim = {nearest(outer.x0, scale), nearest(outer.y0, scale), nearest(outer.x1, scale),
                      nearest(outer.y1, scale)};
        if (shapes.bounds) add_bounds(robot, obstacles, bounds, outer);
    }
    give_all();
    const Box moving = box_of(robot.x, robot.y).grown(robot_radius), still = given.value_or(Box{0, 0, 0, 0});
    const Vec<Int> zero{0, 0}, robot_origin = place_near(moving, scale), obstacle_origin = place_near(still, scale);
    const int shift = shift_of(std::max(widest_of(moving, zero), widest_of(still, zero)));
    const int near_shift = shift_of(std::max(widest_of(moving, robot_origin), widest_of(still, obstacle_origin)));
    result.robot = std::move(robot.owners), result.obstacles = std::move(obstacles.owners);
    Scene scene{finished(std::move(robot), shift, is_round), finished(std::move(obstacles), shift, is_round), scale, short_part, shift,
                result.rim.has_value(), {}, nullptr, is_round};
    result.scene = scene_around(std::move(scene), robot_origin, obstacle_origin, near_shift);
    return result;
}

}  // namespace cfree

// Coverage of a patch by a pillar: its states, each with the angles between which it holds; theory, "The trimmed boundary".
#include <algorithm>
#include <stdexcept>

#include "cfree/contact/contact_line.hpp"
#include "cfree/forbidden/trim.hpp"

namespace cfree {

void Trimmer::cover(Index p, Index k, const Slices& slices, const Slices::Part& part) {
    // The pillar's state at a sample (the edges by which the line enters and leaves, or the side on which it passes) holds
    // between two angles around it. Settle it at a sample, find its angles, go on with the rest on both sides.
    const auto limit = [&](int s) {
        return s == 0 ? 0 : s == slices.count ? 1 : intern({{}, {}, slices.at[s], slices.at[s]});
    };
    todo.assign(1, {limit(part.first), limit(part.last + 1)});
    while (!todo.empty() && !empty()) {
        const Span whole = todo.back();
        todo.pop_back();
        const double lo = events[whole.from].lo, hi = events[whole.to].hi;
        const auto [low, high] = live_between(lo, hi);
        if (low > high) continue;
        Sample at = decide.between(events[whole.from], events[whole.to]);
        Span span = whole;
        State state = at.fine ? state_at<Ball>(p, k, at) : state_at<double>(p, k, at);
        if (state.meets == Meets::crosses) find_curves(state);
        if (state.meets == Meets::crosses && !part.may_pinch && is_beyond(state, low, high, lo, hi)) continue;
        Verdict verdict = lifetime(state, at, span);
        bool is_exact = false;
        for (int attempt = 0; verdict != Verdict::holds; ++attempt) {
            if (attempt == Predicates::most_attempts) throw std::logic_error("no sample decides a pillar's state");
            if (verdict == Verdict::wrong && is_exact) throw std::logic_error("an exact state contradicts its own conditions");
            if (verdict == Verdict::resample)  // the sample is itself a critical angle
                at = decide.between(events[whole.from], events[whole.to], attempt + 1);
            span = whole;
            is_exact = attempt > 0 || at.fine;
            state = is_exact ? state_at<Int>(p, k, at) : state_at<Ball>(p, k, at);
            if (state.meets == Meets::crosses) find_curves(state);
            verdict = lifetime(state, at, span);
        }
        if (state.meets == Meets::crosses) add_band(state, span, p, k);
        else pass(state, span);
        if (span.to != whole.to) todo.push_back({span.to, whole.to});
        if (span.from != whole.from) todo.push_back({whole.from, span.from});
    }
}

namespace {

// Rotation by a sample: in doubles divided by w, so that w = 1.
Rotation<double> rotation_at(const Sample& at, int chart, double) {
    const double kappa = chart ? -1 : 1, tau = at.tau, w = 1 + tau * tau;
    return {kappa * (1 - tau * tau) / w, kappa * 2 * tau / w, 1};
}
Rotation<Ball> rotation_at(const Sample& at, int chart, const Ball&) {
    const Ball t = at.ball(), c = Ball(1) - t * t, s = Ball(2) * t;
    return {chart ? -c : c, chart ? -s : s, Ball(1) + t * t};
}
Rotation<Int> rotation_at(const Sample& at, int chart, const Int&) {
    const Dyadic t = at.exact();
    return rotation_by(chart, t.n, Int(1) << t.k);
}
template <class T>
Vec<T> between_vertices(const Shape& s, Index p, Index q) {
    if constexpr (std::is_same_v<T, double>) return {s.x[p] - s.x[q], s.y[p] - s.y[q]};
    else return difference<T>(s, p, q);
}

// Order of two numbers; of two balls that of their middles.
template <class T>
bool less(const T& x, const T& y) { return x < y; }
bool less(const Ball& x, const Ball& y) { return is_below(x, y); }

}  // namespace

template <>
std::vector<double>* Trimmer::scratch() const { return heights; }
template <>
std::vector<Ball>* Trimmer::scratch() const { return ball_heights; }
template <>
std::vector<Int>* Trimmer::scratch() const { return exact_heights; }

// A pillar at a sample, relative to the surface's line: a convex polygon with the edges of both pieces, merged by direction.
// A vertex is a pair (x, y) of vertices of the robot's piece and the obstacle's; its offset from the line,
// obstacle[y] - robot[x], rises and falls once around the pillar.
template <class T>
class Trimmer::PillarView {
public:
    PillarView(const Trimmer& t, Index p, Index k, const Sample& at)
        : A(t.scene.robot), O(t.scene.obstacles), R(rotation_at(at, t.surface.chart, T{})), a(&A.piece_vertex[A.piece[p]]),
          b(&O.piece_vertex[O.piece[k]]), ga(&A.piece_edge[A.piece[p]]), fb(&O.piece_edge[O.piece[k]]),
          n(A.piece[p + 1] - A.piece[p]), m(O.piece[k + 1] - O.piece[k]), robot{t.scratch<T>()[0]}, obstacle{t.scratch<T>()[1]} {
        measure(t.surface.contact);
    }

    struct Vertex {
        Index x, y;
    };
    // One of the highest vertices: see `last`.
    Vertex highest() const { return {robot.lowest, obstacle.highest}; }
    Vertex lowest() const { return {robot.highest, obstacle.lowest}; }
    bool is_left(const Vertex& v) const { return less(robot.at[v.x], obstacle.at[v.y]); }
    bool is_right(const Vertex& v) const { return less(obstacle.at[v.y], robot.at[v.x]); }
    // Last of the highest or lowest vertices in counter-clockwise order.
    Vertex last(Vertex v) const { return {last(v.x, robot.at, n), last(v.y, obstacle.at, m)}; }

    State missed(Meets meets, const Vertex& nearest) const {
        State state{};
        state.meets = meets, state.s = a[nearest.x], state.v = b[nearest.y];
        set_around(nearest.x, n, ga, state.robot_around), set_around(nearest.y, m, fb, state.obstacle_around);
        return state;
    }
    // Edge that crosses the line, on the way counter-clockwise down from the highest vertex, or up from the lowest.
    PillarEdge crossing(Vertex v, bool down) const {
        Vertex from = v;
        bool by_obstacle = false;
        for (Index steps = 0; steps <= n + m; ++steps) {
            from = v;
            by_obstacle = is_obstacle_next(v, down);
            if (by_obstacle) v.y = after(v.y, m);
            else v.x = after(v.x, n);
            if (down ? is_right(v) : is_left(v)) break;
        }
        PillarEdge e{};
        e.s0 = a[from.x], e.v0 = b[from.y], e.s1 = a[v.x], e.v1 = b[v.y];
        if (by_obstacle) e.feature = {Kind::vertex_edge, a[from.x], fb[from.y]}, set_around(from.x, n, ga, e.around);
        else e.feature = {Kind::edge_vertex, ga[from.x], b[from.y]}, set_around(from.y, m, fb, e.around);
        return e;
    }

private:
    // Heights of a piece's vertices over the line through `origin`; one of the highest, one of the lowest.
    struct Heights {
        std::vector<T>& at;
        Index highest = 0, lowest = 0;
        void measure(const Shape& s, const Index* vertices, Index count, Index origin, const Vec<T>& along) {
            at.resize(static_cast<std::size_t>(count));
            at[0] = cross(along, between_vertices<T>(s, vertices[0], origin));
            T top = at[0], bottom = at[0];
            for (Index x = 1; x < count; ++x) {
                const T& height = at[x] = cross(along, between_vertices<T>(s, vertices[x], origin));
                const bool is_top = less(top, height), is_bottom = less(height, bottom);
                highest = is_top ? x : highest, lowest = is_bottom ? x : lowest;
                if constexpr (std::is_same_v<T, double>) top = std::max(top, height), bottom = std::min(bottom, height);
                else if (is_top) top = height;
                else if (is_bottom) bottom = height;
            }
        }
    };
    static Index after(Index x, Index size) { return x + 1 == size ? 0 : x + 1; }
    static Index prior(Index x, Index size) { return x == 0 ? size - 1 : x - 1; }
    static void set_around(Index x, Index size, const Index* edges, Index* around) {
        around[0] = size > 1 ? edges[prior(x, size)] : -1, around[1] = size > 1 ? edges[x] : -1;
    }
    static Index last(Index x, const std::vector<T>& heights, Index size) {
        const auto is_level = [](const T& p, const T& q) { return !less(p, q) && !less(q, p); };
        for (Index c = 0; c < size && is_level(heights[after(x, size)], heights[x]); ++c) x = after(x, size);
        return x;
    }

    // Heights over the line: its direction in the workspace is U, in the robot's frame V, both times w.
    void measure(const Feature& contact) {
        const bool on_edge = contact.kind == Kind::vertex_edge;
        const Index i = contact.robot, j = contact.obstacle;
        const Index a0 = on_edge ? i : A.v[i], b0 = on_edge ? O.v[j] : j;
        const auto E = on_edge ? between_vertices<T>(O, O.w[j], O.v[j]) : between_vertices<T>(A, A.w[i], A.v[i]);
        const Vec<T> scaled{R.w * E.x, R.w * E.y};
        const Vec<T> U = on_edge ? scaled : -R(E), V = on_edge ? R.back(E) : -scaled;
        robot.measure(A, a, n, a0, V), obstacle.measure(O, b, m, b0, U);
    }

    // True if the pillar's next edge is the obstacle's; decided by direction if both pieces have an edge in this sense.
    bool is_obstacle_next(const Vertex& v, bool down) const {
        const Index x1 = after(v.x, n), y1 = after(v.y, m);
        const T &p = obstacle.at[v.y], &q = obstacle.at[y1], &r = robot.at[v.x], &s = robot.at[x1];
        const bool by_obstacle = down ? less(q, p) : less(p, q), by_robot = down ? less(r, s) : less(s, r);
        if (!by_obstacle || !by_robot) return by_obstacle || n == 1;
        return less(cross(between_vertices<T>(O, b[y1], b[v.y]), R(between_vertices<T>(A, a[x1], a[v.x]))), T{});
    }

    const Shape &A, &O;
    const Rotation<T> R;
    const Index *a, *b, *ga, *fb;  // vertices and edges of the two pieces
    const Index n, m;
    Heights robot, obstacle;
};

template <class T>
Trimmer::State Trimmer::state_at(Index p, Index k, const Sample& at) const {
    const PillarView<T> pillar(*this, p, k, at);
    const auto high = pillar.highest();
    if (!pillar.is_left(high)) return pillar.missed(Meets::never_left, high);
    const auto low = pillar.lowest();
    if (!pillar.is_right(low)) return pillar.missed(Meets::never_right, low);
    State state{};
    state.meets = Meets::crosses;
    state.lower = pillar.crossing(pillar.last(high), true);
    state.upper = pillar.crossing(pillar.last(low), false);
    return state;
}

// True if the helix (s, v) lies in the surface by identity of features.
bool Trimmer::lies_on_line(Index s, Index v) const {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const Index i = surface.contact.robot, j = surface.contact.obstacle;
    if (surface.contact.kind == Kind::vertex_edge)
        return A.point[s] == A.point[i] && (O.point[v] == O.point[O.v[j]] || O.point[v] == O.point[O.w[j]]);
    return O.point[v] == O.point[j] && (A.point[s] == A.point[A.v[i]] || A.point[s] == A.point[A.w[i]]);
}

// Signs that define a state. A vertex of a convex polygon is extreme, and an edge is present, if its neighbours confirm it.
int Trimmer::conditions(const State& state, Condition* out, bool& wrong) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const bool on_edge = surface.contact.kind == Kind::vertex_edge;
    const Index i = surface.contact.robot, j = surface.contact.obstacle;
    int count = 0;
    const auto parallel = [&](Index g, Index f, int sign) {
        out[count++] = {false, g, f, sign, false, decide.parallel(g, f)};
    };
    // Offset from the line of a vertex that an edge joins to the contact vertex: the direction of that edge against the line.
    const auto offset = [&](Index s, Index v, int sign, bool may_vanish) {
        const auto is = [](const Shape& shape, Index x, Index y) { return shape.point[x] == shape.point[y]; };
        if (on_edge && (is(O, v, O.v[j]) || is(O, v, O.w[j]))) {
            v = O.v[j];
            if (is(A, s, A.w[i])) return parallel(i, j, sign);
            if (is(A, s, A.previous[i])) return parallel(A.previous[i], j, -sign);
        } else if (!on_edge && (is(A, s, A.v[i]) || is(A, s, A.w[i]))) {
            s = A.v[i];
            if (is(O, v, O.w[j])) return parallel(i, j, -sign);
            if (is(O, v, O.previous[j])) return parallel(i, O.previous[j], sign);
        }
        out[count++] = {true, s, v, sign, may_vanish, decide.offset(s, v)};
    };
    const auto vertex = [&](Index s, Index v, int sign, bool may_vanish) {
        if (!lies_on_line(s, v)) offset(s, v, sign, may_vanish);
        else if (!may_vanish) wrong = true;
    };
    if (state.meets == Meets::crosses) {
        for (const PillarEdge* e : {&state.lower, &state.upper}) {
            const int down = e == &state.lower ? 1 : -1;
            vertex(e->s0, e->v0, down, true);
            vertex(e->s1, e->v1, -down, false);
            if (e->around[0] < 0) continue;
            if (e->feature.kind == Kind::vertex_edge) {  // R G_{s-1} x F <= 0 <= R G_s x F
                parallel(e->around[0], e->feature.obstacle, -1);
                parallel(e->around[1], e->feature.obstacle, 1);
            } else {  // R G x F_v <= 0 <= R G x F_{v-1}
                parallel(e->feature.robot, e->around[0], 1);
                parallel(e->feature.robot, e->around[1], -1);
            }
        }
        return count;
    }
    // side 1: the pillar's highest vertex is not left of the line
    const int side = state.meets == Meets::never_left ? 1 : -1;
    vertex(state.s, state.v, -side, true);
    if (on_edge) {  // U = E_j: b_v is fixed, a_s turns
        if (state.obstacle_around[0] >= 0) {
            wrong |= decide.cross_sign(scene.obstacles, j, state.obstacle_around[1]) * side > 0;
            wrong |= decide.cross_sign(scene.obstacles, j, state.obstacle_around[0]) * side < 0;
        }
        if (state.robot_around[0] >= 0) {
            parallel(state.robot_around[1], j, -side);
            parallel(state.robot_around[0], j, side);
        }
    } else {  // U = -R E_i: a_s is fixed, b_v turns
        if (state.robot_around[0] >= 0) {
            wrong |= decide.cross_sign(scene.robot, i, state.robot_around[1]) * side > 0;
            wrong |= decide.cross_sign(scene.robot, i, state.robot_around[0]) * side < 0;
        }
        if (state.obstacle_around[0] >= 0) {
            parallel(i, state.obstacle_around[1], side);
            parallel(i, state.obstacle_around[0], -side);
        }
    }
    return count;
}

std::array<double, 2> Trimmer::live_between(double lo, double hi) const {
    double low = 1, high = 0;
    for (const auto* areas : {&live, &thin})
        for (const Area& x : *areas)
            if (events[x.to].hi >= lo && events[x.from].lo <= hi) low = std::min(low, x.t_min), high = std::max(high, x.t_max);
    return {low, high};
}

// True if a pillar certainly covers nothing between two places and two angles: if the vertex that supports one of its edges is
// extreme, all of it is on one side of that edge's line, and so beyond a curve. The state need not be right.
bool Trimmer::is_beyond(const State& state, double low, double high, double lo, double hi) {
    const auto sign = [&](Index g, Index f) { return Predicates::sign_on(decide.parallel(g, f), lo, hi); };
    for (const PillarEdge* e : {&state.lower, &state.upper}) {
        const bool is_lower = e == &state.lower;
        const Curve& curve = curves[state.curves[is_lower ? 0 : 1]];
        if (is_lower ? !(extreme(curve, lo, hi, false) > high) : !(extreme(curve, lo, hi, true) < low)) continue;
        if (e->around[0] < 0) return true;
        if (e->feature.kind == Kind::vertex_edge
                ? sign(e->around[0], e->feature.obstacle) < 0 && sign(e->around[1], e->feature.obstacle) > 0
                : sign(e->feature.robot, e->around[0]) > 0 && sign(e->feature.robot, e->around[1]) < 0)
            return true;
    }
    return false;
}

// True if a condition vanishes at an end of the span, where another state ended, and certainly holds from there on.
bool Trimmer::holds_but_at_ends(const Condition& x, const Span& span) const {
    const Feature f{x.is_offset ? Kind::vertex_vertex : Kind::edge_edge, x.robot, x.obstacle};
    const Event &from = events[span.from], &to = events[span.to];
    const auto vanishes_at = [&](const Event& e) {
        return e.first.kind == f.kind && e.second.kind == Kind::none && code(scene, e.first) == code(scene, f);
    };
    const bool at_from = vanishes_at(from), at_to = vanishes_at(to);
    return (at_from || at_to) && Predicates::sign_between(x.value, from.lo, to.hi, at_from, at_to) == x.sign;
}

// Check a state at a sample and narrow the span to the angles at which it holds.
Trimmer::Verdict Trimmer::lifetime(const State& state, const Sample& sample, Span& span) {
    Condition all[8];
    bool wrong = false;
    const int count = conditions(state, all, wrong);
    if (wrong) return Verdict::wrong;
    for (int c = 0; c < count; ++c) {
        const Condition& x = all[c];
        const int certain = Predicates::sign_on(x.value, events[span.from].lo, events[span.to].hi);
        if (certain == x.sign) {
            ++decide.counters.filter;
            continue;
        }
        if (holds_but_at_ends(x, span)) {
            ++decide.counters.identity;
            continue;
        }
        const int at = x.is_offset ? decide.offset_sign(x.robot, x.obstacle, x.value, sample)
                                   : decide.parallel_sign(x.robot, x.obstacle, x.value, sample);
        if (at == -x.sign) return Verdict::wrong;
        const auto roots = x.is_offset
                               ? decide.offset_roots(x.robot, x.obstacle, x.value, events[span.from], events[span.to])
                               : decide.parallel_roots(x.robot, x.obstacle, events[span.from], events[span.to]);
        if (roots.all_zero) {
            if (!x.may_vanish) return Verdict::wrong;
            continue;
        }
        if (at == 0) return Verdict::resample;
        for (const Event& root : roots.at) {
            if (!root.is_touch || state.meets == Meets::crosses) continue;
            const Index at_touch = intern(root);
            if (touches_along(state)) pinches.push_back(at_touch);
            else meet(state, at_touch);
        }
        for (const Event& root : roots.at) {
            const bool is_before = decide.order(root, sample) < 0;
            (is_before ? span.from : span.to) = intern(root);
            if (!is_before) break;
        }
    }
    return Verdict::holds;
}

// True if the vertex nearest to the line is an end of an edge parallel to it at every angle.
bool Trimmer::touches_along(const State& state) const {
    if (state.meets == Meets::crosses) return false;
    const bool on_edge = surface.contact.kind == Kind::vertex_edge;
    const auto& direction = on_edge ? scene.obstacles.direction : scene.robot.direction;
    const Index own = on_edge ? surface.contact.obstacle : surface.contact.robot;
    const auto& around = on_edge ? state.obstacle_around : state.robot_around;
    return std::any_of(around, around + 2, [&](Index e) { return e >= 0 && direction[e] == direction[own]; });
}

}  // namespace cfree

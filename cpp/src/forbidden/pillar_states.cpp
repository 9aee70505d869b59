// What a pillar covers on a patch: its states, each with the angles between which it lives.
#include <algorithm>
#include <stdexcept>

#include "cfree/forbidden/trim.hpp"

namespace cfree {

void Trimmer::cover(Index p, Index k) {
    // The pillar's state at a sample (which edges the line enters and leaves by, or on which side it passes) holds between
    // two angles around it. Settle it at a sample, find how long it lives, go on with what is left on both sides.
    todo.assign(1, {0, 1});
    while (!todo.empty() && !empty()) {
        const Span whole = todo.back();
        todo.pop_back();
        Sample at = decide.between(events[whole.from], events[whole.to]);
        Span span = whole;
        State state = at.fine ? state_at<Int>(p, k, at) : state_at<double>(p, k, at);
        Verdict verdict = lifetime(state, at, span);
        for (int attempt = 0; verdict != Verdict::holds; ++attempt) {
            if (attempt == Predicates::most_attempts) throw std::logic_error("no sample decides a pillar's state");
            if (verdict == Verdict::resample)  // the sample is itself a critical angle
                at = decide.between(events[whole.from], events[whole.to], attempt + 1);
            span = whole;
            state = state_at<Int>(p, k, at);
            verdict = lifetime(state, at, span);
            if (verdict == Verdict::wrong) throw std::logic_error("an exact state contradicts its own conditions");
        }
        if (state.meets == Meets::crosses) add_band(state, span, p, k);
        if (span.to != whole.to) todo.push_back({span.to, whole.to});
        if (span.from != whole.from) todo.push_back({whole.from, span.from});
    }
}

namespace {

template <class T>
struct Rotation {
    T c, s, w;  // cosine and sine times w
};
Rotation<double> rotation(const Sample& at, double kappa, double) {
    const double tau = at.tau;
    const double w = 1 + tau * tau;
    return {kappa * (1 - tau * tau) / w, kappa * 2 * tau / w, 1};
}
Rotation<Int> rotation(const Sample& at, double kappa, const Int&) {
    const Dyadic t = at.exact();
    const Int q = Int(1) << t.k, c = q * q - t.n * t.n, s = 2 * t.n * q;
    return {kappa > 0 ? c : Int(-c), kappa > 0 ? s : Int(-s), q * q + t.n * t.n};
}
template <class T>
Vec<T> between_vertices(const Shape& s, Index p, Index q);
template <>
Vec<double> between_vertices(const Shape& s, Index p, Index q) {
    return {s.x[p] - s.x[q], s.y[p] - s.y[q]};
}
template <>
Vec<Int> between_vertices(const Shape& s, Index p, Index q) {
    return difference<Int>(s, p, q);
}

}  // namespace

template <>
std::vector<double>* Trimmer::scratch() const { return heights; }
template <>
std::vector<Int>* Trimmer::scratch() const { return exact_heights; }

// The pillar is a convex polygon whose edges are those of both pieces, merged by direction. Offsets from the surface's line
// rise and fall once along it.
template <class T>
Trimmer::State Trimmer::state_at(Index p, Index k, const Sample& at) const {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const Rotation<T> R = rotation(at, surface.chart ? -1 : 1, T{});
    const bool on_edge = surface.contact.kind == Kind::vertex_edge;
    const Index i = surface.contact.robot, j = surface.contact.obstacle;
    const Index a0 = on_edge ? i : A.v[i], b0 = on_edge ? O.v[j] : j;
    // the line's direction in the workspace (U) and in the robot's frame (V), both times w
    Vec<T> U, V;
    if (on_edge) {
        const auto E = between_vertices<T>(O, O.w[j], O.v[j]);
        U = {R.w * E.x, R.w * E.y};
        V = {R.c * E.x + R.s * E.y, R.c * E.y - R.s * E.x};
    } else {
        const auto E = between_vertices<T>(A, A.w[i], A.v[i]);
        U = {R.s * E.y - R.c * E.x, -(R.s * E.x) - R.c * E.y};
        V = {-(R.w * E.x), -(R.w * E.y)};
    }
    const Index* a = &A.piece_vertex[A.piece[p]];
    const Index* b = &O.piece_vertex[O.piece[k]];
    const Index n = A.piece[p + 1] - A.piece[p], m = O.piece[k + 1] - O.piece[k];
    auto &robot = scratch<T>()[0], &obstacle = scratch<T>()[1];  // offsets are obstacle[y] - robot[x]
    robot.resize(n), obstacle.resize(m);
    for (Index x = 0; x < n; ++x) robot[x] = cross(V, between_vertices<T>(A, a[x], a0));
    for (Index y = 0; y < m; ++y) obstacle[y] = cross(U, between_vertices<T>(O, b[y], b0));
    const auto after = [](Index x, Index size) { return x + 1 == size ? 0 : x + 1; };
    const auto prior = [](Index x, Index size) { return x == 0 ? size - 1 : x - 1; };

    // highest and lowest vertices; of several the last in counter-clockwise order
    Index x_high = 0, x_low = 0, y_high = 0, y_low = 0;  // high: robot offset least
    for (Index x = 1; x < n; ++x) {
        if (robot[x] < robot[x_high]) x_high = x;
        if (robot[x] > robot[x_low]) x_low = x;
    }
    for (Index y = 1; y < m; ++y) {
        if (obstacle[y] > obstacle[y_high]) y_high = y;
        if (obstacle[y] < obstacle[y_low]) y_low = y;
    }
    const auto last = [&](Index x, const std::vector<T>& h, Index size) {
        for (Index c = 0; c < size && h[after(x, size)] == h[x]; ++c) x = after(x, size);
        return x;
    };
    State state;
    const auto miss = [&](Meets meets, Index x, Index y) {
        state.meets = meets, state.s = a[x], state.v = b[y];
        const Index *ga = &A.piece_edge[A.piece[p]], *fb = &O.piece_edge[O.piece[k]];
        state.robot_around[0] = n > 1 ? ga[prior(x, n)] : -1, state.robot_around[1] = n > 1 ? ga[x] : -1;
        state.obstacle_around[0] = m > 1 ? fb[prior(y, m)] : -1, state.obstacle_around[1] = m > 1 ? fb[y] : -1;
        return state;
    };
    if (!(obstacle[y_high] > robot[x_high])) return miss(Meets::never_left, x_high, y_high);
    if (!(obstacle[y_low] < robot[x_low])) return miss(Meets::never_right, x_low, y_low);

    state.meets = Meets::crosses;
    // walk counter-clockwise from one extreme vertex towards the other until the line is passed
    const auto walk = [&](Index x, Index y, int direction) {
        const Index *ga = &A.piece_edge[A.piece[p]], *fb = &O.piece_edge[O.piece[k]];
        PillarEdge e{};
        for (Index steps = 0; steps <= n + m; ++steps) {
            const Index x1 = after(x, n), y1 = after(y, m);
            const bool by_obstacle = direction < 0 ? obstacle[y1] < obstacle[y] : obstacle[y1] > obstacle[y];
            const bool by_robot = direction < 0 ? robot[x1] > robot[x] : robot[x1] < robot[x];
            bool obstacle_first = by_obstacle || n == 1;
            if (by_obstacle && by_robot) {
                const auto F = between_vertices<T>(O, b[y1], b[y]), G = between_vertices<T>(A, a[x1], a[x]);
                const Vec<T> RG{R.c * G.x - R.s * G.y, R.s * G.x + R.c * G.y};
                obstacle_first = cross(F, RG) < 0;
            }
            e.s0 = a[x], e.v0 = b[y];
            if (obstacle_first) {
                e.feature = {Kind::vertex_edge, a[x], fb[y]};
                e.around[0] = n > 1 ? ga[prior(x, n)] : -1, e.around[1] = n > 1 ? ga[x] : -1;
                y = y1;
            } else {
                e.feature = {Kind::edge_vertex, ga[x], b[y]};
                e.around[0] = m > 1 ? fb[prior(y, m)] : -1, e.around[1] = m > 1 ? fb[y] : -1;
                x = x1;
            }
            e.s1 = a[x], e.v1 = b[y];
            if (direction < 0 ? obstacle[y] < robot[x] : obstacle[y] > robot[x]) break;
        }
        return e;
    };
    state.lower = walk(last(x_high, robot, n), last(y_high, obstacle, m), -1);
    state.upper = walk(last(x_low, robot, n), last(y_low, obstacle, m), 1);
    return state;
}

// Whether the helix (s, v) lies in the surface for a reason of identity.
bool Trimmer::lies_on_line(Index s, Index v) const {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const Index i = surface.contact.robot, j = surface.contact.obstacle;
    if (surface.contact.kind == Kind::vertex_edge)
        return A.point[s] == A.point[i] && (O.point[v] == O.point[O.v[j]] || O.point[v] == O.point[O.w[j]]);
    return O.point[v] == O.point[j] && (A.point[s] == A.point[A.v[i]] || A.point[s] == A.point[A.w[i]]);
}

// The signs that make a state what it is. Of a convex polygon a vertex is extreme, and an edge is there, if its neighbours
// say so.
int Trimmer::conditions(const State& state, Condition* out, bool& wrong) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const bool on_edge = surface.contact.kind == Kind::vertex_edge;
    const Index i = surface.contact.robot, j = surface.contact.obstacle;
    int count = 0;
    const auto parallel = [&](Index g, Index f, int sign) {
        out[count++] = {false, g, f, sign, false, decide.parallel(g, f)};
    };
    // An offset from the line of a vertex that an edge joins to the contact vertex: that edge against the line.
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

// Check a state at a sample and narrow the span to where it holds.
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
        for (int r = 0; r < roots.count; ++r)
            if (roots.at[r].is_touch && touches_along(state)) pinches.push_back(intern(roots.at[r]));
        for (int r = 0; r < roots.count; ++r) {
            if (decide.order(roots.at[r], sample) < 0) {
                span.from = intern(roots.at[r]);
            } else {
                span.to = intern(roots.at[r]);
                break;
            }
        }
    }
    return Verdict::holds;
}

// Whether the vertex nearest to the line is an end of an edge parallel to it at every angle.
bool Trimmer::touches_along(const State& state) const {
    if (state.meets == Meets::crosses) return false;
    const bool on_edge = surface.contact.kind == Kind::vertex_edge;
    const auto& direction = on_edge ? scene.obstacles.direction : scene.robot.direction;
    const Index own = on_edge ? surface.contact.obstacle : surface.contact.robot;
    const auto& around = on_edge ? state.obstacle_around : state.robot_around;
    return std::any_of(around, around + 2, [&](Index e) { return e >= 0 && direction[e] == direction[own]; });
}

}  // namespace cfree

// Combinatorics of one disc: flips, splits and fans; theory, "Meshes".
#include "cfree/mesh/triangulation.hpp"

#include <algorithm>
#include <cmath>

#include "cfree/support/elementary.hpp"

namespace cfree {

namespace {
int next(int k) { return k == 2 ? 0 : k + 1; }
int previous(int k) { return k == 0 ? 2 : k - 1; }
}  // namespace

double Triangulation::area(Index p, Index q, Index r) const {
    const Place &a = places[p], &b = places[q], &c = places[r];
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double Triangulation::square_distance(Index p, Index q) const {
    const double x = places[q].x - places[p].x, y = places[q].y - places[p].y;
    return x * x + y * y;
}

void Triangulation::zip(const std::vector<Index>& left, const std::vector<Index>& right) {
    std::size_t i = 0, j = 0;
    Index rung = -1;  // the triangle below the edge from left[i] to right[j]
    while (i + 1 < left.size() || j + 1 < right.size()) {
        const bool by_left =
            j + 1 == right.size() || (i + 1 < left.size() && places[left[i + 1]].y < places[right[j + 1]].y);
        const Index a = left[i], b = right[j], c = by_left ? left[++i] : right[++j];
        if (a == b || b == c || c == a) continue;
        const auto t = static_cast<Index>(triangles.size());
        triangles.push_back({{a, b, c}, {-1, -1, rung}});
        // the edge to the next rung is opposite a if the left chain moved, else opposite b
        if (rung >= 0) {
            auto& below = triangles[rung];
            for (int k = 0; k < 3; ++k)
                if (below.corner[k] != a && below.corner[k] != b) below.across[k] = t;
        }
        rung = t;
    }
}

// From the lowest point to the highest. `chain` is a stack of points of one side that bends inwards; a point of the other chain
// is connected to all of them, one of the same chain to those that it has in view.
void Triangulation::fill_between(const std::vector<Index>& left, const std::vector<Index>& right) {
    struct Point {
        Index id;
        bool is_left;
    };
    std::vector<Point> order{{left.front(), true}}, chain;
    std::size_t i = 1, j = left.front() == right.front() ? 1 : 0;
    const std::size_t stop = left.back() == right.back() ? left.size() - 1 : left.size();
    while (i < stop || j < right.size()) {
        const bool by_left = j == right.size() || (i < stop && places[left[i]].y <= places[right[j]].y);
        // the last point of the right chain is the highest
        if (by_left || (j + 1 == right.size() && i < stop)) order.push_back({left[i++], true});
        else order.push_back({right[j++], false});
    }
    const auto add = [&](Index low, Index high, Index p, bool from_left) {  // p is right of the chain if that is the left one
        if (from_left) triangles.push_back({{low, p, high}, {-1, -1, -1}});
        else triangles.push_back({{low, high, p}, {-1, -1, -1}});
    };
    for (std::size_t k = 0; k < order.size(); ++k) {
        const Point p = order[k];
        if (chain.size() < 2) {
            chain.push_back(p);
            continue;
        }
        const Point newest = chain.back();
        if (k + 1 == order.size() || p.is_left != newest.is_left) {
            for (std::size_t m = 0; m + 1 < chain.size(); ++m) add(chain[m].id, chain[m + 1].id, p.id, newest.is_left);
            chain = {newest, p};
            continue;
        }
        Point top = newest;
        chain.pop_back();
        while (!chain.empty()) {
            const Index low = chain.back().id;
            if (!(p.is_left ? area(low, p.id, top.id) > 0 : area(low, top.id, p.id) > 0)) break;
            add(low, top.id, p.id, p.is_left);
            top = chain.back();
            chain.pop_back();
        }
        chain.push_back(top), chain.push_back(p);
    }
    find_neighbours();
}

void Triangulation::find_neighbours() {
    struct Edge {
        Index p, q, triangle;
        int corner;
    };
    std::vector<Edge> edges;
    for (Index t = 0; t < static_cast<Index>(triangles.size()); ++t)
        for (int k = 0; k < 3; ++k) {
            const auto [p, q] = std::minmax(triangles[t].corner[next(k)], triangles[t].corner[previous(k)]);
            edges.push_back({p, q, t, k});
        }
    std::sort(edges.begin(), edges.end(), [](const Edge& x, const Edge& y) { return x.p != y.p ? x.p < y.p : x.q < y.q; });
    for (std::size_t k = 1; k < edges.size(); ++k) {
        const Edge &x = edges[k - 1], &y = edges[k];
        if (x.p == y.p && x.q == y.q)
            triangles[x.triangle].across[x.corner] = y.triangle, triangles[y.triangle].across[y.corner] = x.triangle;
    }
}

int Triangulation::across_from(Index t, Index neighbour) const {
    const auto& x = triangles[t].across;
    return x[0] == neighbour ? 0 : x[1] == neighbour ? 1 : 2;
}

void Triangulation::replace_neighbour(Index t, Index old, Index now) {
    if (t >= 0) triangles[t].across[across_from(t, old)] = now;
}

Index Triangulation::opposite(Index t, int k) const {
    const Index o = triangles[t].across[k];
    return triangles[o].corner[across_from(o, t)];
}

void Triangulation::split_rim(Index a, Index b, Index p) {
    for (auto t = static_cast<Index>(triangles.size()) - 1; t >= 0; --t)
        for (int k = 0; k < 3; ++k)
            if (triangles[t].across[k] < 0 && triangles[t].corner[next(k)] == a && triangles[t].corner[previous(k)] == b)
                return split_edge(t, k, p);
}

void Triangulation::split_edge(Index t, int k, Index p) {
    const Index o = triangles[t].across[k];
    const Triangle x = triangles[t];
    const Index c = x.corner[k], a = x.corner[next(k)], b = x.corner[previous(k)];
    const auto t2 = static_cast<Index>(triangles.size()), o2 = t2 + 1;
    // t keeps a, the new one has b
    triangles[t] = {{c, a, p}, {o < 0 ? -1 : o2, t2, x.across[previous(k)]}};
    triangles.push_back({{c, p, b}, {o, x.across[next(k)], t}});
    replace_neighbour(x.across[next(k)], t, t2);
    if (o < 0) return;
    const int m = across_from(o, t);
    const Triangle y = triangles[o];
    const Index d = y.corner[m];  // o is d, b, a
    triangles[o] = {{d, b, p}, {t2, o2, y.across[previous(m)]}};
    triangles.push_back({{d, p, a}, {t, y.across[next(m)], o}});
    replace_neighbour(y.across[next(m)], o, o2);
}

void Triangulation::split_triangle(Index t, Index p) {
    const Triangle x = triangles[t];
    const auto t1 = static_cast<Index>(triangles.size()), t2 = t1 + 1;
    triangles[t] = {{x.corner[0], x.corner[1], p}, {t1, t2, x.across[2]}};
    triangles.push_back({{x.corner[1], x.corner[2], p}, {t2, t, x.across[0]}});
    triangles.push_back({{x.corner[2], x.corner[0], p}, {t, t1, x.across[1]}});
    replace_neighbour(x.across[0], t, t1), replace_neighbour(x.across[1], t, t2);
}

bool Triangulation::can_flip(Index t, int k) const {
    if (triangles[t].across[k] < 0) return false;
    const auto& x = triangles[t].corner;
    const Index c = x[k], a = x[next(k)], b = x[previous(k)], d = opposite(t, k);
    if (c == d) return false;
    const double size = flat * std::max(square_distance(a, b), square_distance(c, d));
    return area(c, a, d) > size && area(d, b, c) > size;
}

void Triangulation::flip(Index t, int k) {
    const Index o = triangles[t].across[k];
    const int m = across_from(o, t);
    const Triangle x = triangles[t], y = triangles[o];
    const Index c = x.corner[k], a = x.corner[next(k)], b = x.corner[previous(k)], d = y.corner[m];
    triangles[t] = {{c, a, d}, {y.across[next(m)], o, x.across[previous(k)]}};
    triangles[o] = {{d, b, c}, {x.across[next(k)], t, y.across[previous(m)]}};
    replace_neighbour(y.across[next(m)], o, t), replace_neighbour(x.across[next(k)], t, o);
}

// True if the corner across is outside the circle through the triangle, or on it up to rounding.
bool Triangulation::is_outside_circle(Index t, int k) const {
    const auto& x = triangles[t].corner;
    const Place &o = places[opposite(t, k)], &a = places[x[k]], &b = places[x[next(k)]], &c = places[x[previous(k)]];
    const auto cotangents = [](const Place& at, const Place& p, const Place& q, double& sine) {
        const double px = p.x - at.x, py = p.y - at.y, qx = q.x - at.x, qy = q.y - at.y;
        sine = px * qy - py * qx;
        return px * qx + py * qy;
    };
    double sine_a, sine_o;
    const double cosine_a = cotangents(a, b, c, sine_a), cosine_o = cotangents(o, c, b, sine_o);
    const double size = norm(cosine_a, sine_a) * norm(cosine_o, sine_o);
    return sine_a * cosine_o + cosine_a * sine_o >= -flat * size;  // the sine of the two angles' sum
}

void Triangulation::make_stacked_delaunay() {
    auto budget = 64 * triangles.size() + 1000;  // rounding may flip in circles
    while (!stack.empty() && budget-- > 0) {
        const auto [p, t] = stack.back();
        stack.pop_back();
        changed.push_back(t);
        int k = -1;
        for (int m = 0; m < 3; ++m)
            if (triangles[t].corner[m] == p) k = m;
        if (k < 0 || triangles[t].across[k] < 0 || is_outside_circle(t, k) || !can_flip(t, k)) continue;
        const Index o = triangles[t].across[k];
        flip(t, k);
        for (const Index x : {t, o})
            for (int m = 0; m < 3; ++m) stack.push_back({triangles[x].corner[m], x});
    }
    stack.clear();
}

void Triangulation::make_delaunay() {
    for (Index t = 0; t < static_cast<Index>(triangles.size()); ++t)
        for (int k = 0; k < 3; ++k) stack.push_back({triangles[t].corner[k], t});
    make_stacked_delaunay();
}

// p is the newest point: its triangles are the newest, and those that were there before next to them.
void Triangulation::make_delaunay_around(Index p) {
    const auto count = static_cast<Index>(triangles.size());
    for (auto t = std::max<Index>(0, count - 2); t < count; ++t) {
        for (const Index x : {t, triangles[t].across[0], triangles[t].across[1], triangles[t].across[2]})
            if (x >= 0 && std::count(triangles[x].corner.begin(), triangles[x].corner.end(), p)) stack.push_back({p, x});
    }
    make_stacked_delaunay();
}

int Triangulation::longest_inner_edge(Index t) const {
    const Triangle& x = triangles[t];
    int longest = -1;
    double most = -1;
    for (int k = 0; k < 3; ++k) {
        const double length = square_distance(x.corner[next(k)], x.corner[previous(k)]);
        if (x.across[k] >= 0 && length > most) most = length, longest = k;
    }
    return longest;
}

bool Triangulation::insert(Index p) {
    // a triangle that has it inside, or on the edge opposite corner `on`
    int on = -1;
    const auto is_in = [&](Index t, int& out) {
        const auto& x = triangles[t].corner;
        const double whole = std::abs(area(x[0], x[1], x[2]));
        on = -1;
        for (int k = 0; k < 3; ++k) {
            const double part = area(x[next(k)], x[previous(k)], p);
            if (part > flat * whole) continue;
            if (part < -flat * whole || on >= 0) return out = k, false;
            on = k;
        }
        return true;
    };
    Index t = std::min(last, static_cast<Index>(triangles.size()) - 1);
    int out = 0;
    bool found = false;
    for (int steps = 0; steps < 200 && !found; ++steps) {
        if ((found = is_in(t, out))) break;
        // over any edge that has the point behind it; the first unless that is on the rim
        int k = out;
        const auto& x = triangles[t];
        if (x.across[k] < 0)
            for (k = next(out); k != out; k = next(k))
                if (x.across[k] >= 0 && area(x.corner[next(k)], x.corner[previous(k)], p) < 0) break;
        if (x.across[k] < 0) break;
        t = x.across[k];
    }
    for (Index x = 0; !found && x < static_cast<Index>(triangles.size()); ++x)
        if ((found = is_in(x, out))) t = x;
    if (!found || (on >= 0 && triangles[t].across[on] < 0)) return false;
    if (on < 0) split_triangle(t, p);
    else split_edge(t, on, p);
    make_delaunay_around(p);
    last = t;
    return true;
}

void Triangulation::star_of(Index p, Index t, Star& star) const {
    star.triangles.clear(), star.link.clear();
    const Index first = t;
    do {
        const auto& x = triangles[t].corner;
        const int k = x[0] == p ? 0 : x[1] == p ? 1 : 2;
        star.triangles.push_back(t), star.link.push_back(x[next(k)]);
        t = triangles[t].across[next(k)];
    } while (t != first);
}

bool Triangulation::can_fan(const Star& star, std::size_t from) const {
    const std::size_t n = star.link.size();
    for (std::size_t k = 1; k + 1 < n; ++k) {
        const Index a = star.link[from], b = star.link[(from + k) % n], c = star.link[(from + k + 1) % n];
        if (area(a, b, c) <= flat * std::max({square_distance(a, b), square_distance(b, c), square_distance(c, a)})) return false;
    }
    return true;
}

void Triangulation::fan(const Star& star, std::size_t from) {
    const std::size_t n = star.link.size();
    const auto link = [&](std::size_t k) { return star.link[(from + k) % n]; };
    const auto slot = [&](std::size_t k) { return star.triangles[(from + k) % n]; };
    const Index first = slot(0), last_one = slot(n - 1);
    std::vector<Index> outer(n);
    for (std::size_t k = 0; k < n; ++k) {
        const auto& x = triangles[slot(k)];
        const int m = x.corner[0] == link(k) ? 0 : x.corner[1] == link(k) ? 1 : 2;
        outer[k] = x.across[previous(m)];  // opposite the star's middle, which comes before link(k)
    }
    for (std::size_t k = 1; k + 1 < n; ++k)
        triangles[slot(k)] = {{link(0), link(k), link(k + 1)},
                              {outer[k], k + 2 == n ? outer[n - 1] : slot(k + 1), k == 1 ? outer[0] : slot(k - 1)}};
    replace_neighbour(outer[0], first, slot(1));
    replace_neighbour(outer[n - 1], last_one, slot(n - 2));
    for (const Index t : {first, last_one}) triangles[t].corner[0] = -1;
}

void Triangulation::sweep_dropped() {
    std::erase_if(triangles, [](const Triangle& t) { return t.corner[0] < 0; });  // their neighbours are no longer valid
}

}  // namespace cfree

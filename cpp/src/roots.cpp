#include <stdexcept>

#include "form.hpp"

namespace cfree {

namespace {

enum class Found { none, one, unclear, hopeless };

// How many roots inside: by the variations of certain signs, uncertain ones allowed only where they cannot add any.
Found roots_inside(const double* c, int degree, double err) {
    int changes = 0, last = 0, gap = 0;
    bool ends = true;
    for (int i = 0; i <= degree; ++i) {
        const int s = c[i] > err ? 1 : c[i] < -err ? -1 : 0;
        if (s == 0) {
            if (i == 0 || i == degree) ends = false;
            gap = 1;
            continue;
        }
        if (last != 0) {
            if (s != last) ++changes;
            else if (gap) ends = false;
        }
        last = s, gap = 0;
    }
    if (last == 0) return Found::hopeless;
    if (!ends) return Found::unclear;
    return changes == 0 ? Found::none : changes == 1 ? Found::one : Found::unclear;
}

// Illinois method: false position that halves the value of an end that stays twice.
template <class Form>
double false_position(const Form& form, double a, double b, double fa, double fb) {
    double t = a;
    int stayed = 0;
    for (int k = 0; k < 60 && b - a > 4e-16; ++k) {
        t = (a * fb - b * fa) / (fb - fa);
        if (!(t > a && t < b)) t = 0.5 * (a + b);
        const auto value = form.at(t);
        if (std::abs(value.v) <= value.err) break;
        if ((value.v > 0) == (fb > 0)) {
            b = t, fb = value.v;
            if (stayed == 1) fa *= 0.5;
            stayed = 1;
        } else {
            a = t, fa = value.v;
            if (stayed == 2) fb *= 0.5;
            stayed = 2;
        }
    }
    return t;
}

// Shrink an interval with certain, opposite signs at its ends and one root inside.
template <class Form>
std::array<double, 2> refine(const Form& form, double lo, double hi) {
    const double flo = form.at(lo).v, fhi = form.at(hi).v;
    double t = lo, width;
    if (form.degree == 2) {  // (a - b) tau^2 + 2 c tau + (a + b)
        const double A = form.p.a - form.p.b, B = form.p.c, C = form.p.a + form.p.b;
        const double s = std::sqrt(std::max(0.0, B * B - A * C)), q = B > 0 ? -(B + s) : s - B;
        t = q / A;
        if (!(t >= lo && t <= hi)) t = C / q;
        if (!(t >= lo && t <= hi)) t = 0.5 * (lo + hi);
        width = form.p.err / s;
    } else {
        t = false_position(form, lo, hi, flo, fhi);
        const double l = std::max(lo, t - 1e-9), r = std::min(hi, t + 1e-9);
        width = 2 * form.at(t).err * (r - l) / std::abs(form.at(r).v - form.at(l).v);
    }
    // certain signs on both sides: widen until they are
    double delta = width + 2.3e-16;
    if (!(delta < hi - lo)) delta = hi - lo;
    for (int k = 0; k < 64; ++k, delta *= 2) {
        const double x = std::max(lo, t - delta), y = std::min(hi, t + delta);
        const auto vx = form.at(x), vy = form.at(y);
        const bool left = x == lo || (std::abs(vx.v) > vx.err && (vx.v > 0) == (flo > 0));
        const bool right = y == hi || (std::abs(vy.v) > vy.err && (vy.v > 0) == (fhi > 0));
        if (left && right) return {x, y};
    }
    return {lo, hi};
}

constexpr int enough = 8;

template <class Form>
bool isolate_by_filter(const Form& form, double lo, double hi, double (*found)[2], int& count) {
    struct Span {
        double lo, hi;
    };
    Span stack[64];
    int top = 0;
    stack[top++] = {lo, hi};
    int budget = 60;
    while (top > 0) {
        const Span s = stack[--top];
        double c[5];
        const double err = form.bernstein(s.lo, s.hi, c);
        const Found inside = roots_inside(c, form.degree, err);
        if (inside == Found::none) continue;
        if (inside == Found::hopeless) return false;
        if (inside == Found::one) {
            const auto bracket = refine(form, s.lo, s.hi);
            found[count][0] = bracket[0], found[count][1] = bracket[1];
            if (++count == enough) return false;
            continue;
        }
        if (--budget == 0 || s.hi - s.lo < 1e-14 || top > 60) return false;
        double mid = 0.5 * (s.lo + s.hi);
        const auto value = form.at(mid);
        if (std::abs(value.v) <= value.err) mid = s.lo + 0.4375 * (s.hi - s.lo);
        stack[top++] = {mid, s.hi};
        stack[top++] = {s.lo, mid};
    }
    return true;
}

}  // namespace

Predicates::Roots Predicates::roots(const Form& f, const Feature& first, const Feature& second, const Event& from,
                                    const Event& to) {
    Roots result;
    const auto keep = [&](const Event& x) {
        if (order(from, x) >= 0 || order(x, to) >= 0) return;
        if (result.count == 4) throw std::logic_error("more roots than the degree");
        result.at[result.count++] = x;
    };
    // A root may be one of the two ends: look a little beyond them, then compare.
    double found[enough][2];
    int count = 0;
    bool decided = false;
    for (double margin = 1e-12; margin < 1e-10 && !decided; margin *= 7)
        count = 0, decided = isolate_by_filter(f, from.lo - margin, to.hi + margin, found, count);
    if (decided) {
        ++counters.filter;
        for (int k = 0; k < count; ++k) keep({first, second, found[k][0], found[k][1]});
        return result;
    }
    ++counters.exact;
    const Poly p = polynomial(first, second);
    result.all_zero = p.empty();
    if (p.empty() || (p.size() == 3 && p[1] * p[1] < 4 * p[0] * p[2])) return result;
    const Sturm sturm(squarefree(p));
    const Dyadic lowest = Dyadic::from(std::nextafter(from.lo, -2)), highest = Dyadic::from(std::nextafter(to.hi, 2));
    for (auto [below, above] : isolate(sturm, lowest, highest, 56)) {
        const auto sign = [&](const Dyadic& t) { return cfree::sign_at(sturm.polynomial(), t); };
        while (sign(below) == 0) {  // the root before this one
            const Dyadic mid = Dyadic::middle(below, above);
            (sturm.roots_in(mid, above) == 1 ? below : above) = mid;
        }
        double l = below.rounded_down(), h = above.rounded_up();
        if (sign(above) == 0) below = above;
        // doubles around it, with no root at their ends; a finer interval if there is a second one between them
        while (sign(Dyadic::from(l)) == 0) l = std::nextafter(l, -2);
        while (sign(Dyadic::from(h)) == 0) h = std::nextafter(h, 2);
        Event x{first, second, l, h};
        if (sturm.roots_in(Dyadic::from(l), Dyadic::from(h)) != 1) {
            x.fine = static_cast<Index>(fine.size());
            fine.push_back({below, above});
        }
        keep(x);
    }
    return result;
}

Predicates::Roots Predicates::offset_roots(Index s, Index v, const Filtered& f, const Event& from, const Event& to) {
    return roots(Form{2, f, {}, {}, {}}, {Kind::vertex_vertex, s, v}, {}, from, to);
}

// Surfaces that share a helix cross where the helix meets the line, and where their own lines are parallel.
Predicates::Roots Predicates::crossings(const Form& f, const Feature& p, const Feature& q, const Event& from,
                                        const Event& to) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    if (p.kind == Kind::vertex_vertex || q.kind == Kind::vertex_vertex) return roots(f, p, q, from, to);
    if (p.kind == Kind::edge_vertex && q.kind == Kind::vertex_edge) return crossings(f, q, p, from, to);
    const auto end_of = [](const Shape& s, Index vertex, Index e) {
        return s.point[vertex] == s.point[s.v[e]] || s.point[vertex] == s.point[s.w[e]];
    };
    const auto shared_end = [&](const Shape& s, Index e, Index g) {
        return end_of(s, s.v[e], g) ? s.v[e] : end_of(s, s.w[e], g) ? s.w[e] : -1;
    };
    Index a = -1, b = -1;
    if (p.kind != q.kind) {  // v-e and e-v
        if (end_of(A, p.robot, q.robot) && end_of(O, q.obstacle, p.obstacle)) a = p.robot, b = q.obstacle;
    } else if (p.kind == Kind::vertex_edge) {
        if (A.point[p.robot] == A.point[q.robot]) a = p.robot, b = shared_end(O, p.obstacle, q.obstacle);
    } else if (O.point[p.obstacle] == O.point[q.obstacle]) {
        a = shared_end(A, p.robot, q.robot), b = p.obstacle;
    }
    if (a < 0 || b < 0) return roots(f, p, q, from, to);
    // one line both ways is one curve
    const bool on_one_line = p.kind == q.kind && (p.kind == Kind::vertex_edge ? O.direction[p.obstacle] == O.direction[q.obstacle]
                                                                             : A.direction[p.robot] == A.direction[q.robot]);
    if (on_one_line) return {0, true, {}};
    Roots result = offset_roots(a, b, offset(a, b), from, to);
    if (result.all_zero || p.kind == q.kind) return result;
    const Roots parallel = parallel_roots(q.robot, p.obstacle, from, to);
    for (int k = 0; k < parallel.count; ++k) {
        int at = result.count;
        while (at > 0 && order(parallel.at[k], result.at[at - 1]) < 0) --at;
        if (at > 0 && order(parallel.at[k], result.at[at - 1]) == 0) continue;
        for (int m = result.count++; m > at; --m) result.at[m] = result.at[m - 1];
        result.at[at] = parallel.at[k];
    }
    return result;
}

Predicates::Order Predicates::compare(const Curve& p, const Curve& q, const Event& from, const Event& to) {
    Order result;
    const auto constant = [&](int s) {
        result.sign[0] = s;
        return result;
    };
    if (p.code == q.code) return constant(0);
    const Form f = form(p, q);
    double c[5];
    const double err = f.bernstein(from.lo, to.hi, c);
    int positive = 0, negative = 0;
    for (int i = 0; i <= f.degree; ++i) positive += c[i] > err, negative += c[i] < -err;
    result.strict = positive == f.degree + 1 || negative == f.degree + 1;
    if (result.strict) return ++counters.filter, constant(positive > 0 ? 1 : -1);
    const Roots r = crossings(f, p.feature, q.feature, from, to);
    if (r.all_zero) return constant(0);
    const int flip = p.flipped != q.flipped ? -1 : 1;
    result.count = r.count;
    for (int k = 0; k <= r.count; ++k) {
        if (k < r.count) result.at[k] = r.at[k];
        const Event &before = k == 0 ? from : r.at[k - 1], &after = k == r.count ? to : r.at[k];
        result.sign[k] = 0;
        for (int attempt = 0; result.sign[k] == 0; ++attempt) {  // a sample may be where the curves touch
            if (attempt == 20) throw std::logic_error("two different curves are equal at twenty samples");
            const Sample at = between(before, after, (attempt + 10) / 30.0 + (attempt == 0 ? 1 / 6.0 : 0));
            const auto value = f.at(at.tau);
            if (!at.fine && std::abs(value.v) > value.err) {
                ++counters.filter;
                result.sign[k] = value.v > 0 ? 1 : -1;
            } else {
                ++counters.exact;
                result.sign[k] = flip * cfree::sign_at(polynomial(p.feature, q.feature), at.exact());
            }
        }
    }
    return result;
}

}  // namespace cfree

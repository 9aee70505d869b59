// Find trapezoids by their neighbours' sides in doubles, and closed surfaces by exact gluing; theory, "One surface alone".
#include "cfree/free/surface_explorer.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <queue>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "cfree/contact/contact_line.hpp"
#include "cfree/support/elementary.hpp"
#include "forbidden/kept_patches.hpp"
#include "free/touching_patches.hpp"

namespace cfree {

namespace {

// Ends of a segment of a trapezoid at an angle, rounded.
using Ends = std::array<Vec<double>, 2>;

double apart(const Vec<double>& p, const Vec<double>& q) { return norm(p.x - q.x, p.y - q.y); }

// Data of a trapezoid that determine its segments.
struct Sheet {
    ContactLine<double> line;
    std::array<Curve, 2> curves;  // lower, upper
};

struct Doubles {
    Vec<double> vertex(const Shape& s, Index v) const { return {s.x[v], s.y[v]}; }
    Vec<double> edge(const Shape& s, Index e) const { return vertex(s, s.w[e]) - vertex(s, s.v[e]); }
};

// Growth of a surface: it explores the nearest trapezoid next, on the way to a target if there is one.
struct Growth {
    struct Item {
        double cost, way;
        Index trapezoid;
        bool operator>(const Item& o) const { return cost > o.cost || (cost == o.cost && trapezoid > o.trapezoid); }
    };
    std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
    enum class Seen : char { no, queued, explored };
    struct Visit {
        Seen seen = Seen::no;
        double way = 0;  // when it was explored last
    };
    std::unordered_map<Index, Visit> visits;  // of the trapezoids that were looked at: few, however many there are
    Index target = -1;
    Vec<double> goal{};
    Index explored = 0, surely = 0;  // numbers explored, and of these confirmed by gluing
    static constexpr Index least_trust = 128;
    Index trust = least_trust;  // number of further ones before the next gluing
    bool has(Index k) const {
        const auto visit = visits.find(k);
        return visit != visits.end() && visit->second.seen == Seen::explored;
    }
};

}  // namespace

struct SurfaceExplorer::State {
    State(std::shared_ptr<const Scene> s, bool regularized)
        : given(std::move(s)), scene(given->near()), one(scene, regularized), touching(*given, one), names(scene),
          faces_of(one.patches.size(), {-1, -1}), trimmed(one.patches.size(), 0), met_patch(one.patches.size(), -1) {
        for (std::size_t v = 0; v < scene.robot.x.size(); ++v)
            nearness = std::max({nearness, std::abs(scene.robot.x[v]), std::abs(scene.robot.y[v])});
        nearness *= 1e-7;
    }

    void meet(Index patch) { patches_met += std::exchange(met_patch[patch], question) != question; }
    void trim(Index patch);
    void trim(std::vector<Index>& patches);
    void add_sheet(const Feature& contact, Index row);
    void grow_columns();
    void explore(Index k);
    Growth& growth(Index seed);
    void look_at(Growth& of, Index k, double way) const;
    double step(const Growth& of, const Vec<double>& from, Index next) const { return of.target < 0 ? 1 : apart(from, middle(next)); }
    GluedPart glued(Growth& of, Index seed, Index target);
    Vec<double> middle(Index k) const;
    Ends ends(Index k, double tau) const;
    double inside(Index k, double tau) const;
    bool may_share_curve(Index k, Index other) const;
    bool shares_curve(Index k, bool upper, Index other) const;
    bool may_share_level(Index k, bool last, Index other) const;
    bool shares_level(Index k, bool last, Index other) const;
    SharedBoundary boundary(Trapezoids of) const {
        return std::make_shared<const Boundary>(given, one.patches, trimmed, std::move(of), IsolatedParts{});
    }

    const std::shared_ptr<const Scene> given;
    const Scene& scene;
    PatchTrimming one;
    TouchingPatches touching;
    const Representatives names;
    Trapezoids rows;                               // trapezoids of patches in the order of trimming
    std::vector<std::array<Index, 2>> faces_of;    // each patch's rows
    std::vector<std::uint8_t> trimmed;
    // The question that is answered now, the last one that met each patch and each row, and how many patches it has met. What
    // it costs is counted as if nothing were kept: so it makes as many guesses, and has the answer that it has alone.
    int question = 0;
    std::vector<int> met_patch, met_row;
    std::size_t patches_met = 0, patches_trimmed = 0;
    std::vector<Sheet> sheets;                     // one per row
    std::vector<char> whole;                       // true for each row with all patches trimmed that its sides meet
    struct Neighbours {
        std::vector<Index> all;     // trapezoids that its sides may meet
        std::vector<Index> beside;  // trapezoids that seem to be across them
    };
    std::vector<Neighbours> around;                // then
    std::map<Index, Growth> growing;               // one per seed, of one question
    std::vector<Index> number;                     // scratch of gluing: -1 for each row
    double nearness = 0;                           // distance of points that may be equal; it decides only the order
    Index pillars_of = -1;
    PatchTrimming::Scratch scratch = one.scratch();
    Count count;
};

void SurfaceExplorer::State::trim(Index patch) {
    meet(patch);
    if (trimmed[patch]) return;
    const Feature contact = one.patches.contact(patch);
    if (contact.obstacle != pillars_of) {
        one.pillars_near(contact.obstacle, scratch.near);
        pillars_of = contact.obstacle;
    }
    std::vector<Trapezoid> found, thin;
    one.trim(patch, scratch, found, thin, count);
    trimmed[patch] = 1, ++patches_trimmed;
    const auto before = static_cast<Index>(rows.size());
    for (const Trapezoid& x : found) {
        rows.push_back(x);
        add_sheet(contact, static_cast<Index>(rows.size()) - 1);
    }
    for (auto* column : rows.features())
        for (std::size_t k = static_cast<std::size_t>(before); k < rows.size(); ++k) (*column)[k] = named(names, (*column)[k]);
    grow_columns();
    faces_of[patch] = {before, static_cast<Index>(rows.size())};
}

void SurfaceExplorer::State::add_sheet(const Feature& contact, Index row) {
    const Predicates on(scene, {contact, rows.chart[row]});
    sheets.push_back({ContactLine<double>(scene, contact, Doubles{}), {on.curve(unpacked(rows.lower[row])), on.curve(unpacked(rows.upper[row]))}});
}

void SurfaceExplorer::State::grow_columns() {
    whole.resize(rows.size(), 0), around.resize(rows.size()), number.resize(rows.size(), -1), met_row.resize(rows.size(), -1);
}

void SurfaceExplorer::State::trim(std::vector<Index>& patches) {
    std::sort(patches.begin(), patches.end());
    patches.erase(std::unique(patches.begin(), patches.end()), patches.end());
    for (const Index patch : patches) trim(patch);
}

Ends SurfaceExplorer::State::ends(Index k, double tau) const {
    const Sheet& sheet = sheets[k];
    const auto R = rotation_by(rows.chart[k], tau);
    const auto P = sheet.line.start(R), U = sheet.line.direction(R);
    const auto at = [&](const Curve& c) {
        const double t = c.N.polar(tau, tau) / c.D.polar(tau, tau);
        return Vec<double>{P.x + t * U.x, P.y + t * U.y};
    };
    return {at(sheet.curves[0]), at(sheet.curves[1])};
}

// True if another trapezoid is there at an angle of this one.
bool SurfaceExplorer::State::may_share_curve(Index k, Index other) const {
    return rows.chart[k] == rows.chart[other] && rows.from_lo[k] <= rows.to_hi[other] && rows.from_lo[other] <= rows.to_hi[k];
}

// True if also one of its sides is on the curve of a side of this one.
bool SurfaceExplorer::State::shares_curve(Index k, bool upper, Index other) const {
    const double from = std::max(rows.from_lo[k], rows.from_lo[other]), to = std::min(rows.to_hi[k], rows.to_hi[other]);
    const double tau = 0.5 * (from + to);
    const Vec<double> p = ends(k, tau)[upper];
    const Ends q = ends(other, tau);
    return apart(p, q[0]) <= nearness || apart(p, q[1]) <= nearness;
}

// Angle a little within a trapezoid: at its ends its curves may be 0 / 0.
double SurfaceExplorer::State::inside(Index k, double tau) const {
    constexpr double share = 1e-8;
    return tau + share * (0.5 * (rows.tau_from(k) + rows.tau_to(k)) - tau);
}

// True if another trapezoid begins or ends at the angle at which this one does.
bool SurfaceExplorer::State::may_share_level(Index k, bool last, Index other) const {
    const auto& [lo, hi] = last ? std::pair{rows.to_lo[k], rows.to_hi[k]} : std::pair{rows.from_lo[k], rows.from_hi[k]};
    if (rows.chart[k] != rows.chart[other])  // at the common end of both charts
        return std::abs(lo) == 1 && lo == hi && (rows.from_lo[other] == -lo || rows.to_hi[other] == -lo);
    return (rows.from_lo[other] <= hi && lo <= rows.from_hi[other]) || (rows.to_lo[other] <= hi && lo <= rows.to_hi[other]);
}

// True if also its line is the same, and the two are adjacent there.
bool SurfaceExplorer::State::shares_level(Index k, bool last, Index other) const {
    const double tau = last ? rows.tau_to(k) : rows.tau_from(k);
    const double there = rows.chart[k] == rows.chart[other] ? tau : -tau;
    const auto [p, q] = std::pair(ends(k, inside(k, tau)), ends(other, inside(other, there)));
    const Vec<double> U = p[1] - p[0];
    const double length = norm(U.x, U.y);
    if (length <= nearness) return apart(p[0], q[0]) <= nearness || apart(p[0], q[1]) <= nearness;
    for (const auto& x : q)
        if (std::abs(cross(U, x - p[0])) > nearness * length) return false;
    double low = dot(U, q[0] - p[0]), high = dot(U, q[1] - p[0]);
    if (low > high) std::swap(low, high);
    constexpr double least = 1e-5;  // times the nearness: apparent overlap of two that only touch
    return std::min(high, length * length) - std::max(low, 0.0) > least * nearness * length;
}

void SurfaceExplorer::State::explore(Index k) {
    const Surface on = surface_of(one.patches, rows, k);
    std::vector<Index> patches;
    Neighbours found;
    const auto look = [&](double lo, double hi, auto&& may_share, auto&& shares) {
        std::erase_if(patches, [&](Index patch) { return !trimmed[patch] && !touching.is_there(patch, on.chart, lo, hi); });
        trim(patches);
        for (const Index patch : patches)
            for (Index other = faces_of[patch][0]; other < faces_of[patch][1]; ++other) {
                if (other == k || !may_share(other)) continue;
                found.all.push_back(other);
                if (shares(other)) found.beside.push_back(other);
            }
        patches.clear();
    };
    const double from = rows.from_lo[k], to = rows.to_hi[k];
    for (const bool upper : {false, true}) {
        touching.on_curve(on, unpacked((upper ? rows.upper : rows.lower)[k]), from, to, patches);
        look(from, to, [&](Index other) { return may_share_curve(k, other); },
             [&](Index other) { return shares_curve(k, upper, other); });
    }
    for (const bool last : {false, true}) {
        const auto& [lo, hi] = last ? std::pair{rows.to_lo[k], rows.to_hi[k]} : std::pair{rows.from_lo[k], rows.from_hi[k]};
        touching.on_line(on, lo, hi, patches);
        look(lo, hi, [&](Index other) { return may_share_level(k, last, other); },
             [&](Index other) { return shares_level(k, last, other); });
    }
    whole[k] = 1, around[k] = std::move(found);
}

Vec<double> SurfaceExplorer::State::middle(Index k) const {
    const Ends p = ends(k, 0.5 * (rows.tau_from(k) + rows.tau_to(k)));
    return {0.5 * (p[0].x + p[1].x), 0.5 * (p[0].y + p[1].y)};
}

Growth& SurfaceExplorer::State::growth(Index seed) {
    const auto [found, is_new] = growing.try_emplace(seed);
    if (is_new) look_at(found->second, seed, 0);
    return found->second;
}

void SurfaceExplorer::State::look_at(Growth& g, Index k, double way) const {
    Growth::Visit& visit = g.visits[k];
    if (visit.seen != Growth::Seen::no) return;
    visit.seen = Growth::Seen::queued;
    constexpr double haste = 2;  // the way need not be the shortest
    g.queue.push({g.target < 0 ? way : way + haste * apart(middle(k), g.goal), way, k});
}

// Glue a surface; return it if nothing is missing or the target is reached. Else exploration continues from the missing
// trapezoids, and forgets those that only seemed to be across sides. Gluing takes the trapezoids within reach of the seed over
// sides: those explored from it, or on the way to a target all that this question has explored. Those of earlier questions are
// left out, or each question would cost more than the one before.
GluedPart SurfaceExplorer::State::glued(Growth& g, Index seed, Index target) {
    const bool is_reached = g.has(target);
    const auto is_whole = [&](Index k) { return is_reached ? met_row[k] == question : g.has(k); };
    std::vector<Index> chosen{seed};
    number[seed] = 0;
    for (std::size_t n = 0; n < chosen.size(); ++n) {
        if (!is_whole(chosen[n])) continue;
        for (const Index other : around[chosen[n]].all)
            if (number[other] < 0) number[other] = 0, chosen.push_back(other);
    }
    std::sort(chosen.begin(), chosen.end(), [&](Index x, Index y) {
        return rows.patch[x] != rows.patch[y] ? rows.patch[x] < rows.patch[y] : x < y;
    });
    Trapezoids some;
    std::vector<char> some_whole;
    for (const Index k : chosen)
        number[k] = static_cast<Index>(some.size()), some.push_row(rows, k), some_whole.push_back(is_whole(k));
    const Index first = number[seed], last = is_reached ? number[target] : -1;
    for (const Index k : chosen) number[k] = -1;
    GluedPart part = glue_part(boundary(std::move(some)), std::move(some_whole), {first}, last);
    if (part.missing.empty() || part.complex) return part;
    const std::size_t surely = part.faces.size();
    const bool has_leaked = 10 * static_cast<Index>(surely) < 9 * g.explored;
    for (auto& [k, visit] : g.visits) visit.seen = Growth::Seen::no;
    for (const Index k : part.faces) g.visits[chosen[k]].seen = Growth::Seen::explored;
    g.queue = {};
    g.explored = g.surely = static_cast<Index>(surely), g.trust = std::max(Growth::least_trust, (has_leaked ? 2 : 16) * g.surely);
    std::unordered_set<Index> is_missing;
    for (const Index k : part.missing) is_missing.insert(chosen[k]);
    for (const Index k : part.faces) {
        const Vec<double> here = middle(chosen[k]);
        const double way = g.visits[chosen[k]].way;
        for (const Index next : around[chosen[k]].beside)
            if (is_missing.contains(next)) look_at(g, next, way + step(g, here, next));
    }
    for (const Index k : part.missing) look_at(g, chosen[k], 0);
    return part;
}

SurfaceExplorer::SurfaceExplorer(std::shared_ptr<const Scene> scene, bool regularized)
    : state(std::make_unique<State>(std::move(scene), regularized)) {}
SurfaceExplorer::~SurfaceExplorer() = default;

std::optional<Index> SurfaceExplorer::trapezoid_at(const ExactPose& pose, Index vertex) {
    std::vector<Index> patches;
    state->touching.at_pose(pose, vertex, patches);
    const auto surface = [&](Index patch) { return code(state->scene, state->one.patches.contact(patch)); };
    for (const Index patch : patches)
        if (surface(patch) != surface(patches[0])) return {};
    state->trim(patches);
    std::vector<Index> there;
    Trapezoids rows;
    for (const Index patch : patches)
        for (Index k = state->faces_of[patch][0]; k < state->faces_of[patch][1]; ++k) {
            there.push_back(k);
            rows.push_row(state->rows, k);
        }
    const auto few = state->boundary(std::move(rows));
    const auto seen = PointLocation(few, std::vector<Index>(there.size(), 0)).nearby(pose);
    if (seen.on.size() != 1 || seen.end[0] != 0) return {};
    return there[seen.on[0]];
}

void SurfaceExplorer::take(const SurfaceExplorer& other, const KeptFeatures& kept) {
    State& s = *state;
    const State& t = *other.state;
    for (std::size_t j = 0; j < kept.from.size(); ++j) {
        if (kept.from[j] < 0) continue;
        const Index first = s.one.first_patch[j], first_before = t.one.first_patch[kept.from[j]];
        for (Index n = 0; n < s.one.first_patch[j + 1] - first; ++n) {
            const Index patch = first + n;
            if (s.trimmed[patch] || !t.trimmed[first_before + n]) continue;
            const auto [begin, end] = t.faces_of[first_before + n];
            const auto before = static_cast<Index>(s.rows.size());
            for (Index k = begin; k < end; ++k) {
                s.rows.push_row(t.rows, k);
                s.rows.patch.back() = patch;
                for (auto* column : s.rows.features()) column->back() = named(s.names, kept.renamed(column->back()));
                s.add_sheet(s.one.patches.contact(patch), static_cast<Index>(s.rows.size()) - 1);
            }
            s.trimmed[patch] = 1, ++s.patches_trimmed;
            s.faces_of[patch] = {before, static_cast<Index>(s.rows.size())};
        }
    }
    s.grow_columns();
}

std::shared_ptr<const CellComplex> SurfaceExplorer::taken(const CellComplex& surface, const KeptFeatures& kept) const {
    const State& s = *state;
    const Boundary& before = *surface.boundary;
    const std::vector<Index> first_before = first_patches(before.scene->near(), before.patches);
    std::vector<Index> now(first_before.size(), -1);
    for (std::size_t j = 0; j < kept.from.size(); ++j)
        if (kept.from[j] >= 0) now[kept.from[j]] = static_cast<Index>(j);
    Trapezoids rows;
    for (std::size_t k = 0; k < before.trapezoids.size(); ++k) {
        const Index patch = before.trapezoids.patch[k], from = before.patches.obstacle[patch];
        if (now[from] < 0) return nullptr;
        rows.push_row(before.trapezoids, static_cast<Index>(k));
        rows.patch.back() = s.one.first_patch[now[from]] + patch - first_before[from];
        for (auto* column : rows.features()) column->back() = named(s.names, kept.renamed(column->back()));
    }
    auto result = std::make_shared<CellComplex>(surface);
    result->boundary = s.boundary(std::move(rows));
    return result;
}

std::size_t SurfaceExplorer::trimmed_patches() const {
    return state->patches_trimmed;
}

std::size_t SurfaceExplorer::met_patches() const { return state->patches_met; }

void SurfaceExplorer::begin() { ++state->question, state->patches_met = 0, state->growing.clear(); }

SurfaceExplorer::Grown SurfaceExplorer::grow(Index seed, Index most, Index target) {
    State& s = *state;
    Growth& g = s.growth(seed);
    if (g.target < 0 && target >= 0) g.target = target, g.goal = s.middle(target);
    for (;;) {
        heed_stop();
        // glue again and again: a wrong guess across a side may lead far into other surfaces
        const Index new_ones = g.explored - g.surely;
        if (g.queue.empty() || new_ones > g.trust || (g.has(target) && 4 * new_ones >= g.surely)) {
            if (GluedPart part = s.glued(g, seed, target); part.complex) return {part.complex, part.missing.empty()};
        }
        const auto [cost, way, k] = g.queue.top();
        const bool is_met = s.met_row[k] == s.question;
        if (!is_met && most-- == 0) return {};
        g.queue.pop();
        if (!s.whole[k]) s.explore(k);
        else if (!is_met)
            for (const Index other : s.around[k].all) s.meet(s.rows.patch[other]);
        s.met_row[k] = s.question;
        g.visits[k] = {Growth::Seen::explored, way}, ++g.explored;
        const Vec<double> here = s.middle(k);
        for (const Index next : s.around[k].beside) s.look_at(g, next, way + s.step(g, here, next));
    }
}

}  // namespace cfree

// Distinguish curves by their hashes, then exactly; order rays around a point of each; theory, "Closed surfaces".
#include "forbidden/curve_sides.hpp"

#include <algorithm>
#include <array>

#include "cfree/contact/contact_line.hpp"
#include "cfree/forbidden/curve_hashes.hpp"
#include "support/parallel.hpp"

namespace cfree {

namespace {

struct CurveSide {
    CurveHash hash;
    Index from;
    std::uint32_t name;  // twice the trapezoid, 1 more for its upper curve
    Index trapezoid() const { return static_cast<Index>(name / 2); }
    bool is_upper() const { return name % 2 != 0; }
};

class CurveGluer {
public:
    CurveGluer(const Boundary& b, const Whole& w, Around a)
        : scene(b.scene->near()), patches(b.patches), trapezoids(b.trapezoids), angles(b.angles()), whole(w), around(a) {}

    Parts run(CurveSide* begin, CurveSide* end) {
        std::sort(begin, end, [](const CurveSide& x, const CurveSide& y) {
            if (x.hash != y.hash) return x.hash < y.hash;
            return x.from < y.from || (x.from == y.from && x.name < y.name);
        });
        for (CurveSide *first = begin, *next; first != end; first = next) {
            heed_stop();
            Index reach = to(*first);  // runs that overlap in theta
            for (next = first + 1; next != end && next->hash == first->hash && next->from < reach; ++next)
                reach = std::max(reach, to(*next));
            glue(first, next);
        }
        parts.finish();
        return std::move(parts);
    }

private:
    Index to(const CurveSide& s) const { return angles.to[s.trapezoid()]; }
    Feature contact(Index trapezoid) const { return surface_of(patches, trapezoids, trapezoid).contact; }
    NamedCurve curve(const CurveSide& s) const {
        const Index k = s.trapezoid();
        return {contact(k), unpacked((s.is_upper() ? trapezoids.upper : trapezoids.lower)[k])};
    }
    void glue(CurveSide* begin, CurveSide* end);
    void pair_around_point(Index from, Index to);

    const Scene& scene;
    const Patches& patches;
    const Trapezoids& trapezoids;
    const AngleTable& angles;
    const Whole& whole;
    const Around around;
    Parts parts;
    std::vector<Index> ranks, live;  // storage that is used again
    std::vector<const CurveSide*> there;
};

// Glue sides with one hash: first those on the first's curve, then the others.
void CurveGluer::glue(CurveSide* begin, CurveSide* end) {
    if (std::none_of(begin, end, [&](const CurveSide& s) { return whole[s.trapezoid()]; })) return;
    const NamedCurve first = curve(*begin);
    CurveSide* others =
        std::stable_partition(begin + 1, end, [&](const CurveSide& s) { return is_same_curve(scene, first, curve(s)); });
    if (others != end) glue(others, end);
    end = others;
    ranks.clear(), there.clear();
    for (const CurveSide* s = begin; s != end; ++s) ranks.push_back(s->from), ranks.push_back(to(*s));
    std::sort(ranks.begin(), ranks.end());
    ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
    const CurveSide* next = begin;
    for (std::size_t r = 0; r + 1 < ranks.size(); ++r) {
        heed_stop();
        const Index from = ranks[r], until = ranks[r + 1];
        std::erase_if(there, [&](const CurveSide* s) { return to(*s) <= from; });
        for (; next != end && next->from == from; ++next) there.push_back(next);
        if (there.empty()) continue;
        parts.begin_edge();
        live.clear();
        for (const CurveSide* s : there) {
            const Side side = s->is_upper() ? Side::upper : Side::lower;
            live.push_back(parts.add(s->trapezoid(), side, false, is_forwards(side) ? from : until));
        }
        if (live.size() == 2 && parts.side(live[0]) != parts.side(live[1])) parts.pair(live[0], live[1]);
        else if (around == Around::all && live.size() <= 2) parts.pair(live.front(), live.back());
        else pair_around_point(from, until);
    }
}

// Pair rays from the point, counter-clockwise: after a segment that arrives (an upper end) there is a free sector.
void CurveGluer::pair_around_point(Index from, Index to) {
    const int chart = trapezoids.chart[parts.trapezoid[live[0]]];
    const Dyadic tau = angles.between(from, to, chart).exact();
    const auto R = rotation_by(chart, tau.n, Int(1) << tau.k);
    struct Ray {
        Vec<Int> d;
        bool arrives;
        Index part;
        int half() const { return d.y.sign() > 0 || (d.y.is_zero() && d.x.sign() > 0) ? 0 : 1; }
    };
    std::vector<Ray> rays;
    for (const Index k : live) {
        const Feature f = contact(parts.trapezoid[k]);
        const auto d = ContactLine<Int>(scene, f, CoreUnits<Int>{}).direction(R);
        const bool arrives = parts.side(k) == Side::upper;
        rays.push_back({arrives ? -d : d, arrives, k});
    }
    std::sort(rays.begin(), rays.end(), [](const Ray& x, const Ray& y) {
        if (x.half() != y.half()) return x.half() < y.half();
        const int turn = cross(x.d, y.d).sign();
        return turn != 0 ? turn > 0 : x.arrives > y.arrives;  // space between two sheets of one slit has no width, but is free
    });
    for (std::size_t k = 0; k < rays.size(); ++k) {
        const Ray &x = rays[k], &y = rays[(k + 1) % rays.size()];
        if (around == Around::all) {
            parts.twin[x.part] = y.part;
            continue;
        }
        if (x.arrives == y.arrives || rays.size() % 2 != 0)
            fail_to_glue("a curve with " + std::to_string(rays.size()) + " sides that do not alternate", parts.trapezoid[x.part], whole);
        if (x.arrives) parts.pair(x.part, y.part);
    }
}

}  // namespace

std::vector<Parts> glue_curves(const Boundary& b, const Whole& whole, Around around, int threads) {
    if (b.scene->near().is_round) {
        std::vector<Parts> lists;
        lists.push_back(glue_round_curves(b, whole, around));
        return lists;
    }
    const Trapezoids& t = b.trapezoids;
    const AngleTable& angles = b.angles();
    const std::size_t count = 2 * t.size();
    std::vector<CurveSide> sides(count);
    constexpr std::size_t lists = 256;
    std::array<std::size_t, lists + 1> start{};
    {
        const CurveHashes hashes(b.scene->near(), count, [&](std::size_t k) {
            const auto of = static_cast<Index>(k / 2);
            return NamedCurve{surface_of(b.patches, t, of).contact, unpacked((k % 2 != 0 ? t.upper : t.lower)[of])};
        }, threads);
        const auto list = [&](std::size_t k) { return hashes[k].x >> 54; };  // hashes are below 2^62
        for (std::size_t k = 0; k < count; ++k) ++start[list(k) + 1];
        for (std::size_t x = 0; x < lists; ++x) start[x + 1] += start[x];
        auto place = start;
        for (std::size_t k = 0; k < count; ++k)
            sides[place[list(k)]++] = {hashes[k], angles.from[k / 2], static_cast<std::uint32_t>(k)};
    }
    std::vector<Parts> result(lists);
    for_each_in_parallel(threads, lists, [&](std::size_t x) {
        result[x] = CurveGluer(b, whole, around).run(sides.data() + start[x], sides.data() + start[x + 1]);
    });
    return result;
}

}  // namespace cfree

// Group sides at one angle by line: first by surface, then by direction, then by offset; theory, "Closed surfaces".
#include "forbidden/level_sides.hpp"

#include <algorithm>
#include <numeric>
#include <span>

#include "forbidden/junction_at.hpp"
#include "forbidden/meetings_of_three.hpp"
#include "forbidden/parallel_edges.hpp"
#include "forbidden/partners.hpp"
#include "predicates/round_junction.hpp"
#include "support/parallel.hpp"
#include "support/union_find.hpp"

namespace cfree {

namespace {

struct Level {
    Index trapezoid;
    bool is_above;
    Feature contact, lower, upper;
    Code low_code, high_code;
    Index low, high;    // its ends among the places, in the order of its own line
    int along = 1;      // direction of its line against that of the line's first level
    Index first, last;  // numbers of its ends along that
};

// The levels on one surface: at this angle they are on one line.
struct Sheet {
    Code code;
    std::span<Index> levels;    // in order, as lists of numbers are everywhere below
    Feature contact;            // contact of the first level
    int along = 1;              // direction against that of the first sheet parallel to it
    Interval offset;            // offset from that sheet; only for the first on a line
};

// At is Junction, or RoundJunction where shapes are grown.
template <class At>
class LevelGluer {
    using Spot = typename At::Spot;
    static constexpr bool is_round = std::is_same_v<At, RoundJunction>;

public:
    LevelGluer(const Boundary& b, const Whole& w, Around a)
        : scene(b.scene->near()), angles(b.angles()), whole(w), around(a) {}

    void glue(Index rank, std::span<const SideAtAngle> sides);
    Parts parts;

private:
    std::vector<Sheet> sheets_of_levels();
    void find_places(Sheet& sheet, At& at);
    std::vector<std::vector<Sheet*>> parallels(std::vector<Sheet>& sheets, At& at) const;
    std::vector<std::vector<Sheet*>> lines_of(const std::vector<Sheet*>& parallel) const;
    std::vector<std::vector<Sheet*>> circles(std::vector<Sheet>& sheets, At& at) const;
    void glue_parallels(const std::vector<Sheet*>& sheets, At& at);
    void glue_line(std::span<Sheet* const> sheets, At& at);
    void join_by_curve(const std::vector<Index>& chosen, std::vector<Index>& on_it);
    bool glue_two_alike(const Sheet& sheet, At& at);
    int order(const Feature& line, Index p, Index q, At& at) const;
    void number_places(const Feature& line, std::vector<Index>& on_it, At& at);
    void pair_around_line(const std::vector<std::pair<const Level*, Index>>& live, const Spot& p, const Spot& q, At& at);

    const Scene& scene;
    const AngleTable& angles;
    const Whole& whole;
    const Around around;
    std::vector<Level> levels;
    struct LevelEnd {
        Code curve;
        bool is_above;  // of two places, where the curve jumps at this angle
        Index level;
        bool is_high;
        auto operator<=>(const LevelEnd&) const = default;
    };
    std::vector<LevelEnd> ends;  // storage that is used again, as the next
    std::vector<std::pair<Code, Index>> by_code;
    std::vector<Index> of_sheets;  // levels, sheet by sheet
    // Places at which curves arrive on a sheet, each once; where sheets are on one line, t and numbers along that.
    struct PlaceOnLine : LinePlace<At> {
        Interval on_line;
        Index number;  // the same for equal places
    };
    std::vector<PlaceOnLine> places;
};

template <class At>
void LevelGluer<At>::glue(Index rank, std::span<const SideAtAngle> sides) {
    if (std::none_of(sides.begin(), sides.end(), [&](const SideAtAngle& s) { return whole[s.trapezoid]; })) return;
    const int chart = rank > angles.middle ? 1 : 0;
    At at = junction_at<At>(scene, angles, rank, chart);
    if constexpr (!is_round)
        if (glue_meetings_of_three(scene, whole, sides, at, parts) || glue_parallel_edges(scene, whole, sides, at, parts)) return;
    levels.clear(), places.clear();
    for (const SideAtAngle& s : sides) {
        const CriticalAngle angle = s.angle();
        if constexpr (!is_round) know(at, scene, angle);
        else if (angle.first.kind == Kind::edge_edge) at.know_parallel(angle.first.robot, angle.first.obstacle);
        else if (angle.second.kind == Kind::none && angle.first.kind != Kind::none) at.know_touch(s.on.contact, angle.first);
        else if (angle.second.kind != Kind::none && angle.place == 0)
            at.know_meeting(s.on.contact, angle.first, angle.second, angle.lo, angle.hi);
        levels.push_back({s.trapezoid, s.is_above, s.on.contact, s.lower, s.upper, code(scene, s.lower), code(scene, s.upper), 0, 0, 1, 0, 0});
    }
    std::vector<Sheet> sheets = sheets_of_levels();
    for (Sheet& s : sheets) find_places(s, at);
    std::erase_if(sheets, [](const Sheet& s) { return s.levels.empty(); });
    std::sort(sheets.begin(), sheets.end(), [](const Sheet& x, const Sheet& y) { return x.levels[0] < y.levels[0]; });
    for (const auto& direction : parallels(sheets, at)) glue_parallels(direction, at);
    if constexpr (is_round)
        for (const auto& circle : circles(sheets, at)) glue_line(circle, at);
}

template <class At>
std::vector<Sheet> LevelGluer<At>::sheets_of_levels() {
    by_code.clear(), of_sheets.clear();
    for (const Level& x : levels) by_code.push_back({code(scene, x.contact), static_cast<Index>(by_code.size())});
    std::sort(by_code.begin(), by_code.end());
    for (const auto& [own, k] : by_code) of_sheets.push_back(k);
    std::vector<Sheet> result;
    for (std::size_t begin = 0, end; begin < by_code.size(); begin = end) {
        const Code own = by_code[begin].first;
        for (end = begin + 1; end < by_code.size() && by_code[end].first == own; ++end) {}
        result.push_back({own, std::span(of_sheets).subspan(begin, end - begin), levels[of_sheets[begin]].contact, 1, {}});
    }
    return result;
}

// Find the ends of a sheet's levels; levels without width are left out.
template <class At>
void LevelGluer<At>::find_places(Sheet& sheet, At& at) {
    const auto spot_of = [&](Index k, bool is_high) {
        const Feature named = is_high ? levels[k].upper : levels[k].lower;
        if constexpr (is_round) return at.spot(levels[k].contact, named, levels[k].is_above);
        else return at.spot(levels[k].contact, named);
    };
    ends.clear();
    for (const Index k : sheet.levels) {
        if (levels[k].low_code == levels[k].high_code) continue;
        for (const bool is_high : {false, true}) {
            bool jumps_after = false;
            if constexpr (is_round) jumps_after = levels[k].is_above && spot_of(k, is_high).jumps;
            ends.push_back({is_high ? levels[k].high_code : levels[k].low_code, jumps_after, k, is_high});
        }
    }
    std::sort(ends.begin(), ends.end());
    for (std::size_t k = 0; k < ends.size(); ++k) {
        const auto& [curve, is_above, of, is_high] = ends[k];
        if (k == 0 || ends[k - 1].curve != curve || ends[k - 1].is_above != is_above) {
            const auto place = LinePlace<At>::read(sheet.contact, spot_of(of, is_high), at);
            places.push_back({place, place.t, 0});
        }
        (is_high ? levels[of].high : levels[of].low) = static_cast<Index>(places.size()) - 1;
    }
    const auto end = std::remove_if(sheet.levels.begin(), sheet.levels.end(), [&](Index k) {
        return levels[k].low_code == levels[k].high_code || order(sheet.contact, levels[k].low, levels[k].high, at) == 0;
    });
    sheet.levels = {sheet.levels.begin(), end};
}

// Group sheets by the direction of their lines. Sheets of one kind are parallel if their edges are. At most one direction of
// the obstacles' edges is also that of a turned edge of the robot: halving finds it.
template <class At>
std::vector<std::vector<Sheet*>> LevelGluer<At>::parallels(std::vector<Sheet>& sheets, At& at) const {
    struct Direction {
        Index number;
        std::vector<Sheet*> sheets;
        int half = 1;  // 1: it is on the left of the first; -1: its opposite is
        const Feature& line() const { return sheets[0]->contact; }
    };
    const auto directions = [&](Kind kind) {
        std::vector<std::pair<Index, Sheet*>> by_number;
        for (Sheet& s : sheets) {
            if (s.contact.kind != kind) continue;
            const Index number = kind == Kind::vertex_edge ? scene.obstacles.direction[s.contact.obstacle]
                                                           : scene.robot.direction[s.contact.robot];
            by_number.push_back({number, &s});
        }
        std::sort(by_number.begin(), by_number.end());
        std::vector<Direction> result;
        for (const auto& [number, s] : by_number) {
            if (result.empty() || result.back().number != number) result.push_back({number, {}, 1});
            result.back().sheets.push_back(s);
        }
        return result;
    };
    auto of_obstacles = directions(Kind::vertex_edge), of_robot = directions(Kind::edge_vertex);
    if (!of_obstacles.empty() && !of_robot.empty()) {
        const Feature zero = of_obstacles[0].line();
        for (auto d = of_obstacles.begin() + 1; d != of_obstacles.end(); ++d) d->half = at.turn(zero, d->line());
        std::sort(of_obstacles.begin() + 1, of_obstacles.end(), [&](const Direction& x, const Direction& y) {
            return x.number != y.number && at.turn(x.line(), y.line()) * x.half * y.half > 0;
        });
        for (Direction& d : of_robot) {
            d.half = at.turn(zero, d.line());
            const auto turn_from = [&](const Direction& x) { return at.turn(x.line(), d.line()) * x.half * d.half; };
            auto found = of_obstacles.begin();
            if (d.half != 0) {
                found = std::partition_point(found + 1, of_obstacles.end(), [&](const Direction& x) { return turn_from(x) > 0; });
                if (found == of_obstacles.end() || turn_from(*found) != 0) continue;
            }
            found->sheets.insert(found->sheets.end(), d.sheets.begin(), d.sheets.end());
            d.sheets.clear();
        }
    }
    std::vector<std::vector<Sheet*>> result;
    for (auto* each : {&of_obstacles, &of_robot})
        for (Direction& d : *each) {
            if (d.sheets.empty()) continue;
            std::sort(d.sheets.begin(), d.sheets.end());
            result.push_back(std::move(d.sheets));
        }
    std::sort(result.begin(), result.end());
    return result;
}

// Sheets on one circle.
template <class At>
std::vector<std::vector<Sheet*>> LevelGluer<At>::circles(std::vector<Sheet>& sheets, At& at) const {
    std::vector<std::vector<Sheet*>> result;
    for (Sheet& s : sheets) {
        if (!is_circle(s.contact)) continue;
        const auto same = std::find_if(result.begin(), result.end(), [&](const auto& circle) { return at.are_one_circle(circle[0]->contact, s.contact); });
        if (same == result.end()) {
            result.push_back({&s});
            continue;
        }
        s.along = is_concave(scene, s.contact) == is_concave(scene, same->front()->contact) ? 1 : -1;
        same->push_back(&s);
    }
    return result;
}

// Parallel sheets with a helix in common, on the same side of it, are on one line.
template <class At>
std::vector<std::vector<Sheet*>> LevelGluer<At>::lines_of(const std::vector<Sheet*>& parallel) const {
    struct End {
        Code helix;
        int along;  // opposite lines are on both sides of a helix that is grown
        Index sheet;
        auto operator<=>(const End&) const = default;
    };
    std::vector<End> ends;
    for (std::size_t k = 0; k < parallel.size(); ++k)
        for (const int end : {0, 1})
            ends.push_back({code(scene, end_helix(scene, parallel[k]->contact, end)), is_round ? parallel[k]->along : 1, static_cast<Index>(k)});
    std::sort(ends.begin(), ends.end());
    UnionFind joined(parallel.size());
    for (std::size_t k = 1; k < ends.size(); ++k)
        if (ends[k - 1].helix == ends[k].helix && ends[k - 1].along == ends[k].along) joined.unite(ends[k - 1].sheet, ends[k].sheet);
    std::vector<Index> line;
    std::vector<std::vector<Sheet*>> lines(static_cast<std::size_t>(joined.number(line)));
    for (std::size_t k = 0; k < parallel.size(); ++k) lines[line[k]].push_back(parallel[k]);
    return lines;
}

// Glue line after line, from right to left of the first.
template <class At>
void LevelGluer<At>::glue_parallels(const std::vector<Sheet*>& sheets, At& at) {
    if (sheets.size() == 1) return glue_line(sheets, at);
    const Feature& front = sheets[0]->contact;
    for (Sheet* s : sheets) s->along = s == sheets[0] ? 1 : at.parallel(front, s->contact);
    std::vector<std::vector<Sheet*>> lines = lines_of(sheets);
    for (const auto& line : lines) line[0]->offset = at.offset(front, line[0]->contact);
    const auto is_right = [&](const std::vector<Sheet*>& of, const std::vector<Sheet*>& other) {
        const Sheet &x = *of[0], &y = *other[0];
        if (x.offset.hi < y.offset.lo || y.offset.hi < x.offset.lo) return x.offset.hi < y.offset.lo;
        return at.side(x.contact, y.contact) * x.along > 0;
    };
    std::stable_sort(lines.begin(), lines.end(), is_right);
    for (std::size_t begin = 0, end; begin < lines.size(); begin = end) {
        std::vector<Sheet*> line = lines[begin];
        for (end = begin + 1; end < lines.size() && !is_right(lines[begin], lines[end]); ++end)
            line.insert(line.end(), lines[end].begin(), lines[end].end());
        glue_line(line, at);
    }
}

// Match a side below and one above on a surface that is alone on its line, if they have the same ends.
template <class At>
bool LevelGluer<At>::glue_two_alike(const Sheet& sheet, At& at) {
    const Level &x = levels[sheet.levels[0]], &y = levels[sheet.levels[1]];
    const auto ordered = [&](Index p, Index q) { return order(sheet.contact, p, q, at); };
    if (x.is_above == y.is_above || ordered(x.low, x.high) >= 0 || ordered(x.low, y.low) != 0 || ordered(x.high, y.high) != 0) return false;
    if (whole[x.trapezoid] || whole[y.trapezoid])
        pair_on_piece<At>({x.trapezoid, x.is_above, x.contact}, {y.trapezoid, y.is_above, y.contact}, places[x.low], places[x.high],
                          at, parts);
    return true;
}

template <class At>
void LevelGluer<At>::glue_line(std::span<Sheet* const> sheets, At& at) {
    if (sheets.size() == 1 && sheets[0]->levels.size() == 2 && glue_two_alike(*sheets[0], at)) return;
    std::vector<Index> chosen;
    for (const Sheet* s : sheets)
        for (const Index k : s->levels) chosen.push_back(k), levels[k].along = s->along;
    if (std::none_of(chosen.begin(), chosen.end(), [&](Index k) { return whole[levels[k].trapezoid]; })) return;
    std::sort(chosen.begin(), chosen.end());
    const Feature line = levels[chosen[0]].contact;
    const int along = levels[chosen[0]].along;
    std::vector<Index> on_it;
    for (const Index k : chosen) {
        levels[k].along *= along;
        on_it.push_back(levels[k].low), on_it.push_back(levels[k].high);
    }
    if (sheets.size() > 1) {
        if constexpr (!is_round) join_by_curve(chosen, on_it);
        for (const Index p : on_it) places[p].on_line = LinePlace<At>::read(line, places[p].spot, at).t;
    }
    number_places(line, on_it, at);
    for (const Index k : chosen) {
        Level& x = levels[k];
        x.first = places[x.low].number, x.last = places[x.high].number;
        if (x.along < 0) std::swap(x.first, x.last);
        if (x.first >= x.last) fail_to_glue("a side that runs backwards", x.trapezoid, whole);
    }
    std::vector<Index> by_first = chosen, there;
    std::stable_sort(by_first.begin(), by_first.end(), [&](Index x, Index y) { return levels[x].first < levels[y].first; });
    std::vector<std::pair<const Level*, Index>> live;
    auto next = by_first.begin();
    for (Index k = 0; k + 1 < static_cast<Index>(on_it.size()); ++k) {
        heed_stop();
        std::erase_if(there, [&](Index x) { return levels[x].last <= k; });
        for (; next != by_first.end() && levels[*next].first == k; ++next) there.push_back(*next);
        if (there.empty()) continue;
        std::sort(there.begin(), there.end());
        parts.begin_edge();
        live.clear();
        for (const Index x : there) {
            const Level& level = levels[x];
            const bool forwards = level.along > 0;
            const Side side = level.is_above ? Side::first : Side::last;
            const PlaceOnLine& start = places[on_it[is_forwards(side) == forwards ? k : k + 1]];
            live.push_back({&level, parts.add(level.trapezoid, side, !forwards, start.value(level.contact, at))});
        }
        pair_around_line(live, places[on_it[k]].spot, places[on_it[k + 1]].spot, at);
    }
}

// Let ends at one curve be one place, though their surfaces differ.
template <class At>
void LevelGluer<At>::join_by_curve(const std::vector<Index>& chosen, std::vector<Index>& on_it) {
    by_code.clear();
    for (std::size_t k = 0; k < on_it.size(); ++k)
        if (const Spot& spot = places[on_it[k]].spot; !spot.given) by_code.push_back({spot.code, static_cast<Index>(k)});
    std::sort(by_code.begin(), by_code.end());
    for (std::size_t k = 1; k < by_code.size(); ++k)
        if (by_code[k].first == by_code[k - 1].first) on_it[by_code[k].second] = on_it[by_code[k - 1].second];
    for (std::size_t k = 0; k < chosen.size(); ++k) {
        Level& x = levels[chosen[k]];
        x.low = on_it[2 * k], x.high = on_it[2 * k + 1];
    }
    for (std::size_t k = by_code.size(); k-- > 1;)
        if (by_code[k].first == by_code[k - 1].first) on_it[by_code[k].second] = -1;
    std::erase(on_it, -1);
}

// Order of two places along a line.
template <class At>
int LevelGluer<At>::order(const Feature& line, Index p, Index q, At& at) const {
    if (p == q) return 0;
    const auto &x = places[p], &y = places[q];
    if (x.on_line.hi < y.on_line.lo) return -1;
    return y.on_line.hi < x.on_line.lo ? 1 : at.order(line, x.spot, y.spot);
}

// Order places along a line, one for equal places, and number all of them.
template <class At>
void LevelGluer<At>::number_places(const Feature& line, std::vector<Index>& on_it, At& at) {
    const auto is_before = [&](Index p, Index q) { return order(line, p, q, at) < 0; };
    std::stable_sort(on_it.begin(), on_it.end(), is_before);
    std::size_t count = 0;
    for (std::size_t k = 0; k < on_it.size(); ++k) {
        if (k == 0 || is_before(on_it[count - 1], on_it[k])) on_it[count++] = on_it[k];
        places[on_it[k]].number = static_cast<Index>(count) - 1;
    }
    on_it.resize(count);
}

// Pair levels around the line, viewed along it: theta upwards, the line's left to the right. Counter-clockwise from there.
template <class At>
void LevelGluer<At>::pair_around_line(const std::vector<std::pair<const Level*, Index>>& live, const Spot& p, const Spot& q,
                                      At& at) {
    if (around == Around::all && live.size() <= 2) return parts.pair(live.front().second, live.back().second);
    if (is_circle(live[0].first->contact)) {  // one surface before, and one after; or before, or after, two that face each other
        const auto is_above = [](const auto& x) { return x.first->is_above; };
        auto sides = live;
        const auto below = std::stable_partition(sides.begin(), sides.end(), is_above);
        const auto face_each_other = [](auto begin, auto end) { return end - begin == 2 && begin[0].first->along != begin[1].first->along; };
        const bool is_one = live.size() == 2 && below - sides.begin() == 1 && sides[0].first->along == sides[1].first->along;
        const bool has_above = face_each_other(sides.begin(), below), has_below = face_each_other(below, sides.end());
        if (!is_one && live.size() != (has_above ? 2u : 0u) + (has_below ? 2u : 0u))
            fail_to_glue("a circle with " + std::to_string(live.size()) + " sides", live[0].first->trapezoid, whole);
        if (is_one || has_above) parts.pair(sides[0].second, sides[1].second);
        if (has_below) parts.pair(below[0].second, below[1].second);
        return;
    }
    auto sorted = live;
    const auto is_left = [&](const Level* x, const Level* y) {  // x further left than y, of two above or two below
        const int s = at.across(x->contact, y->contact, p, q, x->is_above) * y->along;
        return s != 0 ? s > 0 : x->along > y->along;  // one slit: the left of its left sheet is forbidden
    };
    // stable: a merge stays within its arrays for any order of sheets from outside
    std::stable_sort(sorted.begin(), sorted.end(), [&](const auto& x, const auto& y) {
        if (x.second == y.second) return false;
        if (x.first->is_above != y.first->is_above) return x.first->is_above;
        return x.first->is_above ? is_left(x.first, y.first) : is_left(y.first, x.first);
    });
    // forbidden is on the left of a segment
    const auto free_after = [](const Level* x) { return x->is_above == (x->along > 0); };
    for (std::size_t k = 0; k < sorted.size(); ++k) {
        const auto &x = sorted[k], &y = sorted[(k + 1) % sorted.size()];
        if (around == Around::all) {
            parts.twin[x.second] = y.second;
            continue;
        }
        if (sorted.size() % 2 != 0 || free_after(x.first) == free_after(y.first))
            fail_to_glue("a line with " + std::to_string(sorted.size()) + " sides that do not alternate", x.first->trapezoid, whole);
        if (free_after(x.first)) parts.pair(x.second, y.second);
    }
}

}  // namespace

std::vector<Parts> glue_levels(const Boundary& b, const Whole& whole, Around around, int threads) {
    const AngleTable& angles = b.angles();
    const auto n = static_cast<Index>(b.trapezoids.size());
    // sides by the angle where trapezoids begin, or end; the last angle is the first
    const Index ranks = angles.last;
    const auto round = [&](Index rank) { return rank == angles.last ? 0 : rank; };
    std::vector<Index> start(static_cast<std::size_t>(ranks) + 1, 0), sides(2 * static_cast<std::size_t>(n));
    for (Index k = 0; k < n; ++k) ++start[round(angles.from[k]) + 1], ++start[round(angles.to[k]) + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<Index> place(start.begin(), start.end() - 1);
    for (Index k = 0; k < n; ++k)
        sides[place[round(angles.from[k])]++] = 2 * k, sides[place[round(angles.to[k])]++] = 2 * k + 1;
    // lists of whole angles, of about so many sides
    const auto block = static_cast<Index>(block_of(sides.size()));
    std::vector<Index> first{0};
    for (Index rank = 0; rank < ranks; ++rank)
        if (start[rank + 1] - start[first.back()] >= block || rank + 1 == ranks) first.push_back(rank + 1);
    std::vector<Parts> result(first.size() - 1);
    const auto glue_all = [&]<class At>(std::size_t k, LevelGluer<At>&& gluer) {
        const auto begin = static_cast<std::size_t>(start[first[k]]), end = static_cast<std::size_t>(start[first[k + 1]]);
        std::vector<SideAtAngle> rows;
        rows.reserve(end - begin);
        for (const Index side : std::span(sides).subspan(begin, end - begin))
            rows.emplace_back(b.patches, b.trapezoids, side / 2, side % 2 == 0);
        for (Index rank = first[k]; rank < first[k + 1]; ++rank) {
            heed_stop();
            if (start[rank] < start[rank + 1])
                gluer.glue(rank, std::span(rows).subspan(start[rank] - begin, start[rank + 1] - start[rank]));
        }
        gluer.parts.finish();
        result[k] = std::move(gluer.parts);
    };
    for_each_in_parallel(threads, result.size(), [&](std::size_t k) {
        if (b.scene->near().is_round) glue_all(k, LevelGluer<RoundJunction>(b, whole, around));
        else glue_all(k, LevelGluer<Junction>(b, whole, around));
    });
    return result;
}

}  // namespace cfree

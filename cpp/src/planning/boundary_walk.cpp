// Convert a way over faces to poses; theory, "Paths".
#include "cfree/planning/boundary_walk.hpp"

#include <algorithm>
#include <string>

#include "cfree/support/lookout.hpp"

namespace cfree {

namespace {

constexpr int slid = 48;             // halvings after which slides along a trapezoid's curves are also tried
constexpr int steps_as_known = 8;    // steps towards a critical angle before it is refined

// The middle of a sheet at an orientation, and the pose beside it.
struct Station {
    Ratio tau, t;
    RationalPose on, off;
};

// A simple tau between one and an end, nearer to the end.
Ratio nearer(const Ratio& tau, const Ratio& end, int halvings) {
    const Ratio from = end + (tau - end) / Ratio{Int(1) << static_cast<unsigned>(halvings - 1)};
    return simple_middle(std::min(from, end), std::max(from, end));
}

void append(Poses& way, const Poses& more, std::size_t from) {
    way.insert(way.end(), more.begin() + static_cast<std::ptrdiff_t>(from), more.end());
}

[[noreturn]] void no_way(Index face, Index other) {
    throw std::logic_error("no way from trapezoid " + std::to_string(face) + " to " + std::to_string(other));
}

}  // namespace

// One walk.
class BoundaryWalker::Run {
public:
    explicit Run(const BoundaryWalker& on)
        : walker(on), motions(on.motions()), landings(*on.space, on.extent, motions) {}

    Poses from(const End& start, const End& goal, Index cell) const {
        const auto first = landings.of(start.pose, cell), last = landings.of(goal.pose, cell);
        const auto links = walker.links(landings, cell);
        std::vector<const Landing*> ends;
        for (const Link& link : *links) ends.insert(ends.end(), {&link.first, &link.second});
        std::vector<Mark> starts, goals, marks;
        for (const Landing& x : first) starts.push_back(x.mark());
        for (const Landing& x : last) goals.push_back(x.mark());
        for (const Landing* x : ends) marks.push_back(x->mark());
        const auto steps = walker.graph.shortest(start.place, starts, goal.place, goals, marks);
        if (steps.empty()) throw std::logic_error("no way in cell " + std::to_string(cell));
        const auto on = [](const std::vector<Landing>& all, Index face) {
            return &*std::find_if(all.begin(), all.end(), [&](const Landing& x) { return x.face == face; });
        };
        Poses way{start.pose};
        follow(steps, ends, on(first, steps.front().face), on(last, steps.back().face), way);
        way.push_back(goal.pose);
        way.erase(std::unique(way.begin(), way.end()), way.end());
        return way;
    }

    std::optional<Poses> turn(const EndOfFace& from, const EndOfFace& to, int attempts) const {
        Sheet f = landings.sheet(from.face), g = landings.sheet(to.face);
        const auto found = across(f, from.is_last, g, to.is_last, simple_middle(f.low, f.high), attempts);
        if (!found) return {};
        Poses way{found->first.on, found->first.off};
        append(way, found->way, 0);
        way.push_back(found->last.on);
        return way;
    }

private:
    Station station(const Sheet& f, const Ratio& tau) const {
        const Ratio t = f.middle(tau);
        return {tau, t, f.pose(t, tau), landings.off(f, t, tau)};
    }

    // Crossing from beside the middle of one sheet to the same on another, without the first pose.
    struct Crossing {
        Station first;
        Poses way;
        Station last;
    };
    // Cross over the last or the first angles of two sheets, from an orientation on the first.
    std::optional<Crossing> across(Sheet& f, bool f_last, Sheet& g, bool g_last, Ratio sigma, int attempts) const {
        Ratio tau = simple_middle(g.low, g.high);
        for (int k = 0; k < attempts; ++k) {
            heed_stop();
            if (k % steps_as_known == steps_as_known - 1) {
                const unsigned bits = trusted_bits + 4 * static_cast<unsigned>(k);
                f.refine(bits), g.refine(bits);
            }
            sigma = nearer(sigma, f_last ? f.high : f.low, 1 + k / steps_as_known);
            tau = nearer(tau, g_last ? g.high : g.low, 1 + k / steps_as_known);
            const auto beside = common_part(f, sigma, g, tau);
            if (!beside) continue;
            const auto& [t, s] = *beside;
            const RationalPose C = f.pose(t, sigma), D = g.pose(s, tau), turned = f.pose(t, D.half);
            const RationalPose p = landings.off(f, t, sigma), q = landings.off(g, s, tau);
            const auto over = motions.first_free({{p, q}, {p, C, turned, D, q}, {p, C, turned, q}, {p, C, D, q}});
            if (!over) continue;
            const Station begin = station(f, sigma), end = station(g, tau);
            const auto head = motions.first_free({{begin.off, p}, {begin.off, begin.on, C, p}});
            const auto tail = motions.first_free({{q, end.off}, {q, D, end.on, end.off}});
            if (!head || !tail) no_way(f.face, g.face);
            Crossing found{begin, {head->begin() + 1, head->end() - 1}, end};
            found.way.insert(found.way.end(), over->begin(), over->end() - 1);
            append(found.way, *tail, 0);
            return found;
        }
        return {};
    }

    // Go from beside the middle at one orientation to the same at another, without the first pose.
    void along(const Sheet& f, const Station& first, const Station& last, Poses& way) const {
        struct Part {
            Station end;
            int depth;
        };
        std::vector<Part> ahead{{last, 0}};
        for (Station at = first; !ahead.empty();) {
            heed_stop();
            const auto& [to, depth] = ahead.back();
            const Station& p = at;
            auto found = motions.first_free({{p.off, to.off}});
            if (!found) found = motions.first_free({{p.off, p.on, f.pose(p.t, to.tau), to.on, to.off}, {p.off, p.on, f.pose(to.t, p.tau), to.on, to.off}});
            if (!found && depth > slid) found = along_curve(f, p, to);
            if (found) {
                append(way, *found, 1);
                at = to;
                ahead.pop_back();
            } else if (depth == most_halvings) {
                throw std::logic_error("no way along trapezoid " + std::to_string(f.face));
            } else {
                const Station middle = station(f, simple_middle(std::min(p.tau, to.tau), std::max(p.tau, to.tau)));
                const int deeper = ++ahead.back().depth;
                ahead.push_back({middle, deeper});
            }
        }
    }

    // Go by a slide, always on the trapezoid.
    std::optional<Poses> along_curve(const Sheet& f, const Station& p, const Station& to) const {
        const auto [p_low, p_high] = f.limits(p.tau);
        const auto [to_low, to_high] = f.limits(to.tau);
        for (const std::size_t side : {0u, 1u}) {
            const RationalPose on = f.pose(side ? p_high : p_low, p.tau), last = f.pose(side ? to_high : to_low, to.tau);
            if (motions.along_curve(on, last, f, side)) return Poses{p.off, p.on, on, last, to.on, to.off};
        }
        return {};
    }

    // Go from beside the middle of one sheet to the same on the other, over their common curve, without the first pose.
    void over_curve(const Sheet& f, const Station& p, const Sheet& g, const Station& q, bool upper, Poses& way) const {
        const auto [low, high] = f.limits(p.tau);
        const RationalPose corner = f.pose(upper ? high : low, p.tau);
        const auto found = motions.first_free({{p.off, q.off}, {p.off, p.on, corner, q.on, q.off}});
        if (!found) no_way(f.face, g.face);
        append(way, *found, 1);
    }

    // Follow steps from one landing to another, the ways of both landings included.
    void follow(const std::vector<FaceGraph::Step>& steps, const std::vector<const Landing*>& ends, const Landing* first,
                const Landing* last, Poses& way) const {
        const auto base = static_cast<Index>(walker.cells->face.size());
        const Landing* entered = first;  // null: over a side, and now beside the middle
        std::optional<Station> at;
        for (std::size_t k = 0; k < steps.size(); ++k) {
            const auto [face, h] = steps[k];
            const bool is_end = k + 1 == steps.size();
            const Landing* left = is_end ? last : h >= base ? ends[h - base] : nullptr;
            if (entered) append(way, entered->way, 0);
            if (face == far_away) {
                way.push_back({entered->pose().x, entered->pose().y, left->pose().half});
            } else {
                Sheet f = landings.sheet(face);
                if (entered) {
                    at = station(f, entered->pose().half.tau());
                    way.insert(way.end(), {at->on, at->off});
                }
                if (left) {
                    const Station end = station(f, left->pose().half.tau());
                    along(f, *at, end, way);
                    way.push_back(end.on);
                } else {
                    at = over(f, *at, h, steps[k + 1].face, way);
                }
            }
            if (left) way.insert(way.end(), left->way.rbegin(), left->way.rend());
            entered = h >= base && !is_end ? ends[(h - base) ^ 1] : nullptr;
        }
    }

    // Go along a sheet and over a side of it to the next.
    Station over(Sheet& f, const Station& from, Index h, Index next, Poses& way) const {
        Sheet g = landings.sheet(next);
        const auto side = static_cast<Side>(walker.cells->side[h]);
        if (side == Side::lower || side == Side::upper) {
            const Ratio tau = common_tau({&f, &g});
            const Station p = station(f, tau), q = station(g, tau);
            along(f, from, p, way);
            over_curve(f, p, g, q, side == Side::upper, way);
            return q;
        }
        const auto is_last = [&](Index k) { return static_cast<Side>(walker.cells->side[k]) == Side::last; };
        const auto found = across(f, is_last(h), g, is_last(walker.cells->twin[h]), from.tau, most_halvings);
        if (!found) no_way(f.face, g.face);
        along(f, from, found->first, way);
        append(way, found->way, 0);
        return found->last;
    }

    const BoundaryWalker& walker;
    const FreeMotions motions;
    const Landings landings;
};

BoundaryWalker::BoundaryWalker(std::shared_ptr<const FreeSpace> of, std::shared_ptr<const CellComplex> surfaces,
                               std::shared_ptr<const MotionChecker> by, double scale,
                               std::shared_ptr<FoundSlides> found)
    : space(std::move(of)), cells(std::move(surfaces)), checker(std::move(by)), slides(std::move(found)),
      angle_scale(scale), graph(cells, angle_scale),
      extent(*cells, ratio_of(angle_scale)) {}

std::shared_ptr<const std::vector<Link>> BoundaryWalker::links(const Landings& landings, Index cell) const {
    {
        const std::lock_guard guard(lock);
        if (const auto it = known.find(cell); it != known.end()) return it->second;
    }
    auto found = std::make_shared<const std::vector<Link>>(landings.links(cell));  // threads may compute it twice, alike
    const std::lock_guard guard(lock);
    return known.emplace(cell, std::move(found)).first->second;
}

Poses BoundaryWalker::walk(const End& start, const End& goal, Index cell) const {
    if (space->surfaces.component.empty())
        return {start.pose, {start.pose.x, start.pose.y, goal.pose.half}, goal.pose};
    return Run(*this).from(start, goal, cell);
}

std::optional<Poses> BoundaryWalker::turn(const EndOfFace& from, const EndOfFace& to, int attempts) const {
    return Run(*this).turn(from, to, attempts);
}

}  // namespace cfree

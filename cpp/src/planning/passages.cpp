// Breadth first over places and what holds them; theory, "Paths", "Exact fits".
#include "cfree/planning/passages.hpp"

#include "cfree/planning/irrational_places.hpp"
#include "cfree/support/lookout.hpp"

namespace cfree {

Passages::Passages(std::shared_ptr<const BoundaryWalker> walker, std::shared_ptr<const CellComplex> slits)
    : places(std::move(walker), std::move(slits)) {}

Index Passages::Spots::add(const RationalPose& pose, std::vector<Holder> of) {
    const auto [it, is_new] = number.emplace(pose.key(), static_cast<Index>(poses.size()));
    if (is_new) poses.push_back(pose), holders.push_back(std::move(of)), joined.emplace_back();
    return it->second;
}

const Passages::Spots& Passages::spots(bool irrational) {
    if (!rational) {
        Spots found;
        std::set<RationalPose::Key> seen;
        for (const RationalPose& pose : places.candidates()) {
            heed_stop();
            if (!seen.insert(pose.key()).second) continue;
            auto holders = places.holders(pose);
            if (holders.size() > 1) found.add(pose, std::move(holders));
        }
        rational = std::move(found);
    }
    if (irrational && !every) {
        Spots found = *rational;
        for (const Poses& way : irrational_ways(places))
            for (std::size_t k = 1; k < way.size(); ++k) {
                const Index a = found.add(way[k - 1], places.holders(way[k - 1])), b = found.add(way[k], places.holders(way[k]));
                found.joined[a].push_back(b), found.joined[b].push_back(a);
            }
        every = std::move(found);
    }
    return irrational ? *every : *rational;
}

std::optional<Poses> Passages::path(const RationalPose& start, const RationalPose& goal, bool irrational) {
    const std::lock_guard guard(lock);
    const Spots& known = spots(irrational);
    Spots all;
    const Index first = all.add(start, places.holders(start)), last = all.add(goal, places.holders(goal));
    for (std::size_t k = 0; k < known.poses.size(); ++k) all.add(known.poses[k], known.holders[k]);
    for (std::size_t k = 0; k < known.poses.size(); ++k)
        for (const Index other : known.joined[k])
            all.joined[all.number.at(known.poses[k].key())].push_back(all.number.at(known.poses[other].key()));
    for (;;) {
        heed_stop();
        const auto steps = fewest(all, first, last);
        if (!steps) return {};
        if (auto way = along(all, first, *steps)) return way;
    }
}

// Search breadth first over poses, and their holders, numbered after them.
std::optional<std::vector<Passages::Step>> Passages::fewest(const Spots& all, Index start, Index goal) const {
    const auto count = static_cast<Index>(all.poses.size());
    std::map<Holder, Index> number;
    std::vector<Holder> holders;
    std::vector<std::vector<Index>> held;
    for (Index k = 0; k < count; ++k)
        for (const Holder& holder : all.holders[k]) {
            const auto [it, is_new] = number.emplace(holder, static_cast<Index>(held.size()));
            if (is_new) holders.push_back(holder), held.emplace_back();
            held[it->second].push_back(k);
        }
    std::vector<Index> came(all.poses.size() + held.size(), -1);
    std::vector<Index> ahead{start};
    came[start] = start;
    const auto is_broken = [&](Index from, const Holder& holder, Index to) {
        return !broken.empty() && broken.contains({all.poses[from].key(), holder, all.poses[to].key()});
    };
    for (std::size_t k = 0; k < ahead.size() && came[goal] < 0; ++k) {
        const Index node = ahead[k];
        const auto reach = [&](Index next) {
            if (came[next] >= 0) return;
            came[next] = node;
            ahead.push_back(next);
        };
        if (node >= count) {
            for (const Index other : held[node - count])
                if (!is_broken(came[node], holders[node - count], other)) reach(other);
        } else {
            for (const Holder& holder : all.holders[node]) reach(count + number.at(holder));
            for (const Index other : all.joined[node]) reach(other);
        }
    }
    if (came[goal] < 0) return {};
    std::vector<Step> steps;
    for (Index at = goal; at != start;) {
        const Index before = came[at];
        const bool is_held = before >= count;
        steps.push_back({is_held ? std::optional(holders[before - count]) : std::nullopt, at});
        at = is_held ? came[before] : before;
    }
    return std::vector<Step>(steps.rbegin(), steps.rend());
}

std::optional<Poses> Passages::along(const Spots& all, Index start, const std::vector<Step>& steps) {
    Poses way{all.poses[start]};
    for (const Step& step : steps) {
        const RationalPose from = way.back(), to = all.poses[step.to];
        if (!step.by) {
            way.push_back(to);
            continue;
        }
        const auto found = places.way(from, to, *step.by);
        if (!found) {
            broken.insert({from.key(), *step.by, to.key()}), broken.insert({to.key(), *step.by, from.key()});
            return {};
        }
        way.insert(way.end(), found->begin() + 1, found->end());
    }
    return way;
}

}  // namespace cfree

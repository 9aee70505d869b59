// Index of trapezoids by orientation: for each chart, [-1, 1] in equal parts, and lists of the trapezoids that meet a part.
#pragma once
#include <algorithm>
#include <numeric>
#include <span>
#include <vector>

#include "cfree/exact/number.hpp"

namespace cfree {

class TauIndex {
public:
    // The number of parts makes the lists, in all, about 1 + `copies` times as long as the list of trapezoids.
    TauIndex(std::span<const std::uint8_t> chart, std::span<const double> from, std::span<const double> to, double copies) {
        const auto n = static_cast<Index>(chart.size());
        double width = 0;
        for (Index k = 0; k < n; ++k) width += to[k] - from[k];
        parts = static_cast<Index>(std::clamp(2 * copies * n / std::max(width, 0x1p-900), 1.0, std::max(1.0, 0.125 * n)));
        start.assign(static_cast<std::size_t>(2 * parts) + 1, 0);
        const auto each = [&](auto&& visit) {
            for (Index k = n; k-- > 0;)
                for (Index q = part_of(chart[k], from[k]); q <= part_of(chart[k], to[k]); ++q) visit(q, k);
        };
        each([&](Index q, Index) { ++start[q]; });
        std::partial_sum(start.begin(), start.end(), start.begin());
        member.resize(start.back());
        each([&](Index q, Index k) { member[--start[q]] = k; });  // backwards, so that members are in order
    }
    Index part_of(int chart, double tau) const {
        return chart * parts + std::clamp<Index>(static_cast<Index>(0.5 * (tau + 1) * parts), 0, parts - 1);
    }
    std::span<const Index> at(Index part) const { return {member.data() + begin(part), member.data() + begin(part + 1)}; }
    Index begin(Index part) const { return start[part]; }  // start of its list in `member`
    Index count() const { return 2 * parts; }
    // Ends of a part in its chart, a little outside.
    double from(Index part) const { return 2.0 * (part % parts) / parts - 1 - 0x1p-40; }
    double to(Index part) const { return 2.0 * (part % parts + 1) / parts - 1 + 0x1p-40; }

private:
    Index parts = 1;
    std::vector<Index> start, member;
};

}  // namespace cfree

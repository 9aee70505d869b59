// Patches of a scene cut by all other pairs: trapezoids of constant depth.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "cfree/forbidden/boundary.hpp"
#include "cfree/scene/features.hpp"

namespace cfree {

// Lists of numbers, each list stored once.
struct NumberSets {
    std::vector<Index> start{0}, member;
    Index size() const { return static_cast<Index>(start.size()) - 1; }
    std::span<const Index> operator[](Index k) const { return {member.data() + start[k], member.data() + start[k + 1]}; }
};

// Trapezoids with three sets of pairs each: those that overlap just off its free side, those that overlap just off its
// forbidden side, and those whose boundary contains it.
struct Sheets {
    SharedBoundary boundary;
    NumberSets sets;
    std::vector<Index> outer, inner, owners;
    Index far_away = 0;  // the set of the unbounded cell
    // Pair k is polygon k / columns of the robot, or its reference point after them, and obstacle k % columns: the user's, then
    // the complement of the workspace, then the complement of the bounds.
    Index columns = 0;
};

// Throws std::length_error if there are more trapezoids than `most`.
Sheets compute_sheets(const SceneFeatures& features, int threads, std::int64_t most);

}  // namespace cfree

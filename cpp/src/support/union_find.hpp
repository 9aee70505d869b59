// Disjoint sets of numbers.
#pragma once
#include <numeric>
#include <vector>

#include "cfree/support/index.hpp"

namespace cfree {

class UnionFind {
public:
    explicit UnionFind(std::size_t count) : parent(count) { std::iota(parent.begin(), parent.end(), 0); }
    Index find(Index x) {
        while (parent[x] != x) x = parent[x] = parent[parent[x]];
        return x;
    }
    // Unite two classes; the least member represents its class.
    void unite(Index x, Index y) {
        x = find(x), y = find(y);
        (x < y ? parent[y] : parent[x]) = std::min(x, y);
    }
    // Number classes in the order of their least members; return their count.
    Index number(std::vector<Index>& of) {
        Index count = 0;
        of.resize(parent.size());
        for (std::size_t k = 0; k < parent.size(); ++k) {
            const Index root = find(static_cast<Index>(k));
            of[k] = root == static_cast<Index>(k) ? count++ : of[root];
        }
        return count;
    }

private:
    std::vector<Index> parent;
};

}  // namespace cfree

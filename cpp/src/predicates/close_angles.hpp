// What the predicates of one surface keep of angles that doubles do not distinguish. Answers are functions of the question alone:
// nothing kept changes them, or a byte of the boundary.
#pragma once
#include <unordered_map>
#include <vector>

#include "cfree/predicates/predicates.hpp"
#include "cfree/support/bit_cast.hpp"

namespace cfree {

// True for one angle of one name, of those that are alone in their intervals.
inline bool same_angle(const Event& x, const Event& y) {
    return x.lo == y.lo && x.hi == y.hi && x.first == y.first && x.second == y.second && x.is_touch == y.is_touch;
}
inline std::size_t spread(std::uint64_t h) { return static_cast<std::size_t>(h * 0x94d049bb133111ebu >> 24); }
inline std::uint64_t mixed(const Feature& f) {
    return (static_cast<std::uint64_t>(f.kind) << 61) ^ (static_cast<std::uint64_t>(f.branch & 3) << 59) ^
           (static_cast<std::uint64_t>(f.robot) << 31) ^ static_cast<std::uint64_t>(f.obstacle);
}
inline std::uint64_t mixed(const Event& x) {
    return ((mixed(x.first) * 0x9e3779b97f4a7c15u ^ mixed(x.second)) * 0xbf58476d1ce4e5b9u) ^ bit_cast<std::uint64_t>(x.lo);
}

struct Predicates::CloseAngles {
    // Orders of pairs: a table in which what comes later takes the place; it grows while it is missed.
    const int* order(const Event& x, const Event& y) const {
        if (pairs.empty()) return nullptr;
        const Pair& p = pairs[place(x, y)];
        return p.is_known && same_angle(p.x, x) && same_angle(p.y, y) ? &p.order : nullptr;
    }
    void keep(const Event& x, const Event& y, int order) {
        constexpr std::size_t least = 64, most = 8192;
        if (pairs.empty() || (++misses > pairs.size() && pairs.size() < most))
            pairs.assign(pairs.empty() ? least : 4 * pairs.size(), {}), misses = 0;
        pairs[place(x, y)] = {x, y, order, true};
    }

    // The exact root of an angle, as narrow as any question has made it. References are valid until `trim`.
    template <class Make>
    RealRoot& root(const Event& x, Make&& make) {
        auto found = roots.find(x);
        if (found == roots.end()) found = roots.emplace(x, make()).first;
        return found->second;
    }
    void trim() {
        constexpr std::size_t most = 2048;
        if (roots.size() > most) roots.clear();
    }

private:
    struct Pair {
        Event x, y;
        int order = 0;
        bool is_known = false;
    };
    std::size_t place(const Event& x, const Event& y) const { return spread(mixed(x) * 3 + mixed(y)) & (pairs.size() - 1); }
    std::vector<Pair> pairs;
    std::size_t misses = 0;
    struct Hash {
        std::size_t operator()(const Event& x) const { return spread(mixed(x)); }
    };
    struct Same {
        bool operator()(const Event& x, const Event& y) const { return same_angle(x, y); }
    };
    std::unordered_map<Event, RealRoot, Hash, Same> roots;
};

}  // namespace cfree

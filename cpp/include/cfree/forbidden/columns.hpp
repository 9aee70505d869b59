// Boundary as flat arrays: patches, trapezoids, isolated parts; features are packed into one number.
#pragma once
#include <array>
#include <vector>

#include "cfree/forbidden/trim.hpp"

namespace cfree {

struct Patches {
    std::vector<std::uint8_t> kind;  // and 16 times the quadrant of a circle
    std::vector<Index> robot, obstacle;
    std::size_t size() const { return kind.size(); }
    Feature contact(Index k) const { return {static_cast<Kind>(kind[k] & 15), robot[k], obstacle[k], kind[k] >> 4}; }
};

// Branches and ends of quadrants take two bits: 3 is branch -1.
inline std::uint64_t packed(const Feature& f) {
    return static_cast<std::uint64_t>(f.kind) << 61 | static_cast<std::uint64_t>(f.branch & 3) << 59 |
           static_cast<std::uint64_t>(f.robot) << 31 | static_cast<std::uint64_t>(f.obstacle);
}
inline Feature unpacked(std::uint64_t code) {
    const auto kind = static_cast<Kind>(code >> 61);
    const int bits = static_cast<int>(code >> 59 & 3);
    return {kind, static_cast<Index>(code >> 31 & 0xfffffff), static_cast<Index>(code & 0x7fffffff),
            bits == 3 && kind != Kind::seam ? -1 : bits};
}

// Structure of arrays; features packed.
struct Trapezoids {
    std::vector<Index> patch;
    std::vector<std::uint8_t> chart;
    std::vector<std::uint64_t> lower, upper;
    std::vector<std::uint64_t> from_first, from_second, to_first, to_second;
    std::vector<double> from_lo, from_hi, to_lo, to_hi;
    std::vector<std::uint8_t> from_place, to_place;
    std::size_t size() const { return patch.size(); }
    double tau_from(Index k) const { return 0.5 * (from_lo[k] + from_hi[k]); }
    double tau_to(Index k) const { return 0.5 * (to_lo[k] + to_hi[k]); }
    std::array<std::vector<std::uint64_t>*, 6> features() {
        return {&lower, &upper, &from_first, &from_second, &to_first, &to_second};
    }
    void reserve(std::size_t count);
    void push_back(const Trapezoid& x);
    void push_row(const Trapezoids& of, Index k);
};

// Give every point and every line one name, in all trapezoids.
void use_names(const Scene& scene, const std::array<std::vector<std::uint64_t>*, 6>& columns);
std::uint64_t named(const Representatives& names, std::uint64_t feature);

// Free parts without width, {(t, theta): lower <= t <= upper, from <= theta <= to} of a patch: from = to (a segment, or a
// point) or lower = upper (a curve). A curve or an angle may be named on the surface of another patch. The two ends of a
// part are at t = first_t on the surface of lower_patch and t = last_t on that of upper_patch.
struct IsolatedParts {
    Trapezoids parts;
    std::vector<Index> lower_patch, upper_patch, from_patch, to_patch;
    std::vector<double> first_t, last_t;
};

}  // namespace cfree

// The trimmed boundary of the forbidden space: all patches, divided among threads.
#pragma once
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "cfree/trim.hpp"

namespace cfree {

struct Patches {
    std::vector<std::uint8_t> kind;
    std::vector<Index> robot, obstacle;
};

inline std::uint64_t packed(const Feature& f) {
    return static_cast<std::uint64_t>(f.kind) << 61 | static_cast<std::uint64_t>(f.robot) << 31 |
           static_cast<std::uint64_t>(f.obstacle);
}
inline Feature unpacked(std::uint64_t code) {
    return {static_cast<Kind>(code >> 61), static_cast<Index>(code >> 31 & 0x3fffffff),
            static_cast<Index>(code & 0x7fffffff)};
}

// Structure of arrays; features packed.
struct Trapezoids {
    std::vector<Index> patch;
    std::vector<std::uint8_t> chart;
    std::vector<std::uint64_t> lower, upper;
    std::vector<std::uint64_t> from_first, from_second, to_first, to_second;
    std::vector<double> from_lo, from_hi, to_lo, to_hi;
    std::vector<std::uint8_t> from_place, to_place;
    void reserve(std::size_t count);
    void push_back(const Trapezoid& x);
};

// What is free without any width, {(t, theta): lower <= t <= upper, from <= theta <= to} of a patch: from = to (a segment, or a
// point) or lower = upper (a curve). A curve or an angle may be named on the surface of another patch. Its two ends are at
// t = first_t on the surface of lower_patch and t = last_t on that of upper_patch.
struct IsolatedParts {
    Trapezoids parts;
    std::vector<Index> lower_patch, upper_patch, from_patch, to_patch;
    std::vector<double> first_t, last_t;
};

struct Tally {
    std::int64_t pairs = 0;         // pairs of a patch and a pillar near it
    std::int64_t live_patches = 0;
    Counters decisions;
    double setup_seconds = 0, trim_seconds = 0, collect_seconds = 0, isolated_seconds = 0;
};

// All pairs of a convex vertex and an edge, patches of the boundary before trimming.
Patches list_patches(const Scene& scene);

// A computation on threads of its own, to be watched and stopped from outside.
class Job {
public:
    // regularized: without slits, surfaces that coincide with opposite sides.
    Job(std::shared_ptr<const Scene> scene, int threads, bool regularized);
    ~Job();
    Job(const Job&) = delete;
    Job& operator=(const Job&) = delete;

    bool wait(double seconds);  // whether it has ended; rethrows what a thread threw
    double progress() const;    // patches done, of all
    void cancel() { stop = true; }
    void finish_early() { early = true, stop = true; }  // with the patches done so far
    // After wait() returned true.
    Patches patches;
    std::vector<std::uint8_t> trimmed;  // of each patch, whether it has been
    Trapezoids trapezoids;
    IsolatedParts isolated;
    Tally tally;

private:
    void run(int threads);
    void work();

    std::vector<std::pair<Index, Index>> opposite(const Feature& contact) const;

    std::shared_ptr<const Scene> scene;
    bool regularized;
    class Neighbours;
    std::unique_ptr<Neighbours> neighbours;
    std::vector<Index> first_patch;                     // of each obstacle ring vertex and the edge that starts there
    std::vector<std::vector<Trapezoid>> found, found_thin;  // by obstacle ring vertex
    std::atomic<Index> next{0};
    std::atomic<std::int64_t> done{0};
    std::atomic<bool> stop{false}, early{false};
    mutable std::mutex mutex;
    std::condition_variable ended_signal;
    bool ended = false;
    std::exception_ptr error;
    std::thread runner;
};

}  // namespace cfree

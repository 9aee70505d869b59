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

#include "cfree/forbidden/columns.hpp"

namespace cfree {

struct Tally {
    std::int64_t pairs = 0;         // pairs of a patch and a pillar near it
    std::int64_t live_patches = 0;
    Counters decisions;
    double trim_seconds = 0, collect_seconds = 0, isolated_seconds = 0;
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
    void cancel() { cancelled = true, stop = true; }
    void finish_early() { stop = true; }  // with the patches done so far; if these are all, as if it had not been asked for
    // After wait() returned true.
    Patches patches;
    std::vector<std::uint8_t> trimmed;  // of each patch, whether it has been
    Trapezoids trapezoids;
    IsolatedParts isolated;
    Tally tally;

private:
    void run(int threads);
    void trim_patches();
    void trim_patch(Index id, const std::vector<Index>& near, Tally& mine);

    std::shared_ptr<const Scene> scene;
    struct Plan;
    std::unique_ptr<Plan> plan;
    std::vector<Index> first_patch;                         // of each obstacle ring vertex and the edge that starts there
    std::vector<std::vector<Trapezoid>> found, found_thin;  // by obstacle ring vertex
    std::atomic<Index> next{0};
    std::atomic<std::int64_t> done{0};
    std::atomic<bool> stop{false}, cancelled{false};  // trimming; all of it
    std::mutex mutex;
    std::condition_variable ended_signal;
    bool ended = false;
    std::exception_ptr error;
    std::thread runner;
};

}  // namespace cfree

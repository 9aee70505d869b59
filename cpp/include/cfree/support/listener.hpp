// Listener to long work: it receives the phase and the share done, and may end the work.
#pragma once
#include <cstdint>
#include <functional>
#include <limits>

namespace cfree {

struct Listener {
    std::function<void(const char* phase)> begin = {};
    std::function<void()> end = {};                    // ends the phase that has begun last
    std::function<bool(double share)> go_on = {};      // called ten times a second while the share done is known
    std::function<void(std::int64_t patches)> spend = {};  // receives the number of trimmed contact patches; may end the work
    int threads = 1;
    double max_seconds = std::numeric_limits<double>::infinity();  // limits the free space, and surfaces around poses
};

}  // namespace cfree

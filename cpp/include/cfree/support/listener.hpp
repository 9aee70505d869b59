// Who waits for long work: is told which part of it has begun and how much of that is done, and may end it.
#pragma once
#include <cstdint>
#include <functional>
#include <limits>

namespace cfree {

struct Listener {
    std::function<void(const char* phase)> begin = {};
    std::function<void()> end = {};                    // of the phase that has begun last
    std::function<bool(double share)> go_on = {};      // asked ten times a second where the share that is done is known
    std::function<void(std::int64_t patches)> spend = {};  // told how many contact patches are trimmed; may end the work
    int threads = 1;
    double max_seconds = std::numeric_limits<double>::infinity();  // for the free space, and for surfaces around poses
};

}  // namespace cfree

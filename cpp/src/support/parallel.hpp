// Work divided among threads.
#pragma once
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "cfree/support/stop.hpp"

namespace cfree {

// Every thread runs `work`, which takes items until none is left or `stop` is set. The first exception stops all, and is
// thrown again here.
template <class Work>
void in_parallel(int threads, std::atomic<bool>& stop, Work&& work) {
    std::mutex mutex;
    std::exception_ptr error;
    const auto* flag = stop_flag;
    const auto guarded = [&] {
        stop_flag = flag;
        try {
            work();
        } catch (...) {
            stop = true;
            const std::lock_guard lock(mutex);
            if (!error) error = std::current_exception();
        }
    };
    std::vector<std::thread> pool;
    for (int t = 1; t < threads; ++t) pool.emplace_back(guarded);
    guarded();
    for (std::thread& t : pool) t.join();
    if (error) std::rethrow_exception(error);
}

}  // namespace cfree

// Divide work among threads; with one thread it runs in the caller, without new ones.
#pragma once
#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "cfree/support/lookout.hpp"

namespace cfree {

// Every thread runs `work`, which takes items until none is left or `stop` is set. The first exception stops all, and is
// thrown again here.
template <class Work>
void in_parallel(int threads, std::atomic<bool>& stop, Work&& work) {
    if (threads <= 1) return work();
    std::mutex mutex;
    std::condition_variable ended;
    int running = threads - 1;
    std::exception_ptr error;
    const auto guarded = [&] {
        try {
            work();
        } catch (...) {
            stop = true;
            const std::lock_guard lock(mutex);
            if (!error) error = std::current_exception();
        }
    };
    const auto* flag = stop_flag;
    std::vector<std::thread> pool;
    for (int t = 1; t < threads; ++t)
        pool.emplace_back([&] {
            stop_flag = flag;
            guarded();
            const std::lock_guard lock(mutex);
            if (--running == 0) ended.notify_one();
        });
    guarded();
    for (std::unique_lock lock(mutex); running > 0;) {
        ended.wait_for(lock, Lookout::pause);
        lock.unlock();
        if (lookout) lookout->look_if_due();
        lock.lock();
    }
    for (std::thread& t : pool) t.join();
    if (error) std::rethrow_exception(error);
}

// Items per block of work, out of `count`: enough blocks for all threads, none too small to be handed out.
inline std::size_t block_of(std::size_t count) { return std::clamp<std::size_t>(count / 64, 64, 4096); }

// work(0) to work(count - 1), in no order.
template <class Work>
void for_each_in_parallel(int threads, std::size_t count, Work&& work) {
    std::atomic<bool> stop = false;
    std::atomic<std::size_t> next = 0;
    in_parallel(static_cast<int>(std::min(static_cast<std::size_t>(threads), count)), stop, [&] {
        for (std::size_t k; (k = next++) < count && !stop;) work(k);
    });
}

// Run short work(0) to work(count - 1), block by block.
template <class Work>
void for_each_block_in_parallel(int threads, std::size_t count, Work&& work) {
    const std::size_t block = block_of(count);
    for_each_in_parallel(threads, (count + block - 1) / block, [&](std::size_t b) {
        heed_stop();
        for (std::size_t k = b * block; k < std::min(count, (b + 1) * block); ++k) work(k);
    });
}

// Run two tasks, on two threads if there are.
template <class First, class Second>
void in_two(int threads, First&& first, Second&& second) {
    for_each_in_parallel(threads, 2, [&](std::size_t k) { k == 0 ? first() : second(); });
}

}  // namespace cfree

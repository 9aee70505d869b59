// A wish to stop, heard wherever a loop may be long: every thread knows the flag of the call that it works for.
#pragma once
#include <atomic>
#include <exception>

namespace cfree {

struct Stopped : std::exception {
    const char* what() const noexcept override { return "stopped"; }
};

inline thread_local const std::atomic<bool>* stop_flag = nullptr;

inline void heed_stop() {
    if (stop_flag && stop_flag->load(std::memory_order_relaxed)) throw Stopped();
}

}  // namespace cfree

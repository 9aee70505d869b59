// Stop requests, checked in every long loop: each thread has the flag of the call that it works for.
//
// The thread that made a call may also have a lookout, which runs now and then and may raise the flag. So a call is watched
// without an extra thread.
#pragma once
#include <atomic>
#include <chrono>
#include <exception>
#include <functional>

namespace cfree {

struct Stopped : std::exception {
    const char* what() const noexcept override { return "stopped"; }
};

class Lookout;
inline thread_local const std::atomic<bool>* stop_flag = nullptr;
inline thread_local Lookout* lookout = nullptr;

// During its lifetime, this thread heeds the flag, and calls `look_around`, if given, ten times a second.
class Lookout {
public:
    static constexpr std::chrono::milliseconds pause{100};
    explicit Lookout(const std::atomic<bool>& flag, std::function<void()> look_around = {})
        : look(std::move(look_around)), outer_flag(stop_flag), outer(lookout) {
        stop_flag = &flag, lookout = look ? this : nullptr;
    }
    ~Lookout() { stop_flag = outer_flag, lookout = outer; }
    Lookout(const Lookout&) = delete;
    Lookout& operator=(const Lookout&) = delete;

    void glance() {
        if (++calls % 16 == 0) look_if_due();
    }
    void look_if_due() {
        const auto now = Clock::now();
        if (now < due) return;
        due = now + pause;
        look();
    }

private:
    using Clock = std::chrono::steady_clock;
    std::function<void()> look;
    Clock::time_point due = Clock::now() + pause;
    unsigned calls = 0;
    const std::atomic<bool>* outer_flag;
    Lookout* outer;
};

inline void heed_stop() {
    if (lookout) lookout->glance();
    if (stop_flag && stop_flag->load(std::memory_order_relaxed)) throw Stopped();
}

}  // namespace cfree

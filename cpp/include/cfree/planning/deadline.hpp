// Time limit of a query.
#pragma once
#include <chrono>
#include <stdexcept>

#include "cfree/support/listener.hpp"

namespace cfree {

struct TooLate : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// The time begins at construction.
class Deadline {
public:
    explicit Deadline(const Listener& listener) : seconds(listener.max_seconds) {}
    bool is_over() const { return std::chrono::duration<double>(Clock::now() - start).count() > seconds; }
    void heed() const;  // throws TooLate

private:
    using Clock = std::chrono::steady_clock;
    const double seconds;
    const Clock::time_point start = Clock::now();
};

}  // namespace cfree

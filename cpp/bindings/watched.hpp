// A long call without the lock; now and then it looks for Ctrl-C.
#pragma once
#include <nanobind/nanobind.h>

#include <optional>

#include "cfree/support/lookout.hpp"

// An error that Python raised while the core was at work, to be thrown when that has ended.
class Raised {
public:
    // Needs the lock. True if there is a signal to end the call for.
    bool is_signalled() {
        if (!error && PyErr_CheckSignals() != 0) error.emplace();
        return error.has_value();
    }
    void keep(nanobind::python_error&& what) { error.emplace(std::move(what)); }
    void rethrow() {
        if (error) throw nanobind::python_error(std::move(*error));
    }

private:
    std::optional<nanobind::python_error> error;
};

template <class Work>
auto watched(Work&& work) {
    std::atomic<bool> stop = false;
    Raised raised;
    const auto look = [&] {
        const nanobind::gil_scoped_acquire lock;
        if (raised.is_signalled()) stop = true;
    };
    const auto unlocked = [&] {
        const nanobind::gil_scoped_release release;
        const cfree::Lookout watching(stop, look);
        return work();
    };
    try {
        if constexpr (std::is_void_v<decltype(work())>) {
            unlocked();
            return raised.rethrow();  // the work ended before it heard of it
        } else {
            auto result = unlocked();
            raised.rethrow();
            return result;
        }
    } catch (const cfree::Stopped&) {
    }
    raised.rethrow();
    throw cfree::Stopped();
}

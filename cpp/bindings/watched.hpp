// A long call without the lock, on a thread of its own, while this one looks for Ctrl-C.
#pragma once
#include <nanobind/nanobind.h>

#include <chrono>
#include <future>

#include "cfree/support/stop.hpp"

template <class Work>
auto watched(Work&& work) {
    using namespace std::chrono_literals;
    std::atomic<bool> stop = false;
    auto result = std::async(std::launch::async, [&] {
        cfree::stop_flag = &stop;
        return work();
    });
    const auto wait = [&] {
        const nanobind::gil_scoped_release release;
        return result.wait_for(50ms) == std::future_status::ready;
    };
    while (!wait()) {
        if (PyErr_CheckSignals() == 0) continue;
        stop = true;
        const nanobind::python_error interrupted;
        while (!wait()) {}
        throw interrupted;
    }
    return result.get();
}

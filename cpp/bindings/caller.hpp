// A long call without the lock, which tells a Python object of its phases.
#pragma once
#include "cfree/polygons/points.hpp"
#include "cfree/support/listener.hpp"
#include "watched.hpp"

// The object has begin(name), end(), share(of the phase), spend(patches) and look(), of which the last two may end the call
// by raising; `threads`, `max_seconds`, a number or None, and `is_limited`: whether to spend. One of these for each call.
class Caller {
public:
    explicit Caller(const nanobind::object& python) : who(python) {
        listener.begin = [this](const char* phase) { tell([&] { who.attr("begin")(phase); }); };
        listener.end = [this] { tell([&] { who.attr("end")(); }); };
        listener.go_on = [this](double share) {
            look();
            tell([&] { who.attr("share")(share); });
            return !stop;
        };
        if (nanobind::cast<bool>(who.attr("is_limited")))
            listener.spend = [this](std::int64_t patches) {
                tell([&] { who.attr("spend")(patches); });
                if (stop) throw cfree::Stopped();
            };
        listener.threads = nanobind::cast<int>(who.attr("threads"));
        const nanobind::object seconds = who.attr("max_seconds");
        if (!seconds.is_none()) listener.max_seconds = nanobind::cast<double>(seconds);
    }

    cfree::Listener listener;

    template <class Work>
    auto run(Work&& work) {
        std::optional<decltype(work())> result;
        try {
            const nanobind::gil_scoped_release release;
            const cfree::Lookout watching(stop, [&] { look(); });
            result.emplace(work());
        } catch (const cfree::Stopped&) {
        } catch (const std::logic_error& error) {
            throw cfree::BrokenInvariant(error.what());
        }
        raised.rethrow();
        if (!result) throw cfree::Stopped();
        return std::move(*result);
    }

private:
    template <class Say>
    void tell(Say&& say) {
        const nanobind::gil_scoped_acquire lock;
        try {
            if (!stop) say();
        } catch (nanobind::python_error& error) {
            raised.keep(std::move(error)), stop = true;
        }
    }
    void look() {
        tell([&] {
            if (raised.is_signalled()) stop = true;
            else who.attr("look")();
        });
    }

    const nanobind::object who;
    Raised raised;
    std::atomic<bool> stop = false;
};

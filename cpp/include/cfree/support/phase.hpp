// A named phase of long work: it begins when it is made, and ends with its scope; the listener is told both.
#pragma once
#include "cfree/support/listener.hpp"

namespace cfree {

class Phase {
public:
    Phase(const Listener& to, const char* name) : listener(to) {
        if (listener.begin) listener.begin(name);
    }
    ~Phase() {
        if (listener.end) listener.end();
    }
    Phase(const Phase&) = delete;
    Phase& operator=(const Phase&) = delete;

private:
    const Listener& listener;
};

}  // namespace cfree

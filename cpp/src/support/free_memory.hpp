// Memory that has been freed, given back: the GNU library keeps blocks below some size, gigabytes after a large scene.
#pragma once
#include <cstddef>
#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace cfree {

// After work on so many things; where they are few it does not pay.
inline void give_back_memory([[maybe_unused]] std::size_t things) {
#if defined(__GLIBC__)
    if (things > 100'000) malloc_trim(0);
#endif
}

}  // namespace cfree

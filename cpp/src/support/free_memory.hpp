// Return freed memory to the system: the GNU library keeps small blocks, gigabytes of them after a large scene.
#pragma once
#include <cstddef>
#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace cfree {

// Call after work on this many things; it does nothing for few of them.
inline void give_back_memory([[maybe_unused]] std::size_t things) {
#if defined(__GLIBC__)
    if (things > 100'000) malloc_trim(0);
#endif
}

}  // namespace cfree

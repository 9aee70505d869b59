// std::bit_cast, for standard libraries that do not have it yet.
#pragma once
#include <cstring>

namespace cfree {

template <class To, class From>
To bit_cast(const From& from) {
    static_assert(sizeof(To) == sizeof(From));
    To to;
    std::memcpy(&to, &from, sizeof to);
    return to;
}

}  // namespace cfree

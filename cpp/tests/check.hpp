// A test is a program; a failed check is printed and makes it exit with 1.
#pragma once
#include <cstdio>

inline int failures = 0;
#define CHECK(claim)                                                             \
    do {                                                                         \
        if (!(claim)) {                                                          \
            std::printf("%s:%d: not true: %s\n", __FILE__, __LINE__, #claim);    \
            ++failures;                                                          \
        }                                                                        \
    } while (false)

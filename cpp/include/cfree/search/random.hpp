// Random numbers, the same on every machine.
#pragma once
#include <cmath>
#include <cstdint>
#include <random>

namespace cfree {

class Random {
public:
    explicit Random(std::uint64_t seed) : engine(seed) {}
    double operator()() { return std::ldexp(static_cast<double>(engine() >> 11), -53); }  // in [0, 1)

private:
    std::mt19937_64 engine;
};

}  // namespace cfree

// Dyadic numbers, polynomials and their roots as tuples.
#pragma once
#include <nanobind/stl/pair.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "integers.hpp"

namespace nb = nanobind;

using DyadicPair = std::pair<nb::int_, unsigned>;
using Coefficients = std::vector<nb::int_>;
using RootTuple = std::tuple<Coefficients, DyadicPair, DyadicPair>;  // the only root of a polynomial in [lo, hi]

inline cfree::Dyadic dyadic(const DyadicPair& d) { return {integer(d.first), d.second}; }
inline DyadicPair dyadic(const cfree::Dyadic& d) { return {integer(d.n), d.k}; }

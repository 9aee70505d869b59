// Elementary functions from + - * / and square roots alone, which are rounded alike everywhere: the same doubles on every
// machine, to about one unit in the last place. Libraries differ in theirs.
#pragma once
#include <cmath>

namespace cfree {

struct CosineSine {
    double c, s;
};
CosineSine cosine_sine(double x);  // up to 2^18 turns; else no numbers
inline double cosine(double x) { return cosine_sine(x).c; }
inline double sine(double x) { return cosine_sine(x).s; }
double tangent(double x);
double in_a_turn(double x);  // in [0, 2 pi), or 2 pi by rounding, within 2^-50; up to 2^18 turns, else no number

double arc_tangent(double x);
double arc_tangent(double y, double x);  // of the point (x, y), in [-pi, pi]

double norm_of_extremes(double x, double y);
inline double norm(double x, double y) {
    const double square = x * x + y * y;
    return square > 0x1p-900 && square < 0x1p+1000 ? std::sqrt(square) : norm_of_extremes(x, y);
}

}  // namespace cfree

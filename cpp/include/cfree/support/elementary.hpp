// Elementary functions from + - * / and square roots alone, which every machine rounds alike. Their doubles are the same
// on every machine, to about one unit in the last place; those of libraries differ.
#pragma once
#include <cmath>

namespace cfree {

struct CosineSine {
    double c, s;
};
CosineSine cosine_sine(double x);  // up to 2^18 turns; else NaN
inline double cosine(double x) { return cosine_sine(x).c; }
inline double sine(double x) { return cosine_sine(x).s; }
double tangent(double x);
double in_a_turn(double x);  // in [0, 2 pi), or 2 pi by rounding, within 2^-50; up to 2^18 turns, else no number

double arc_tangent(double x);
double arc_tangent(double y, double x);  // angle of the point (x, y), in [-pi, pi]

double norm_of_extremes(double x, double y);
inline double norm(double x, double y) {
    const double square = x * x + y * y;
    return square > 0x1p-900 && square < 0x1p+1000 ? std::sqrt(square) : norm_of_extremes(x, y);
}

}  // namespace cfree

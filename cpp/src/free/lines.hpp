// Contact lines relative to a point, as values or as polynomials in tau.
#pragma once
#include "cfree/contact/contact_line.hpp"

namespace cfree {

// f at tau, or as a polynomial.
struct Evaluation {
    Approx c, s;
    Approx operator()(const Trig<Approx>& f) const { return f.a + f.b * c + f.c * s; }
};
struct Expansion {
    int chart;
    Poly operator()(const Trig<Int>& f) const {
        if (chart == 0) return {f.a + f.b, f.c + f.c, f.a - f.b};
        return {f.a - f.b, -(f.c + f.c), f.a + f.b};
    }
};
inline Approx two_products(Approx p, Approx q, Approx r, Approx s) { return p * q - r * s; }
inline Poly two_products(const Poly& p, const Poly& q, const Poly& r, const Poly& s) {
    return difference(product(p, q), product(r, s));
}

// f(p / r), times a positive number.
inline Int value_at(const Poly& f, const Int& p, const Int& r) {
    Int value = 0, power = 1;
    for (int k = f.size() - 1; k >= 0; --k, power *= r) value = value * p + f[k] * power;
    return value;
}

// Sign of the first derivative that is not zero, and its number; -1 if there is none.
struct Leading {
    int order, sign;
};
inline Leading leading(Poly f, const Int& p, const Int& r) {
    for (int order = 0; !f.empty(); ++order, f = derivative(f))
        if (const int s = value_at(f, p, r).sign(); s != 0) return {order, s};
    return {-1, 0};
}

template <class T>
T constant(int value) {
    if constexpr (std::is_same_v<T, Int>) return value;
    else return {double(value), double(std::abs(value))};
}

// Line of a contact surface relative to a point q / w; all times w.
template <class T>
struct Line : ContactLine<T> {
    using ContactLine<T>::on_edge, ContactLine<T>::a, ContactLine<T>::b, ContactLine<T>::E;
    Vec<T> q;
    T w;
    Line(const Scene& scene, const Feature& contact, const Vec<T>& point, const T& by)
        : ContactLine<T>(scene, contact, CoreUnits<T>{}), q(point), w(by) {}
    Vec<T> away() const { return {q.x - w * b.x, q.y - w * b.y}; }  // q - b
    T zero() const { return constant<T>(0); }
    Trig<T> side() const {  // U x (q - P): positive on its left
        const auto d = away();
        if (on_edge) return {cross(E, d), w * cross(E, a), w * dot(E, a)};
        return {-(w * cross(E, a)), -cross(E, d), dot(E, d)};
    }
    Trig<T> along() const {  // U . (q - P)
        const auto d = away();
        if (on_edge) return {dot(E, d), w * dot(E, a), -(w * cross(E, a))};
        return {-(w * dot(E, a)), -dot(E, d), -cross(E, d)};
    }
    Trig<T> length() const { return {w * dot(E, E), zero(), zero()}; }  // U . U
    Trig<T> height() const { return {w * b.y - q.y, -(w * a.y), -(w * a.x)}; }  // height of P over q
    Trig<T> down() const {  // -U, vertically
        if (on_edge) return {-(w * E.y), zero(), zero()};
        return {zero(), w * E.y, w * E.x};
    }
    Trig<T> distance() const { return {w * b.x - q.x, -(w * a.x), w * a.y}; }  // distance of P to the right of q
    Trig<T> back() const {  // -U, horizontally
        if (on_edge) return {-(w * E.x), zero(), zero()};
        return {zero(), w * E.x, -(w * E.y)};
    }
};

}  // namespace cfree

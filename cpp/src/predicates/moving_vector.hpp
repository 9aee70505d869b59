// Vectors p - R q of which one part is fixed to the obstacles and one to the robot, and their products: a + b cos + c sin.
//
// Edges of obstacles (q = 0), edges of the robot as edges of a pillar (p = 0), and differences of its vertices b - R a are such
// vectors.
#pragma once
#include "cfree/predicates/predicates.hpp"

namespace cfree {

template <class K>
struct MovingVector {
    Vec<K> p, q;
};

template <class K>
Vec<K> quarter_turn(const Vec<K>& v) { return {-v.y, v.x}; }
template <class K>
MovingVector<K> quarter_turn(const MovingVector<K>& v) { return {quarter_turn(v.p), quarter_turn(v.q)}; }

template <class K>
Trig<K> dot(const MovingVector<K>& v, const MovingVector<K>& w) {
    return {dot(v.p, w.p) + dot(v.q, w.q), -(dot(v.p, w.q) + dot(v.q, w.p)), cross(v.p, w.q) + cross(w.p, v.q)};
}
template <class K>
Trig<K> cross(const MovingVector<K>& v, const MovingVector<K>& w) {
    return {cross(v.p, w.p) + cross(v.q, w.q), -(cross(v.p, w.q) + cross(v.q, w.p)), dot(v.q, w.p) - dot(v.p, w.q)};
}

template <class K>
Trig<K> operator+(const Trig<K>& f, const Trig<K>& g) { return {f.a + g.a, f.b + g.b, f.c + g.c}; }
template <class K>
Trig<K> operator-(const Trig<K>& f, const Trig<K>& g) { return {f.a - g.a, f.b - g.b, f.c - g.c}; }
template <class K>
Trig<K> operator-(const Trig<K>& f) { return {-f.a, -f.b, -f.c}; }
template <class K>
Trig<K> operator*(const K& k, const Trig<K>& f) { return {k * f.a, k * f.b, k * f.c}; }
template <class K>
Trig<K> operator+(const Trig<K>& f, const K& k) { return {f.a + k, f.b, f.c}; }
template <class K>
Trig<K> operator-(const Trig<K>& f, const K& k) { return {f.a - k, f.b, f.c}; }

}  // namespace cfree

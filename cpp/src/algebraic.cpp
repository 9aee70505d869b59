#include "cfree/algebraic.hpp"

#include "cfree/stop.hpp"

namespace cfree {

void RealRoot::halve() {
    if (is_dyadic()) return;
    heed_stop();
    const Dyadic mid = Dyadic::middle(lo, hi);
    const int s = cfree::sign_at(p, mid);
    if (s == 0) lo = hi = mid;
    else if (s == cfree::sign_at(p, lo)) lo = mid;
    else hi = mid;
}

namespace {

// Whether the root of x is one of g, a divisor of its polynomial.
bool is_root_of_divisor(const Poly& g, const RealRoot& x) {
    if (g.size() <= 1) return false;
    const int l = sign_at(g, x.lo), h = sign_at(g, x.hi);
    if (l == 0 || h == 0 || l != h) return true;
    return g.size() > 2 && Sturm(squarefree(g)).roots_in(x.lo, x.hi) > 0;
}

// Order of a root and a dyadic number in its interval.
int order_at(const RealRoot& x, const Dyadic& at) {
    if (x.is_dyadic()) return compare(x.lo, at);
    const int s = sign_at(x.p, at);
    if (s == 0) return 0;
    return s == sign_at(x.p, x.lo) ? 1 : -1;
}

}  // namespace

int sign_at(const Poly& q, RealRoot& x) {
    if (q.empty()) return 0;
    if (x.is_dyadic()) return sign_at(q, x.lo);
    if (is_root_of_divisor(greatest_common_divisor(q, x.p), x)) return 0;
    const Sturm sturm(squarefree(q));
    while (!x.is_dyadic() && (sign_at(q, x.lo) == 0 || sturm.roots_in(x.lo, x.hi) > 0)) x.halve();
    return sign_at(q, x.lo);
}

int compare(RealRoot& x, RealRoot& y) {
    if (compare(x.hi, y.lo) < 0) return -1;
    if (compare(y.hi, x.lo) < 0) return 1;
    if (x.is_dyadic()) return -order_at(y, x.lo);
    if (y.is_dyadic()) return order_at(x, y.lo);
    const RealRoot both{{}, compare(x.lo, y.lo) < 0 ? y.lo : x.lo, compare(x.hi, y.hi) < 0 ? x.hi : y.hi};
    if (is_root_of_divisor(greatest_common_divisor(x.p, y.p), both)) return 0;
    for (;;) {  // they differ: halve both intervals until they part
        if (compare(x.hi, y.lo) < 0) return -1;
        if (compare(y.hi, x.lo) < 0) return 1;
        x.halve(), y.halve();
    }
}

int sign_after(const Poly& q, RealRoot& x) {
    Poly p = q;
    for (;;) {
        if (const int s = sign_at(p, x); s != 0) return s;
        p = derivative(p);
    }
}

int sign_before(const Poly& q, RealRoot& x) {
    int flip = 1;
    Poly p = q;
    for (;; flip = -flip) {
        if (const int s = sign_at(p, x); s != 0) return flip * s;
        p = derivative(p);
    }
}

}  // namespace cfree

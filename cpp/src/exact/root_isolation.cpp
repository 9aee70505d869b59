// Real roots of long polynomials, isolated by Descartes' rule of signs and halving (Collins and Akritas).
#include <algorithm>

#include "cfree/exact/descartes.hpp"
#include "cfree/exact/long_polynomial.hpp"
#include "cfree/support/lookout.hpp"

namespace cfree {

namespace {

using Numbers = std::vector<Int>;  // coefficients from the constant up, leading zeros allowed

// Number of roots strictly between 0 and 1 if this is 0 or 1, else no fewer.
int most_roots(Numbers p) {
    to_bernstein(p);
    int count = 0, last = 0;
    for (const Int& x : p) {
        const int sign = x.sign();
        if (sign * last < 0) ++count;
        if (sign != 0) last = sign;
    }
    return count;
}

class Isolation {
public:
    explicit Isolation(const LongPoly& squarefree) : whole(squarefree), slope(derivative(squarefree)) {}

    // p: a positive multiple of the whole polynomial at lo + (hi - lo) x.
    void search(Numbers p, const Dyadic& lo, const Dyadic& hi) {
        heed_stop();
        const int count = most_roots(p);
        if (count == 0) return;
        if (count == 1) return add(lo, hi);
        for (std::size_t i = 0; i < p.size(); ++i) p[i] <<= static_cast<unsigned>(p.size() - 1 - i);  // at x / 2
        Numbers right = p;
        move_by_one(right);
        const Dyadic middle = Dyadic::middle(lo, hi);
        const bool is_root = right[0].is_zero();
        search(std::move(p), lo, middle);
        if (is_root) roots.push_back({middle, middle});
        search(std::move(right), middle, hi);
    }
    std::vector<std::array<Dyadic, 2>> roots;

private:
    // The only root strictly between, which is simple: halve until the ends are no roots.
    void add(Dyadic lo, Dyadic hi) {
        const int end = sign_at(whole, lo), after = end != 0 ? end : sign_at(slope, lo);
        while (compare(lo, hi) != 0 && (sign_at(whole, lo) == 0 || sign_at(whole, hi) == 0)) {
            const Dyadic middle = Dyadic::middle(lo, hi);
            const int sign = sign_at(whole, middle);
            if (sign != after) hi = middle;
            if (sign != -after) lo = middle;
        }
        roots.push_back({lo, hi});
    }
    const LongPoly& whole;
    LongPoly slope;
};

}  // namespace

std::vector<std::array<Dyadic, 2>> isolate(const LongPoly& squarefree, const Dyadic& lo, const Dyadic& hi) {
    const unsigned k = std::max(lo.k, hi.k);
    const Int from = lo.n << (k - lo.k), width = (hi.n << (k - hi.k)) - from;
    Numbers p;  // at from + width x, over 2^k; times 2^(k d)
    for (int i = squarefree.size(); i-- > 0;) {
        p.push_back(0);
        for (std::size_t j = p.size(); j-- > 1;) p[j] = p[j] * from + p[j - 1] * width;
        p[0] = p[0] * from + (squarefree[i] << (k * static_cast<unsigned>(squarefree.degree() - i)));
    }
    Isolation isolation(squarefree);
    isolation.search(std::move(p), lo, hi);
    return isolation.roots;
}

int roots_in(const LongPoly& squarefree, const Dyadic& lo, const Dyadic& hi) {
    return static_cast<int>(isolate(squarefree, lo, hi).size()) + (sign_at(squarefree, hi) == 0 && !squarefree.empty());
}

}  // namespace cfree

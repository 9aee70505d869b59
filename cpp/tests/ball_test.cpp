// Balls against exact dyadic numbers: whatever is computed, the truth lies inside.
#include "cfree/exact/ball.hpp"

#include <random>

#include "cfree/exact/polynomial.hpp"
#include "check.hpp"

using namespace cfree;

// n 2^e
struct Exact {
    Int n;
    int e = 0;
    static Exact of(double x) {
        int exponent;
        const double mantissa = std::frexp(x, &exponent);
        return {Int(static_cast<std::int64_t>(std::ldexp(mantissa, 53))), exponent - 53};
    }
};
static Exact operator+(const Exact& x, const Exact& y) {
    const int e = std::min(x.e, y.e);
    return {(x.n << static_cast<unsigned>(x.e - e)) + (y.n << static_cast<unsigned>(y.e - e)), e};
}
static Exact operator*(const Exact& x, const Exact& y) { return {x.n * y.n, x.e + y.e}; }
static Exact operator-(const Exact& x) { return {-x.n, x.e}; }

struct Both {
    Ball ball;
    Exact truth;
};

static bool is_finite(const Ball& x) { return std::isfinite(x.hi) && std::isfinite(x.lo) && std::isfinite(x.radius); }
static bool encloses(const Both& x) {
    const Exact error = Exact::of(x.ball.hi) + Exact::of(x.ball.lo) + -x.truth;
    return (Exact::of(x.ball.radius) + -Exact{abs(error.n), error.e}).n.sign() >= 0;
}

static std::mt19937_64 random_bits(1);
static std::int64_t below(std::int64_t n) { return static_cast<std::int64_t>(random_bits() % static_cast<std::uint64_t>(n)); }
static double random_double(int spread) {  // exponents up to the spread
    const auto mantissa = static_cast<double>(below(std::int64_t(1) << 53) - (std::int64_t(1) << 52));
    return std::ldexp(mantissa, static_cast<int>(below(2 * spread + 1)) - spread - 52);
}

static Both leaf(int spread, bool small) {
    if (small) {
        const auto n = static_cast<double>(below(201) - 100);
        return {Ball(n), Exact::of(n)};
    }
    const double hi = random_double(spread);
    switch (below(4)) {
        case 0: return {Ball(hi), Exact::of(hi)};
        case 1: {  // its neighbour: differences cancel
            const double next = std::nextafter(hi, 0);
            return {Ball(next), Exact::of(next)};
        }
        case 2: {
            const auto [s, e] = two_sum(hi, hi * 0x1p-60 * static_cast<double>(below(7)));
            return {{s, e, 0}, Exact::of(s) + Exact::of(e)};
        }
        default: {  // the truth somewhere in the radius
            const double radius = std::abs(hi) * 0x1p-70, off = radius * static_cast<double>(below(9) - 4) / 4;
            return {{hi, 0, radius}, Exact::of(hi) + Exact::of(off)};
        }
    }
}
static Both tree(int depth, int spread, bool small) {
    if (depth == 0) return leaf(spread, small);
    const Both x = tree(depth - 1, spread, small), y = below(5) == 0 ? x : tree(depth - 1, spread, small);
    switch (below(3)) {
        case 0: return {x.ball + y.ball, x.truth + y.truth};
        case 1: return {x.ball - y.ball, x.truth + -y.truth};
        default: return {x.ball * y.ball, x.truth * y.truth};
    }
}

static void the_truth_is_inside() {
    int certain = 0, uncertain = 0;
    for (int k = 0; k < 40000; ++k) {
        const int spreads[] = {2, 40, 300, 1000};  // the last: with underflow and overflow
        const Both x = tree(1 + k % 4, spreads[k / 4 % 4], false);
        const auto sign = certain_sign(x.ball);
        if (!is_finite(x.ball)) {
            CHECK(!sign);
            continue;
        }
        CHECK(encloses(x));
        CHECK(!sign || *sign == x.truth.n.sign());
        ++(sign ? certain : uncertain);
    }
    CHECK(certain > 20000 && uncertain > 100);
}

static void subnormal_numbers_are_enclosed() {
    for (int k = 0; k < 2000; ++k) {
        Both x, y;
        for (Both* z : {&x, &y}) {
            const double value = std::ldexp(static_cast<double>(below(1 << 20)), -1074 + static_cast<int>(below(560)));
            *z = {Ball(value), Exact::of(value)};
        }
        CHECK(encloses({x.ball * y.ball, x.truth * y.truth}));
        CHECK(encloses({x.ball * y.ball - y.ball, x.truth * y.truth + -y.truth}));
    }
    const Ball least(0x1p-1074);
    CHECK(!certain_sign(least * least) && certain_sign(least) == 1);
}

static void small_integers_stay_exact() {
    int zeros = 0;
    for (int k = 0; k < 20000; ++k) {
        const Both x = tree(3, 0, true);
        const auto sign = certain_sign(x.ball);
        CHECK(x.ball.radius == 0 && sign && *sign == x.truth.n.sign());
        zeros += x.truth.n.is_zero();
    }
    CHECK(zeros > 100);
}

// Squares of what lies inside: (m - r)^2 <= x <= (m + r)^2 for x in the ball, as exact numbers.
static void square_roots_are_enclosed() {
    for (int k = 0; k < 40000; ++k) {
        const int spreads[] = {2, 40, 300, 1000};
        Both x = tree(k % 3, spreads[k / 4 % 4], false);
        if (x.truth.n.sign() < 0) x = {-x.ball, -x.truth};
        const Ball root = sqrt(x.ball);
        if (!is_finite(root)) {
            CHECK(!certain_sign(root) && !is_finite(x.ball));
            continue;
        }
        const Exact middle = Exact::of(root.hi) + Exact::of(root.lo), low = middle + -Exact::of(root.radius);
        const Exact high = middle + Exact::of(root.radius);
        CHECK((high * high + -x.truth).n.sign() >= 0);
        CHECK(low.n.sign() <= 0 || (x.truth + -(low * low)).n.sign() >= 0);
        if (x.ball.radius == 0) CHECK(root.radius <= std::abs(root.hi) * 0x1p-100 + 0x1p-530);
    }
    for (int n = 0; n < 5000; ++n) {
        const Ball root = sqrt(ball(Int(n) * n << 60u, 0));
        CHECK(root.radius == 0 && root.hi == n * 0x1p30 && root.lo == 0);
    }
    const Int wide = (Int(1) << 100) + 1;  // its square is too long
    CHECK(std::abs(sqrt(ball(wide * wide, 0)).radius) < 0x1p0);
    CHECK(!certain_sign(sqrt(Ball(1, 0, 1))) && !certain_sign(sqrt(Ball(-0x1p-20, 0, 0x1p-10))) && !is_finite(sqrt(Ball(-1))));
    CHECK(certain_sign(sqrt(Ball(0.0))) == 0 && certain_sign(sqrt(Ball(0x1p-900))) == 1);
    CHECK(!is_finite(sqrt(Ball(0x1p1023) + Ball(0x1p1023))));
}

static void overflow_is_never_certain() {
    const Ball huge(0x1p1000);
    for (const Ball& x : {huge * huge, huge * huge - huge * huge, -(huge * huge), (huge * huge) * Ball(0.0)}) CHECK(!certain_sign(x));
    CHECK(!certain_sign(ball(Int(1) << 3000, 0)));
}

static void long_integers_are_enclosed() {
    for (int k = 0; k < 5000; ++k) {
        Int n = 1;
        for (std::int64_t words = below(6); words-- > 0;) n = (n << 64) + static_cast<std::uint64_t>(random_bits());
        if (below(2)) n = -n;
        const int shift = static_cast<int>(below(1500));
        const Both x{ball(n, shift), {n, -shift}};
        CHECK(encloses(x) && x.ball.hi == x.ball.hi + x.ball.lo);
    }
    CHECK(ball((Int(1) << 105) + 1, 0).radius == 0);
    CHECK(ball((Int(1) << 300) + 1, 0).radius > 0);
    const Dyadic third{(Int(1) << 200) / 3, 200};
    const Ball b = ball(third.n, 200);
    CHECK(compare(Dyadic::from(Ball(b.hi, b.lo, 0)), third) < 0);
}

int main() {
    the_truth_is_inside();
    subnormal_numbers_are_enclosed();
    small_integers_stay_exact();
    square_roots_are_enclosed();
    overflow_is_never_certain();
    long_integers_are_enclosed();
    return failures > 0;
}

// Polynomials with square roots against numbers of 1500 bits, and at zeros that are known.
#include "cfree/exact/surd_polynomial.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <random>

#include "cfree/exact/radicals.hpp"
#include "cfree/exact/residues.hpp"
#include "check.hpp"

using namespace cfree;
using boost::multiprecision::cpp_bin_float;
using Bits = cpp_bin_float<1500, boost::multiprecision::digit_base_2>;
using Float = boost::multiprecision::number<Bits, boost::multiprecision::et_off>;

static std::mt19937_64 random_bits(7);
static std::int64_t below(std::int64_t n) { return static_cast<std::int64_t>(random_bits() % static_cast<std::uint64_t>(n)); }
static Int number(int bits = 20) { return Int(below(std::int64_t(2) << bits) - (std::int64_t(1) << bits)); }
static LongPoly random_poly(int degree, int bits = 20) {
    LongPoly p;
    p.resize(degree + 1);
    for (Int& x : p) x = number(bits);
    p.trim();
    return p;
}
static SurdPoly root(int n) { return SurdPoly::root(n); }
static const SurdPoly tau(LongPoly{0, 1});
static const Dyadic minus_one{-1, 0}, one{1, 0};

// p = a + b sqrt(m) + c sqrt(n) + d sqrt(m n)
static SurdPoly random_surd(int degree, int m, int n) {
    const auto part = [&] { return SurdPoly(random_poly(degree)); };
    return part() + part() * root(m) + part() * root(n) + part() * root(m) * root(n);
}

static Float value(const Dyadic& x) { return ldexp(Float(x.n), -static_cast<int>(x.k)); }
static Float value(LongRoot x) {
    while (!x.is_dyadic() && x.digits() < 1400) x.narrow();
    return value(x.lo);
}
static Float value(const SurdPoly& p, const Float& at) {
    Float sum = 0;
    for (std::size_t k = 0; k < p.c.size(); ++k) {
        Float term = 0;
        for (int i = p.c[k].size(); i-- > 0;) term = term * at + Float(p.c[k][i]);
        for (std::size_t i = 0; i < p.roots.size(); ++i)
            if (k >> i & 1) term *= sqrt(Float(p.roots[i]));
        sum += term;
    }
    return sum;
}
static Float value(const Radicals& p, const Float& at) {
    const auto length = [&](const SurdPoly& d) { return Float(sqrt(abs(value(d, at)))); };
    return value(p.a, at) + value(p.b, at) * length(p.d) + (value(p.c, at) + value(p.f, at) * length(p.d)) * length(p.e);
}
static int sign(const Float& x) { return abs(x) < ldexp(Float(1), -500) ? 0 : x.sign(); }

static LongRoot root_of(const LongPoly& p, const Dyadic& lo = minus_one, const Dyadic& hi = one) {
    const LongPoly simple = squarefree(p);
    const auto [from, to] = isolate(simple, lo, hi).at(0);
    return {simple, from, to};
}

static void primes_are_the_largest() {
    const auto below_limit = [](std::size_t k) { return (std::uint64_t(1) << 62) - large_field(k).modulus(); };
    CHECK(below_limit(0) == 57 && below_limit(1) == 87 && below_limit(2) == 117 && below_limit(3) == 143);
    const auto is_prime = [](std::uint64_t n) { return Residues(n).is_prime(); };
    CHECK(!is_prime((std::uint64_t(1) << 62) - 59) && !is_prime(3215031751) && is_prime(2147483647));
    const Residues& field = large_field(0);
    CHECK(field.value(field.times(field.of(-3), field.of(5))) == field.modulus() - 15);
}

static void common_divisors_are_the_greatest() {
    for (int k = 0; k < 200; ++k) {
        const int degree = k % 6;
        const LongPoly common = primitive(random_poly(degree, 50)), p = random_poly(1 + k % 9, 30), q = random_poly(k % 12, 60);
        const LongPoly divisor = greatest_common_divisor(p * common, q * common);
        CHECK(divisor == common || divisor == -common);  // random cofactors have none
        CHECK(squarefree(common * common * p).size() == (common * p).size());
    }
    CHECK(greatest_common_divisor(LongPoly{2, 4}, LongPoly{}) == (LongPoly{1, 2}));
    CHECK(greatest_common_divisor(LongPoly{6}, LongPoly{4}) == LongPoly{1});
    const LongPoly long_one = random_poly(30, 60) * random_poly(10, 60), factor = primitive(random_poly(12, 60));
    CHECK(greatest_common_divisor(long_one * factor, derivative(long_one) * factor).size() == factor.size());
    const LongPoly vanishing{1, large_field(0).modulus()};  // of degree 0 modulo the first prime
    CHECK(greatest_common_divisor(vanishing * LongPoly{2, 1}, vanishing * LongPoly{3, 1}) == vanishing);
    const LongPoly hidden{5 + 3 * Int(large_field(0).modulus()) * large_field(1).modulus(), 1};  // 5 + t modulo two primes
    CHECK(greatest_common_divisor(hidden * LongPoly{2, 1}, hidden * LongPoly{3, 1}) == hidden);
    CHECK(!quotient(LongPoly{1, 1}, LongPoly{0, 1}) && quotient(LongPoly{}, LongPoly{0, 1})->empty());
}

static void roots_are_isolated() {
    // (2 t - 1) (4 t + 1) (t - 1) t (t^2 - 2) (3 t - 1) (3 t - 1 - 2^-40), times 2^40
    const LongPoly near{-(Int(1) << 40) - 1, 3 * (Int(1) << 40)}, line{0, 1};
    const LongPoly p = LongPoly{-1, 2} * LongPoly{1, 4} * LongPoly{-1, 1} * line * LongPoly{-2, 0, 1} * LongPoly{-1, 3} * near;
    const auto roots = isolate(p, minus_one, one);  // without the end
    CHECK(roots.size() == 5 && roots_in(p, minus_one, one) == 6 && roots_in(p, one, Dyadic{2, 0}) == 1);
    for (const auto& [lo, hi] : roots) {
        const bool is_dyadic = compare(lo, hi) == 0;
        CHECK(is_dyadic ? sign_at(p, lo) == 0 : sign_at(p, lo) * sign_at(p, hi) < 0);
    }
    CHECK(isolate(p, Dyadic{-1, 2}, Dyadic{0, 0}).empty() && isolate(p, Dyadic{-1, 2}, Dyadic{1, 1}).size() == 3);
    CHECK(isolate(LongPoly{}, minus_one, one).empty() && isolate(LongPoly{5}, minus_one, one).empty());
    for (int k = 0; k < 25; ++k) {
        const LongPoly q = squarefree(random_poly(3 + k));
        int changes = 0;
        for (int i = -500; i < 500; ++i) changes += sign_at(q, Dyadic{i, 9}) * sign_at(q, Dyadic{i + 1, 9}) < 0;
        CHECK(static_cast<int>(isolate(q, Dyadic{-500, 9}, Dyadic{500, 9}).size()) == changes);
    }
}

static void long_roots_are_compared() {
    const LongPoly p{-1, 0, 2};
    LongRoot x = root_of(p * LongPoly{3, 1, 4, 1, 5, 9, 2, 6, 5, 4}, Dyadic{45, 6}, Dyadic{46, 6});  // sqrt(1/2)
    LongRoot y{p * LongPoly{1, 1, 7}, Dyadic{0, 0}, one}, z{p * 3 + 1, Dyadic{0, 0}, one};
    CHECK(compare(x, y) == 0 && sign_at(p, x) == 0 && sign_at(LongPoly{-1, 0, 0, 0, 4} * LongPoly{1, 5}, y) == 0);
    CHECK(compare(z, x) < 0 && compare(x, z) > 0 && compare(x, Dyadic{45, 6}) > 0 && compare(x, one) < 0);
    const Int large = Int(1) << 300;
    LongRoot near{LongPoly{-large, 0, 2 * large - 1}, Dyadic{0, 0}, one};
    CHECK(compare(near, x) > 0 && sign_at(p, near) > 0);
    CHECK(sign_at(LongPoly{1, 1, 7} * (p * large + 1), y) > 0);  // a common divisor with other roots
    LongRoot half{LongPoly{-1, 2}, Dyadic{0, 0}, one};
    CHECK(compare(half, Dyadic{1, 1}) == 0 && compare(half, x) < 0 && sign_at(LongPoly{-1, 2} * LongPoly{3, 1}, half) == 0);
    CHECK(sign_after(p * p, x) > 0 && sign_before(p, x) < 0);
}

static void roots_stay_independent() {
    CHECK((root(2) + root(8) - SurdPoly(3) * root(2)).c == (std::vector<LongPoly>{0, 0}));
    CHECK((root(50) * root(98)).independent().c[0] == LongPoly{70});
    CHECK(is_zero((root(18) * root(5) - SurdPoly(3) * root(10)) * tau) && !is_zero((root(18) * root(5) + root(10)) * tau));
    CHECK(is_zero(root(6) * root(10) * root(15) - SurdPoly(30)) && is_zero(SurdPoly()) && !is_zero(SurdPoly(1)));
    CHECK(norm(tau - root(2) - root(5) - root(10)).size() == 5 && norm(tau * root(2) - root(8)) == (LongPoly{-4, 4, -1}));
}

// sqrt(2) + sqrt(3) = sqrt(5 + 2 sqrt(6)), as numbers and times tau.
static void sums_of_roots_are_roots() {
    LongRoot x = root_of(random_poly(7) * LongPoly{-1, 3});
    const Radicals same{root(2) + root(3), -1, SurdPoly(5) + SurdPoly(2) * root(6), 0, 0, 0};
    const SurdPoly square = tau * tau;
    const Radicals moved{tau * (root(2) + root(3)), 1, square * same.d, 0, 0, 0};
    CHECK(sign_at(same, one) == 0 && sign_at(same, x) == 0);
    CHECK(sign_at(moved, Dyadic{-3, 5}) == 0 && sign_at(moved, Dyadic{3, 5}) > 0 && sign_at(moved, Dyadic{0, 0}) == 0);
    LongRoot negative{LongPoly{1, 3}, minus_one, one};
    CHECK(sign_at(moved, negative) == 0);
    const Radicals near{same.a, same.b, same.d + SurdPoly(LongPoly{-1, 3}) * tau, 0, 0, 0};  // equal at 1 / 3
    LongRoot third{LongPoly{-1, 3}, Dyadic{0, 0}, one};
    CHECK(sign_at(near, third) == 0 && sign_at(near, Dyadic{11, 5}) < 0 && sign_at(near, Dyadic{10, 5}) > 0);
}

static void signs_are_those_of_long_numbers() {
    for (int k = 0; k < 60; ++k) {
        const int m = 2 + static_cast<int>(below(1000)), n = 2 + static_cast<int>(below(1000));
        const SurdPoly p = random_surd(k % 7, m, n), q = random_surd(2, n, 7);
        LongRoot x = root_of(random_poly(5 + k % 4) * LongPoly{1, 5});
        const Dyadic t{number(30), 31};
        CHECK(sign_at(p, t) == sign(value(p, value(t))) && sign_at(p, x) == sign(value(p, value(x))));
        const Radicals r{p, q, p * p, random_surd(1, m, 3), q * q + SurdPoly(5), q};
        CHECK(sign_at(r, t) == sign(value(r, value(t))) && sign_at(r, x) == sign(value(r, value(x))));
    }
}

// abs(q) - q, with abs(q) as a square root: zero, but only where q is positive; elsewhere the conjugate is.
static void zeros_are_told_from_their_conjugates() {
    int zeros = 0, others = 0;
    for (int k = 0; k < 24; ++k) {
        const int m = 2 + static_cast<int>(below(50)), n = 2 + static_cast<int>(below(50));
        const SurdPoly q = SurdPoly(random_poly(k % 3)) + SurdPoly(random_poly(1)) * root(m);
        const SurdPoly u(random_poly(1)), w(random_poly(2));
        const SurdPoly d = u * u + root(n) * w * w + SurdPoly(1), e = q * q * d;
        const Radicals forms[] = {
            {-q, 1, q * q, 0, 0, 0},                  // abs(q) - q
            {0, -q, d, 1, e, 0},                      // the same times sqrt(d)
            {-q * d, 0, d, 0, e, 1},                  // times d
            {-q * d * w, -q * u, d, u, e, w},         // times u sqrt(d) + w d
            {u, -q, d, 1, e, 0},                      // times sqrt(d), plus u
        };
        LongRoot x = root_of(random_poly(6) * LongPoly{-1, 0, 3});
        const Dyadic t{number(20), 21};
        for (const Radicals& r : forms) {
            const int at_t = sign_at(r, t), at_x = sign_at(r, x);
            CHECK(at_t == sign(value(r, value(t))) && at_x == sign(value(r, value(x))));
            zeros += (at_t == 0) + (at_x == 0), others += (at_t != 0) + (at_x != 0);
        }
    }
    CHECK(zeros > 50 && others > 50);
}

// Where p is zero, abs(a) is sqrt(a^2 + p), and abs(c) is sqrt(c^2 - p).
static void zeros_at_algebraic_angles() {
    int zeros = 0, conjugates = 0;
    for (int k = 0; k < 12; ++k) {
        const auto part = [](int degree) { return SurdPoly(random_poly(degree)); };
        const SurdPoly p = part(3) + part(3) * root(5) + part(2) * root(k % 2 ? 7 : 5);
        const LongPoly all = squarefree(norm(p));
        const SurdPoly a = part(1) * root(5) + part(1), c = part(1) + root(7);
        const Radicals one_root{a, -1, a * a + p, 0, 0, 0}, two_roots{a - c, -1, a * a + p, 1, c * c - p, 0};
        for (const auto& [lo, hi] : isolate(all, minus_one, one)) {
            LongRoot x{all, lo, hi};
            const Float at = value(x);
            const int s = sign_at(p, x);
            CHECK(s == sign(value(p, at)));
            ++(s == 0 ? zeros : conjugates);
            for (const Radicals& r : {one_root, two_roots}) {
                const bool is_real = sign(value(r.d, at)) >= 0 && sign(value(r.e, at)) >= 0;
                if (is_real) CHECK(sign_at(r, x) == sign(value(r, at)));
            }
        }
    }
    CHECK(zeros > 5 && conjugates > 5);
}

// Tangencies: a root of d, of e, or of both.
static void roots_may_vanish() {
    for (int k = 0; k < 12; ++k) {
        const SurdPoly p = tau * SurdPoly(5 + below(50)) - root(2 + k);
        const SurdPoly u = random_surd(1, 2, 3), w = random_surd(1, 2, 3);
        LongRoot x = root_of(norm(p), Dyadic{0, 0}, one);
        CHECK(sign_at(p, x) == 0 && sign_before(p, x) < 0 && sign_after(p * p * p, x) > 0 && sign_before(p * p, x) > 0);
        const int side = sign(value(u, value(x)));
        CHECK(sign_at(Radicals{u, w, p * w, 0, 0, 0}, x) == side && sign_at(Radicals{u * p, w, p * w, 0, 0, 0}, x) == 0);
        CHECK(sign_at(Radicals{p, w, p, u, 1, 0}, x) == side);
        CHECK(sign_at(Radicals{p, w, 1, u, p, w}, x) == sign(value(w, value(x))));
        CHECK(sign_at(Radicals{p, w, p, u, -p, 1}, x) == 0 && sign_at(Radicals{p + u, w, p, u, -p, 1}, x) == side);
    }
}

// A root near zero, where balls have more digits than its interval: 2^-121/2, at which sqrt(2^121) tau is 1.
static void the_width_of_the_interval_counts() {
    const Int large = Int(1) << 121;
    LongRoot x{LongPoly{-1, 0, large}, Dyadic{0, 0}, Dyadic{1, 60}};
    const SurdPoly p = SurdPoly::root(large) * tau - 1;
    CHECK(sign_at(p, x) == 0 && sign_at(p + SurdPoly::root(large) * tau, x) > 0 && sign_at(Radicals{-1, 1, large, 0, 0, 0}, x) > 0);
    CHECK(sign_at(Radicals{-1, tau, large, 0, 0, 0}, x) == 0);
}

// Far below what balls can tell: a - sqrt(a^2 + s) with s small beside a.
static void small_differences_are_told() {
    for (int k = 0; k < 6; ++k) {
        const Int large = Int(1) << static_cast<unsigned>(100 + 40 * k);
        const SurdPoly a = SurdPoly(large) * random_surd(k % 3, 3, 5), s = random_surd(2, 3, 5);
        LongRoot x = root_of(random_poly(4) * LongPoly{-2, 0, 0, 7});
        const Dyadic t{number(10), 11};
        const Radicals r{a, -1, a * a + s, 0, 0, 0}, q{a, -1, a * a + s, -1, 1, 0};
        for (const Radicals& form : {r, q})
            CHECK(sign_at(form, t) == sign(value(form, value(t))) && sign_at(form, x) == sign(value(form, value(x))));
    }
}

static void roots_of_three_irrational_lengths() {
    int changes = 0;
    for (int k = 0; k < 6; ++k) {
        SurdPoly p(random_poly(4));
        for (const int n : {13, 29, 1000003}) p = p + SurdPoly(random_poly(4)) * root(n);
        CHECK(norm(p).degree() == 32);
        const auto roots = roots_between(p, minus_one, one);
        int count = 0, inner = 0;
        for (int i = -250; i < 250; ++i) count += sign_at(p, Dyadic{i, 8}) * sign_at(p, Dyadic{i + 1, 8}) < 0;
        for (const SurdRoot& x : roots) {
            CHECK(x.changes_sign && sign(value(p, value(x.at))) == 0);
            inner += compare(x.at, Dyadic{-250, 8}) > 0 && compare(x.at, Dyadic{250, 8}) < 0;
        }
        CHECK(inner == count);
        changes += count;
    }
    CHECK(changes > 3);
}

static void touches_change_no_sign() {
    const SurdPoly first = tau * root(3) - 1, second = tau + tau - root(2) + 1, third = tau + tau - 1;
    const SurdPoly others = (tau - root(2)) * (tau * root(3) + root(5));
    const SurdPoly p = first * first * second * second * second * third * third * others;
    const auto roots = roots_between(p, minus_one, one);
    // (sqrt(2) - 1) / 2, 1 / 2, 1 / sqrt(3)
    CHECK(roots.size() == 3 && roots[0].changes_sign && !roots[1].changes_sign && !roots[2].changes_sign);
    CHECK(roots[1].at.is_dyadic() || compare(roots[1].at, Dyadic{1, 1}) == 0);
    CHECK(roots_between(p, Dyadic{1, 1}, one).size() == 1 && roots_between(p, Dyadic{5, 3}, one).empty());
    CHECK(roots_between(SurdPoly(4), minus_one, one).empty() && roots_between(root(2) - root(3), minus_one, one).empty());
    const auto cubes = roots_between(third * third * third * (root(2) + tau), minus_one, one);
    CHECK(cubes.size() == 1 && cubes[0].changes_sign);
    // one root in two fields: 2 t^2 = 1 among 2 t = sqrt(2)
    CHECK(roots_between((tau + tau - root(2)) * (SurdPoly(2) * tau * tau - SurdPoly(1)), Dyadic{0, 0}, one).size() == 1);
}

static void coefficients_may_be_sums_of_roots() {
    const RootSum c[] = {RootSum(-1), RootSum::root(2), RootSum(2) * RootSum::root(3)};
    const SurdPoly p = surd_polynomial(c);
    CHECK(is_zero(p - (SurdPoly(-1) + root(2) * tau + SurdPoly(2) * root(3) * tau * tau)));
    CHECK(is_zero(derivative(p) - root(2) - SurdPoly(4) * root(3) * tau) && is_zero(surd_polynomial({})));
    CHECK((2 * RootSum::root(2) + 1 - Int(3)).sign() > 0);
}

// The order of two branches where two irrational lengths meet: the norm has degree 24.
static void norms_of_high_degree() {
    const SurdPoly p = random_surd(6, 13, 29);
    const auto roots = roots_between(p, minus_one, one);
    CHECK(norm(p).degree() == 24);
    for (const SurdRoot& root : roots) {
        LongRoot x = root.at;
        const SurdPoly a = random_surd(3, 13, 29);
        CHECK(sign_at(p, x) == 0 && sign_at(Radicals{a, -1, a * a + p, 0, 0, 0}, x) <= 0);
    }
}

int main() {
    primes_are_the_largest();
    common_divisors_are_the_greatest();
    roots_are_isolated();
    long_roots_are_compared();
    roots_stay_independent();
    sums_of_roots_are_roots();
    signs_are_those_of_long_numbers();
    zeros_are_told_from_their_conjugates();
    zeros_at_algebraic_angles();
    roots_may_vanish();
    the_width_of_the_interval_counts();
    small_differences_are_told();
    roots_of_three_irrational_lengths();
    touches_change_no_sign();
    coefficients_may_be_sums_of_roots();
    norms_of_high_degree();
    return failures != 0;
}

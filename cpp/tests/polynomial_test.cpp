#include "cfree/exact/algebraic.hpp"

#include "check.hpp"

using namespace cfree;

static void signs_at_dyadics_are_exact() {
    const Poly p{-1, 0, 2};  // 2 t^2 - 1, root at sqrt(1/2)
    CHECK(sign_at(p, Dyadic::from(0.70710678118654746)) < 0);
    CHECK(sign_at(p, Dyadic::from(0.70710678118654757)) > 0);
    CHECK(sign_at(Poly{-1, 2}, Dyadic::from(0.5)) == 0);
    CHECK(sign_at(Poly{}, Dyadic::from(0.5)) == 0);
}

static void common_divisors_are_found() {
    const Poly root{-1, 3}, a = product(root, Poly{5, 0, 7}), b = product(root, Poly{2, 1});
    const Poly g = greatest_common_divisor(a, b);
    CHECK(g.size() == 2 && g[0] * 3 == -g[1]);
    CHECK(greatest_common_divisor(Poly{1, 1}, Poly{2, 1}).size() == 1);
    CHECK(squarefree(product(root, root)).size() == 2);
}

static void roots_are_isolated_in_order() {
    const Poly p = product(product(Poly{-1, 2}, Poly{-1, 3}), Poly{1, 4});  // 1/2, 1/3, -1/4
    const Sturm sturm(squarefree(p));
    const auto found = isolate(sturm, Dyadic::from(-1), Dyadic::from(1), 40);
    CHECK(found.size() == 3);
    const double roots[] = {-0.25, 1.0 / 3, 0.5};
    for (std::size_t k = 0; k < found.size(); ++k) {
        CHECK(found[k][0].rounded_down() <= roots[k] && roots[k] <= found[k][1].rounded_up());
        CHECK(found[k][1].rounded_up() - found[k][0].rounded_down() < 1e-11);
    }
    CHECK(isolate(Sturm(Poly{1, 0, 1}), Dyadic::from(-1), Dyadic::from(1), 40).empty());
}

static void rounding_is_outward() {
    const Dyadic third{(Int(1) << 200) / 3, 200};
    CHECK(third.rounded_down() < third.rounded_up());
    CHECK(compare(Dyadic::from(third.rounded_down()), third) < 0);
    CHECK(compare(Dyadic::from(third.rounded_up()), third) > 0);
    for (const double x : {0.0, 1.0, -1.0, 0.1, -0.3, 1e-300, 5e-324, 12345.678})
        CHECK(Dyadic::from(x).rounded_down() == x && Dyadic::from(x).rounded_up() == x);
}

static void narrowing_doubles_the_digits() {
    RealRoot root{Poly{-1, 0, 2}, Dyadic::from(0.70710678118654746), Dyadic::from(0.70710678118654757)};
    for (int k = 0; k < 6; ++k) root.narrow();
    CHECK(root.digits() > 500 && root.digits() < 2000);
    CHECK(sign_at(root.p, root.lo) < 0 && sign_at(root.p, root.hi) > 0);
    RealRoot third{Poly{-1, 3}, Dyadic::from(0.25), Dyadic::from(0.5)}, half{Poly{-1, 2}, Dyadic::from(0.25), Dyadic::from(0.75)};
    for (int k = 0; k < 20; ++k) third.narrow(), half.narrow();
    CHECK(sign_at(third.p, third.lo) < 0 && sign_at(third.p, third.hi) > 0 && third.digits() > 20);
    CHECK(half.is_dyadic() && compare(half.lo, Dyadic::from(0.5)) == 0);
}

// Two roots, 1/3 and 2^-k more, of polynomials of degrees 2 to 6.
static void narrowing_keeps_the_root() {
    const Poly others[] = {{1}, {-2, 0, 1}, product(Poly{-2, 0, 1}, Poly{5, 1, 7})};
    for (unsigned k = 2; k < 160; k += 3)
        for (const Poly& other : others) {
            const Int gap = Int(1) << k;
            const Poly p = product(product(Poly{-1, 3}, Poly{-gap - 3, 3 * gap}), other);
            const auto found = isolate(Sturm(p), Dyadic::from(0), Dyadic::from(1), 8);
            CHECK(found.size() == 2);
            for (const auto& [lo, hi] : found) {
                RealRoot root{p, lo, hi};
                for (int n = 0; n < 12; ++n) {
                    const RealRoot before = root;
                    root.narrow();
                    CHECK(compare(before.lo, root.lo) <= 0 && compare(root.hi, before.hi) <= 0 && root.digits() > before.digits());
                    CHECK(sign_at(p, root.lo) * sign_at(p, root.hi) < 0);
                }
            }
        }
}

static void numbers_that_nearly_agree_are_told_apart() {
    const Int much = Int(1) << 300;
    const Poly p{-much, 0, 2 * much}, above{-much - 1, 0, 2 * much};  // sqrt(1/2), and a little more
    const auto about = [](const Poly& f) { return RealRoot{f, Dyadic::from(0.5), Dyadic::from(1)}; };
    RealRoot x = about(p), y = about(above), z = about(product(p, Poly{3, 1}));
    CHECK(compare(x, y) < 0 && compare(y, x) > 0 && compare(x, z) == 0);
    CHECK(sign_at(above, x) < 0 && sign_at(p, y) > 0 && sign_at(z.p, x) == 0);
    CHECK(sign_on(p, Dyadic::from(0.79), Dyadic::from(0.8)) == 1 && sign_on(p, Dyadic::from(0.7), Dyadic::from(0.8)) == 0);
}

static void rational_roots_are_known() {
    const Poly p = product({-1, 3}, {-2, 0, 1});  // (3 x - 1) (x^2 - 2)
    CHECK(rational_value({p, {0, 0}, {1, 0}}) == (Ratio{1, 3}));
    CHECK(!rational_value({p, {1, 0}, {2, 0}}));
    const Int n = (Int(1) << 300) + 7, d = (Int(1) << 310) + 1;
    CHECK(rational_value({product({-n, d}, {1, 0, 1}), {0, 0}, {1, 0}}) == reduced(n, d));
    CHECK(!rational_value({{-n, 0, d}, {0, 0}, {1, 0}}));
    CHECK(rational_value({{-3, 4}, {3, 2}, {3, 2}}) == (Ratio{3, 4}));
}

static void common_factors_are_divided_out() {
    const Poly f = {2, 6};  // 2 + 6 x
    std::array<Poly, 3> parts{product(f, {1, 1}), product(f, {0, -5}), Poly{}};
    cancel(parts);
    CHECK(parts[0].size() == 2 && parts[0][0] == parts[0][1] && parts[1].size() == 2 && parts[1][0].is_zero());
    CHECK(parts[1][1] == -5 * parts[0][0] && abs(parts[0][0]) == 1 && parts[2].empty());
}

int main() {
    rational_roots_are_known();
    common_factors_are_divided_out();
    narrowing_doubles_the_digits();
    narrowing_keeps_the_root();
    numbers_that_nearly_agree_are_told_apart();
    signs_at_dyadics_are_exact();
    common_divisors_are_found();
    roots_are_isolated_in_order();
    rounding_is_outward();
    return failures > 0;
}

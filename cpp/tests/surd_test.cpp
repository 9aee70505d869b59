#include "cfree/exact/surd.hpp"

#include "check.hpp"

using namespace cfree;

static RootSum root(int n) { return RootSum::root(n); }

static void signs_of_sums_are_exact() {
    CHECK((root(2) + root(3) - root(5)).sign() > 0);
    CHECK((root(2) + root(2) - root(8)).sign() == 0);  // the roots need not be independent
    const RootSum sum = root(2) + root(3);
    CHECK((sum * sum - RootSum(5) - RootSum(2) * root(6)).sign() == 0);
    const Int large = Int(1) << 300;
    CHECK((RootSum::root(large * large + 1) - RootSum(large)).sign() > 0);
    CHECK((RootSum::root(large * large - 1) - RootSum(large)).sign() < 0);
    CHECK(RootSum::root(large).is_rational());
    CHECK((RootSum(17) - RootSum(12) * root(2)).sign() > 0);  // (3 - 2 sqrt(2))^2
}

// u^2 = 2, and (u - 1)^2 = 2 moved by 1: the same root in two fields.
static void roots_of_quadratics_are_ordered() {
    const QuadraticRoot up({RootSum(-2), RootSum(0), RootSum(1)}, true), down({RootSum(-2), RootSum(0), RootSum(1)}, false);
    CHECK(up.against(down) > 0 && down.against(up) < 0 && up.against(up) == 0);
    CHECK(up.against(Ratio{7, 5}) > 0 && up.against(Ratio{3, 2}) < 0 && down.against(Ratio{-7, 5}) < 0);
    const QuadraticRoot line({-root(2), RootSum(1), RootSum(0)}, true);
    CHECK(line.against(up) == 0 && up.against(line) == 0 && line.against(down) > 0);
    const QuadraticRoot falling({root(8), RootSum(-2), RootSum(0)}, false);
    CHECK(falling.against(up) == 0 && falling.against(Ratio{1, 1}) > 0);
    // u^2 - 2 sqrt(2) u + 1: sqrt(2) - 1 and sqrt(2) + 1, and u^2 + 2 u - 1 with the root sqrt(2) - 1
    const QuadraticRoot small({RootSum(1), RootSum(-2) * root(2), RootSum(1)}, false), same({RootSum(-1), RootSum(2), RootSum(1)}, true);
    CHECK(small.against(same) == 0);
}

static void samples_lie_between_roots() {
    std::vector<QuadraticRoot> roots;
    const Ratio zero{0, 1}, one{1, 1};
    add_roots({RootSum(1), RootSum(-4), RootSum(4)}, zero, one, roots);  // (2 u - 1)^2
    add_roots({RootSum(1), RootSum(-2), RootSum(0)}, zero, one, roots);
    add_roots({RootSum(1), RootSum(0), RootSum(-3)}, zero, one, roots);
    add_roots({RootSum(0), RootSum(1), RootSum(-1)}, zero, one, roots);  // at the ends
    add_roots({RootSum(0), RootSum(0), RootSum(0)}, zero, one, roots);
    const auto samples = samples_between(roots, zero, one);
    CHECK(roots.size() == 2 && samples.size() == 3);
    CHECK((zero < samples[0] && samples[0] < Ratio{1, 2} && Ratio{1, 2} < samples[1] && samples[2] < one));
    CHECK(roots[1].against(samples[1]) > 0 && roots[1].against(samples[2]) < 0);
    std::vector<QuadraticRoot> near;  // 2^-200 apart
    const Int large = Int(1) << 200;
    add_roots({RootSum(-large), RootSum(2 * large), RootSum(0)}, zero, one, near);
    add_roots({RootSum(-large - 1), RootSum(2 * large), RootSum(0)}, zero, one, near);
    CHECK(samples_between(near, zero, one).size() == 3);
}

int main() {
    signs_of_sums_are_exact();
    roots_of_quadratics_are_ordered();
    samples_lie_between_roots();
    return failures != 0;
}

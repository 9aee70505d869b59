// Signs of sums of square roots by squaring, and roots of polynomials that hold them; theory, "Segments and arcs".
#include "cfree/exact/surd.hpp"

#include <algorithm>

#include "cfree/exact/squaring.hpp"

namespace cfree {

namespace {

constexpr double certain = 0x1p-44;  // share of the magnitudes that rounding cannot reach: a term has at most 16 roundings

int bits_of(const Int& n) { return n.is_zero() ? 0 : static_cast<int>(msb(abs(n))) + 1; }

// A number m 2^e of any size, rounded.
struct Rounded {
    double m;
    int e;
};
Rounded rounded(const Int& n) { return {ball(n, bits_of(n)).hi, bits_of(n)}; }
Rounded rounded_root(const Int& n) {
    const int e = (bits_of(n) + 1) / 2 * 2;
    return {std::sqrt(ball(n, e).hi), e / 2};
}

// A sum and its magnitude, both times 2^-e.
struct Sum {
    double v, m;
    int e;
};
Sum summed(const std::vector<Int>& c, const std::vector<Int>& roots) {
    std::vector<Rounded> terms;
    int e = -(1 << 30);
    for (std::size_t k = 0; k < c.size(); ++k) {
        if (c[k].is_zero()) continue;
        Rounded term = rounded(c[k]);
        for (std::size_t i = 0; i < roots.size(); ++i)
            if (k >> i & 1) {
                const Rounded root = rounded_root(roots[i]);
                term = {term.m * root.m, term.e + root.e};
            }
        e = std::max(e, term.e);
        terms.push_back(term);
    }
    Sum sum{0, 0, e};
    for (const Rounded& term : terms) {
        const double x = std::ldexp(term.m, std::max(term.e - e, -1000));
        sum.v += x, sum.m += std::abs(x);
    }
    return sum;
}

const auto sign_of = [](const RootSum& x) { return x.sign(); };

Ratio middle(const Ratio& x, const Ratio& y) { return (x + y) * Ratio{1, 2}; }

}  // namespace

std::vector<Int> joined(const std::vector<Int>& x, const std::vector<Int>& y) {
    if (x == y || y.empty()) return x;
    std::vector<Int> all = x;
    for (const Int& n : y) {
        const auto same = std::find_if(all.begin(), all.end(), [&](const Int& m) { return is_multiple_of_root(m, n); });
        if (same == all.end()) all.push_back(n);
        else if (*same != n) *same = gcd(*same, n);
    }
    std::sort(all.begin(), all.end());  // so that equal sets of roots are equal
    return all;
}

template <>
int RootSum::sign() const {
    if (roots.empty()) return c[0].sign();
    const Sum sum = summed(c, roots);
    if (std::abs(sum.v) > certain * sum.m) return sum.v > 0 ? 1 : -1;
    if (sum.m == 0) return 0;
    const auto [a, b] = split();
    return sign_by_squaring(a, b, RootSum(roots.back()), sign_of);
}

template <>
double RootSum::value() const {
    const Sum sum = summed(c, roots);
    return std::ldexp(sum.v, std::clamp(sum.e, -2000, 2000));
}

QuadraticRoot::QuadraticRoot(Terms terms, bool at_rise) : f(std::move(terms)), rises(at_rise) {}

// With the slope s of f at x, and that of f at the root, which is +-sqrt(D): s^2 - D = 4 a f(x).
int QuadraticRoot::against(const Ratio& x) const {
    const RootSum n(x.n), d(x.d);
    const int value = ((f[2] * n + f[1] * d) * n + f[0] * d * d).sign();
    const int slope = (RootSum(2) * f[2] * n + f[1] * d).sign();
    if (rises) return slope < 0 ? f[2].sign() : -value;
    return slope > 0 ? -f[2].sign() : value;
}

int QuadraticRoot::against(const QuadraticRoot& other) const {
    // the root is (p + s sqrt(D)) / q
    struct Form {
        RootSum p, d, q;
    };
    const auto form = [](const Terms& t) -> Form {
        if (t[2].sign() == 0) return {-t[0], RootSum(0), t[1]};
        return {-t[1], t[1] * t[1] - RootSum(4) * t[0] * t[2], RootSum(2) * t[2]};
    };
    const Form x = form(f), y = form(other.f);
    const RootSum by = rises ? y.q : -y.q, less = other.rises ? -x.q : x.q;
    const int over = x.q.sign() * y.q.sign();
    return over * sign_by_squaring(x.p * y.q - y.p * x.q, by, x.d, less, RootSum(0), y.d, sign_of);
}

// Guess of a root in doubles.
static double guess(const QuadraticRoot::Terms& f, bool rises) {
    const double c = f[0].value(), b = f[1].value(), a = f[2].value();
    const double root = std::sqrt(std::max(0.0, b * b - 4 * a * c)) * (rises ? 1 : -1);
    return (root > 0) == (b > 0) && b + root != 0 ? -2 * c / (b + root) : (root - b) / (2 * a);
}

void add_roots(const QuadraticRoot::Terms& f, const Ratio& from, const Ratio& to, std::vector<QuadraticRoot>& roots) {
    const int a = f[2].sign();
    if (a == 0 && f[1].sign() == 0) return;
    const int discriminant = a == 0 ? 1 : (f[1] * f[1] - RootSum(4) * f[0] * f[2]).sign();
    if (discriminant < 0) return;
    for (const bool rises : {false, true}) {
        if (a == 0 ? rises != (f[1].sign() > 0) : discriminant == 0 && rises) continue;
        QuadraticRoot root(f, rises);
        if (root.against(from) <= 0 || root.against(to) >= 0) continue;
        root.low = from, root.high = to;
        if (const double near = guess(f, rises); std::isfinite(near))
            for (double width = 0x1p-50 * std::abs(near) + 0x1p-200; width < 1; width *= 0x1p12) {
                const Ratio low = ratio_of(near - width), high = ratio_of(near + width);
                if (root.low < low && root.against(low) >= 0) root.low = low;
                if (high < root.high && root.against(high) <= 0) root.high = high;
                if (root.low >= low && root.high <= high) break;
            }
        roots.push_back(std::move(root));
    }
}

std::vector<Ratio> samples_between(std::vector<QuadraticRoot>& roots, const Ratio& from, const Ratio& to) {
    const auto order = [](const QuadraticRoot& x, const QuadraticRoot& y) {
        if (x.high < y.low) return -1;
        if (y.high < x.low) return 1;
        return x.against(y);
    };
    std::sort(roots.begin(), roots.end(), [&](const auto& x, const auto& y) { return order(x, y) < 0; });
    roots.erase(std::unique(roots.begin(), roots.end(), [&](const auto& x, const auto& y) { return order(x, y) == 0; }), roots.end());
    const auto halve = [](QuadraticRoot& root) {
        const Ratio x = middle(root.low, root.high);
        const int sign = root.against(x);
        if (sign >= 0) root.low = x;
        if (sign <= 0) root.high = x;
    };
    for (std::size_t k = 0; k + 1 < roots.size(); ++k)
        while (roots[k].high >= roots[k + 1].low) halve(roots[k]), halve(roots[k + 1]);
    if (!roots.empty()) {
        while (roots.front().low == from) halve(roots.front());
        while (roots.back().high == to) halve(roots.back());
    }
    std::vector<Ratio> samples;
    for (std::size_t k = 0; k <= roots.size(); ++k)
        samples.push_back(simple_middle(k == 0 ? from : roots[k - 1].high, k == roots.size() ? to : roots[k].low));
    return samples;
}

}  // namespace cfree

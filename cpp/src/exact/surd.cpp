// Signs of sums of square roots by squaring, and roots of polynomials that hold them; theory, "Segments and arcs".
#include "cfree/exact/surd.hpp"

#include <algorithm>

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

// Sign of x + y sqrt(d), d >= 0.
int sign_of(const RootSum& x, const RootSum& y, const RootSum& d) {
    const int a = x.sign(), b = y.sign() * d.sign();
    if (a * b >= 0) return a != 0 ? a : b;
    return a * (x * x - y * y * d).sign();
}

// Sign of x + y sqrt(d) + z sqrt(e); d, e >= 0.
int sign_of(const RootSum& x, const RootSum& y, const RootSum& d, const RootSum& z, const RootSum& e) {
    const int b = y.sign() * d.sign(), c = z.sign() * e.sign();
    const RootSum first = y * y * d, second = z * z * e;
    const int roots = b * c >= 0 ? (b != 0 ? b : c) : b * (first - second).sign();
    const int a = x.sign();
    if (a * roots >= 0) return a != 0 ? a : roots;
    return a * sign_of(x * x - first - second, RootSum(-2) * y * z, d * e);
}

Ratio middle(const Ratio& x, const Ratio& y) { return (x + y) * Ratio{1, 2}; }

}  // namespace

RootSum RootSum::root(const Int& n) {
    const Int whole = root_below(n);
    if (whole * whole == n) return RootSum(whole);
    RootSum result;
    result.roots = {n}, result.c = {0, 1};
    return result;
}

int RootSum::sign() const {
    if (roots.empty()) return c[0].sign();
    const Sum sum = summed(c, roots);
    if (std::abs(sum.v) > certain * sum.m) return sum.v > 0 ? 1 : -1;
    if (sum.m == 0) return 0;
    const auto half = static_cast<std::ptrdiff_t>(c.size() / 2);
    RootSum a, b;
    a.roots = b.roots = {roots.begin(), roots.end() - 1};
    a.c = {c.begin(), c.begin() + half}, b.c = {c.begin() + half, c.end()};
    return sign_of(a, b, RootSum(roots.back()));
}

double RootSum::value() const {
    const Sum sum = summed(c, roots);
    return std::ldexp(sum.v, std::clamp(sum.e, -2000, 2000));
}

RootSum RootSum::over(const std::vector<Int>& more) const {
    if (more.size() == roots.size()) return *this;
    RootSum result;
    result.roots = more;
    result.c.assign(std::size_t(1) << more.size(), 0);
    std::vector<std::size_t> place;
    for (const Int& n : roots) place.push_back(static_cast<std::size_t>(std::find(more.begin(), more.end(), n) - more.begin()));
    for (std::size_t k = 0; k < c.size(); ++k) {
        std::size_t to = 0;
        for (std::size_t i = 0; i < roots.size(); ++i) to |= (k >> i & 1) << place[i];
        result.c[to] = c[k];
    }
    return result;
}

static std::vector<Int> together(const std::vector<Int>& x, const std::vector<Int>& y) {
    std::vector<Int> all = x;
    for (const Int& n : y)
        if (std::find(all.begin(), all.end(), n) == all.end()) all.push_back(n);
    std::sort(all.begin(), all.end());  // so that equal sets of roots are equal
    return all;
}

RootSum RootSum::operator-() const {
    RootSum result = *this;
    for (Int& n : result.c) n = -n;
    return result;
}

RootSum operator+(const RootSum& x, const RootSum& y) {
    const std::vector<Int> all = together(x.roots, y.roots);
    RootSum result = x.over(all);
    const RootSum other = y.over(all);
    for (std::size_t k = 0; k < result.c.size(); ++k) result.c[k] += other.c[k];
    return result;
}

RootSum operator-(const RootSum& x, const RootSum& y) { return x + -y; }

RootSum operator*(const RootSum& x, const RootSum& y) {
    if (x.roots.empty() && y.roots.empty()) return RootSum(x.c[0] * y.c[0]);
    const std::vector<Int> all = together(x.roots, y.roots);
    const RootSum p = x.over(all), q = y.over(all);
    RootSum result;
    result.roots = all;
    result.c.assign(p.c.size(), 0);
    for (std::size_t i = 0; i < p.c.size(); ++i) {
        if (p.c[i].is_zero()) continue;
        for (std::size_t j = 0; j < q.c.size(); ++j) {
            if (q.c[j].is_zero()) continue;
            Int term = p.c[i] * q.c[j];
            for (std::size_t k = 0; k < all.size(); ++k)
                if ((i & j) >> k & 1) term *= all[k];
            result.c[i ^ j] += term;
        }
    }
    return result;
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
    return x.q.sign() * y.q.sign() * sign_of(x.p * y.q - y.p * x.q, by, x.d, less, y.d);
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

// Read decimals, "p/q" and doubles exactly, and round rationals once; theory, "Coordinates".
#include "cfree/exact/ratio.hpp"

#include <algorithm>
#include <array>
#include <clocale>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <numeric>

namespace cfree {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

void strip(std::string_view& text) {
    while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
}

bool take_sign(std::string_view& text) {
    const bool minus = !text.empty() && text.front() == '-';
    if (minus || (!text.empty() && text.front() == '+')) text.remove_prefix(1);
    return minus;
}

std::string_view take_digits(std::string_view& text) {
    std::size_t n = 0;
    while (n < text.size() && is_digit(text[n])) ++n;
    const auto digits = text.substr(0, n);
    text.remove_prefix(n);
    return digits;
}

// Append digits to a number.
void append(Int& n, std::string_view digits) {
    while (!digits.empty()) {
        const auto block = digits.substr(0, 18);
        std::int64_t value = 0, unit = 1;
        for (const char c : block) value = 10 * value + (c - '0'), unit *= 10;
        if (n.is_zero()) n = value;
        else n = n * unit + value;
        digits.remove_prefix(block.size());
    }
}

Int power(int base, int exponent) {
    static const auto small = [] {
        std::array<Int, 19> powers{1};
        for (std::size_t k = 1; k < powers.size(); ++k) powers[k] = powers[k - 1] * 10;
        return powers;
    }();
    if (base == 10 && exponent < 19) return small[static_cast<std::size_t>(exponent)];
    return boost::multiprecision::pow(Int(base), static_cast<unsigned>(exponent));
}

std::optional<Int> whole(std::string_view text) {
    strip(text);
    const bool minus = take_sign(text);
    const auto digits = take_digits(text);
    if (digits.empty() || !text.empty()) return {};
    Int n = 0;
    append(n, digits);
    return minus ? Int(-n) : n;
}

std::optional<Ratio> decimal(std::string_view text) {
    strip(text);
    const bool minus = take_sign(text);
    const auto units = take_digits(text);
    std::string_view decimals;
    if (!text.empty() && text.front() == '.') {
        text.remove_prefix(1);
        decimals = take_digits(text);
    }
    if (units.empty() && decimals.empty()) return {};
    int exponent = 0;
    if (!text.empty() && (text.front() == 'e' || text.front() == 'E')) {
        text.remove_prefix(1);
        const bool down = take_sign(text);
        const auto digits = take_digits(text);
        if (digits.empty() || digits.size() > 5) return {};
        for (const char c : digits) exponent = 10 * exponent + (c - '0');
        if (down) exponent = -exponent;
    }
    if (!text.empty()) return {};
    exponent -= static_cast<int>(decimals.size());
    if (static_cast<int>(units.size() + decimals.size()) + std::abs(exponent) > most_digits) return {};
    Int n = 0;
    append(n, units), append(n, decimals);
    if (minus) n = -n;
    return exponent < 0 ? reduced(std::move(n), power(10, -exponent)) : Ratio{n * power(10, exponent), 1};
}

}  // namespace

std::optional<Ratio> ratio_of(std::string_view text) {
    if (text.size() > most_digits) return {};
    const auto stroke = text.find('/');
    if (stroke == std::string_view::npos) return decimal(text);
    const auto n = whole(text.substr(0, stroke)), d = whole(text.substr(stroke + 1));
    if (!n || !d || d->is_zero()) return {};
    return reduced(*n, *d);
}

Ratio ratio_of(double value) {
    int exponent;
    auto n = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), 53));
    if (n == 0) return {};
    exponent -= 53;
    const int zeros = std::ilogb(static_cast<double>(n & -n));
    n /= std::int64_t{1} << zeros, exponent += zeros;
    return exponent < 0 ? Ratio{n, Int(1) << static_cast<unsigned>(-exponent)}
                        : Ratio{Int(n) << static_cast<unsigned>(exponent), 1};
}

Ratio reduced(Int n, Int d) {
    if (d.sign() < 0) n = -n, d = -d;
    const Int divisor = gcd(n, d);
    if (divisor != 1) n /= divisor, d /= divisor;
    return {std::move(n), std::move(d)};
}

Ratio power_of_two(int exponent) {
    Int power = 1;
    power <<= static_cast<unsigned>(exponent < 0 ? -exponent : exponent);
    return exponent < 0 ? Ratio{1, power} : Ratio{power, 1};
}

namespace {

// The common beginning of the two continued fractions a / b and c / d, then the least number that separates them. Nothing
// becomes larger than a, b, c and d are, but for a multiple of d, which `is_at_most` compares.
template <class T, class IsAtMost>
std::pair<T, T> simplest(T a, T b, T c, T d, IsAtMost&& is_at_most) {
    T p = 1, q = 0, before_p = 0, before_q = 1;  // the last two convergents
    for (;;) {
        T floor = a / b;
        if (T(floor * b) != a) floor += 1;
        if (is_at_most(floor, d, c)) return {floor * p + before_p, floor * q + before_q};
        floor -= 1;
        T next_p = floor * p + before_p, next_q = floor * q + before_q;
        before_p = std::move(p), before_q = std::move(q), p = std::move(next_p), q = std::move(next_q);
        T next_b = c - floor * d, next_d = a - floor * b;
        a = std::move(d), c = std::move(b), b = std::move(next_b), d = std::move(next_d);
    }
}

Wide wide(const Int& x) {
    const auto low = static_cast<std::uint64_t>(x & Int(~std::uint64_t{0}));
    return static_cast<Wide>(static_cast<std::uint64_t>(x >> 64)) << 64 | static_cast<Wide>(low);
}
Int narrow(Wide x) { return (Int(static_cast<std::uint64_t>(x >> 64)) << 64) + Int(static_cast<std::uint64_t>(x)); }

}  // namespace

Ratio simplest_between(const Ratio& low, const Ratio& high) {
    if (low.n.sign() <= 0) return high.n.sign() < 0 ? -simplest_between(-high, -low) : Ratio{};
    constexpr unsigned most = 126;  // bits
    if (msb(low.n) < most && msb(low.d) < most && msb(high.n) < most && msb(high.d) < most) {
        const auto is_at_most = [](Wide f, Wide d, Wide c) { return f <= c / d; };  // the product may be too wide
        const auto [p, q] = simplest(wide(low.n), wide(low.d), wide(high.n), wide(high.d), is_at_most);
        return {narrow(p), narrow(q)};
    }
    const auto [p, q] = simplest(low.n, low.d, high.n, high.d, [](const Int& f, const Int& d, const Int& c) { return f * d <= c; });
    return {p, q};
}

Ratio simple_middle(const Ratio& low, const Ratio& high) {
    const Ratio quarter = (high - low) / Ratio{4};
    return simplest_between(low + quarter, high - quarter);
}

double nearest(const Int& n, const Int& d) {
    const auto is_short = [](const Int& x) { return x.is_zero() || msb(abs(x)) < 53; };
    const auto rounded = [](const Int& x) { return static_cast<double>(static_cast<std::int64_t>(x)); };
    return is_short(n) && is_short(d) ? rounded(n) / rounded(d) : ratio(n, d);
}

std::string text_of(const Ratio& value) {
    return value.d == 1 ? value.n.str() : value.n.str() + "/" + value.d.str();
}

std::string text_of(double value) {
    std::array<char, 40> text;
    int digits = 0;  // after the point: the fewest that read back as the value
    do std::snprintf(text.data(), text.size(), "%.*e", digits, value);
    while (std::strtod(text.data(), nullptr) != value && ++digits < 17);
    const int exponent = std::atoi(std::strchr(text.data(), 'e') + 1);
    const double size = std::abs(value);
    if (size == 0 || (size >= 1e-4 && size < 1e16))
        std::snprintf(text.data(), text.size(), "%.*f", std::max(digits - exponent, 1), value);
    std::string result = text.data();
    std::replace(result.begin(), result.end(), *std::localeconv()->decimal_point, '.');
    return result;
}

}  // namespace cfree

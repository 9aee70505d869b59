// Quarter turns taken off with more digits of pi than a double can ask for; theory, "Poses, exactly".
#include "cfree/exact/radians.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "cfree/exact/ratio.hpp"

namespace cfree {

namespace {

constexpr unsigned bits = 215, bits_of_theta = 150;       // those of the two right angles: the former has an error below 2^-192
constexpr double most = 0x1p63, least = 0x1p-60;          // below the least, 2 pi less an angle rounds to 2 pi
constexpr double two_pi = 2 * std::numbers::pi;

const Int& right_angle() {
    static const Int value("0xc90fdaa22168c234c4c6628b80dc1cd129024e088a67cc74020bbd");
    return value;
}
const Int& right_angle_of_theta() {  // in units of 2^-bits as well
    static const Int value = Int("0x6487ed5110b4611a62633145c06e0e68948127") << (bits - bits_of_theta);
    return value;
}

// An angle as quarter turns, 0 to 3, and a rest of at most half of one.
struct Split {
    int quarters;
    double rest, theta;
};

Split split(double angle, double ulp) {
    if (std::abs(angle) < least) {
        const double rest = std::abs(angle) > ulp ? angle : 0;
        return {0, rest, rest > 0 ? rest : 0};
    }
    const Ratio exact = ratio_of(angle);
    const Int whole = (exact.n << bits) / exact.d, unit = Int(1) << bits;
    const Int twice = 2 * whole + right_angle();
    Int turns, left;
    divide_qr(twice, Int(2 * right_angle()), turns, left);
    if (left.sign() < 0) turns -= 1;
    Int rest = whole - turns * right_angle();
    const int quarters = static_cast<int>(static_cast<std::int64_t>(turns) & 3);
    const Ratio last = ratio_of(ulp);
    if (abs(rest) <= (last.n << bits) / last.d) rest = 0;
    const int shown = rest.sign() < 0 && quarters == 0 ? 4 : quarters;
    const double theta = nearest(shown * right_angle_of_theta() + rest, unit);
    return {quarters, nearest(rest, unit), theta < two_pi ? theta : 0};
}

}  // namespace

std::optional<Radians> read_radians(double angle) {
    if (!(std::abs(angle) < most)) return {};
    const double size = std::abs(angle);
    const Split at = split(angle, std::nextafter(size, std::numeric_limits<double>::infinity()) - size);
    Ratio tau;
    if (at.rest != 0) {  // the library's tangent, which is Python's: it says which pose is meant, and decides nothing of it
        const Ratio tangent = ratio_of(std::tan(std::abs(at.rest) / 2));
        const Int scaled = tangent.n << 53, unit = tangent.d << 53;
        tau = simplest_between({scaled - tangent.n, unit}, {scaled + tangent.n, unit});
        if (at.rest < 0) tau = -tau;
    }
    Int q = tau.d, p = tau.n;
    for (int k = 0; k < at.quarters; ++k) {  // half a right angle further: (1, 1) times it, in lowest terms
        const Int x = q - p;
        p += q, q = x;
        if (!bit_test(abs(q), 0) && !bit_test(abs(p), 0)) q /= 2, p /= 2;
    }
    if (q.sign() < 0 || (q.is_zero() && p.sign() < 0)) q = -q, p = -p;
    return Radians{q, p, at.theta, std::abs(at.rest) * 0x1p-50};
}

}  // namespace cfree

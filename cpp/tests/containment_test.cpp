// Rings of polygons around closed curves and within them, also where the two touch or all but do.
#include "cfree/curves/containment.hpp"

#include "check.hpp"

using namespace cfree;

static Ratio number(const char* text) { return ratio_of(text).value(); }
static RatioPoint point(const char* x, const char* y) { return {number(x), number(y)}; }

static CurvePiece line(const RatioPoint& p, const RatioPoint& q) { return {{p, q}, {}}; }
static CurvePiece arc(const RatioPoint& center, const RatioPoint& u, const RatioPoint& v, const char* last) {
    return {{center, u, v}, number(last)};
}

// The ellipse of these radii about (0, 0), in quarters.
static ClosedCurve ellipse(const char* a, const char* b) {
    const RatioPoint o = point("0", "0"), u{number(a), {}}, v{{}, number(b)};
    const auto minus = [](const RatioPoint& p) { return RatioPoint{-p.x, -p.y}; };
    return {arc(o, u, v, "1"), arc(o, v, minus(u), "1"), arc(o, minus(u), minus(v), "1"), arc(o, minus(v), u, "1")};
}

static Polygon box(const char* x, const char* y) {
    const Ratio a = number(x), b = number(y);
    return Polygon({{{-a, -b}, {a, -b}, {a, b}, {-a, b}}});
}

static Polygon diamond(const char* x, const char* y) {
    const Ratio a = number(x), b = number(y), zero{};
    return Polygon({{{-a, zero}, {zero, -b}, {a, zero}, {zero, b}}});
}

int main() {
    const ClosedCurve circle = ellipse("1", "1");
    CHECK(is_around(box("1", "1"), 0, circle) && !is_within(box("1", "1"), 0, circle));  // touches in four points
    CHECK(is_within(diamond("1", "1"), 0, circle) && !is_around(diamond("1", "1"), 0, circle));
    CHECK(is_within(box("0.6", "0.79999999999999999999"), 0, circle));  // its corners are all but on it
    for (const char* less : {"0.999", "0.99999999999999999999999999999999", "0.9999999999999999"}) {
        CHECK(!is_around(box(less, "1"), 0, circle) && !is_within(box(less, "1"), 0, circle));
        CHECK(is_within(diamond(less, less), 0, circle));
    }
    for (const char* thin : {"1e-3", "1e-9", "1e-24", "1e-60"}) {
        const ClosedCurve flat = ellipse("1", thin);
        CHECK(is_around(box("1", thin), 0, flat) && is_within(diamond("1", thin), 0, flat));
        CHECK(!is_around(diamond("1", thin), 0, flat) && !is_within(box("1", thin), 0, flat));
    }
    // far from each other, and one around the other the wrong way round
    const Polygon aside({{point("5", "0"), point("6", "0"), point("6", "1"), point("5", "1")}});
    CHECK(!is_around(aside, 0, circle) && !is_within(aside, 0, circle));
    CHECK(!is_within(box("2", "2"), 0, circle) && !is_around(box("1/4", "1/4"), 0, circle));
    // a hole
    const Polygon plate({RatioRing{point("-3", "-3"), point("3", "-3"), point("3", "3"), point("-3", "3")},
                         RatioRing{point("-1", "-1"), point("-1", "1"), point("1", "1"), point("1", "-1")}});
    CHECK(is_around(plate, 1, circle) && !is_within(plate, 1, circle));
    // lines on edges, along a part of one, and across one
    const RatioPoint a = point("0", "0"), b = point("2", "0"), c = point("2", "1"), d = point("0", "1"), m = point("1", "0");
    const Polygon ring({{a, b, c, d}});
    CHECK(is_around(ring, 0, {line(a, m), line(m, b), line(b, c), line(c, d), line(d, a)}));
    CHECK(is_within(ring, 0, {line(a, m), line(m, b), line(b, c), line(c, d), line(d, a)}));
    const RatioPoint beyond = point("1", "-1e-40"), within = point("1", "1e-40");
    CHECK(!is_around(ring, 0, {line(a, beyond), line(beyond, b), line(b, c), line(c, d), line(d, a)}));
    CHECK(is_within(ring, 0, {line(a, beyond), line(beyond, b), line(b, c), line(c, d), line(d, a)}));
    CHECK(is_around(ring, 0, {line(a, within), line(within, b), line(b, c), line(c, d), line(d, a)}));
    CHECK(!is_within(ring, 0, {line(a, within), line(within, b), line(b, c), line(c, d), line(d, a)}));
    // a Bézier curve on a line, and one that bulges
    CHECK(is_around(ring, 0, {{{a, point("1/3", "0"), m, b}, {}}, line(b, c), line(c, d), line(d, a)}));
    CHECK(!is_around(ring, 0, {{{a, point("1/3", "-1e-30"), m, b}, {}}, line(b, c), line(c, d), line(d, a)}));
    CHECK(is_around(ring, 0, {{{a, point("1/3", "1e-30"), m, b}, {}}, line(b, c), line(c, d), line(d, a)}));
    // a curve that is not closed contains nothing
    CHECK(!is_around(box("3", "3"), 0, {circle[0], circle[1]}) && !is_around(box("3", "3"), 0, {}));
    return failures != 0;
}

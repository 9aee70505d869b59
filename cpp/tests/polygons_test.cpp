#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "cfree/polygons/constrained_delaunay.hpp"
#include "cfree/polygons/convex_decomposition.hpp"
#include "cfree/polygons/segment_sweep.hpp"
#include "check.hpp"

using namespace cfree;

using Numbers = std::vector<std::pair<std::string, std::string>>;

static RatioRing ring_of(const Numbers& numbers) {
    RatioRing ring;
    for (const auto& [x, y] : numbers) ring.push_back({ratio_of(x).value(), ratio_of(y).value()});
    return ring;
}

static Polygon polygon_of(const std::vector<Numbers>& rings) {
    std::vector<RatioRing> read;
    for (const auto& ring : rings) read.push_back(ring_of(ring));
    return Polygon(read);
}

static std::string fault_of(const std::vector<Numbers>& rings) {
    try {
        polygon_of(rings);
    } catch (const InvalidPolygon& fault) {
        return fault.what();
    }
    return "";
}

static Int doubled_area(const Points& v, const std::vector<Index>& ring) {
    Int area = 0;
    for (std::size_t k = 0; k < ring.size(); ++k) {
        const Index p = ring[k], q = ring[k + 1 < ring.size() ? k + 1 : 0];
        area += v.X(p) * v.Y(q) - v.X(q) * v.Y(p);
    }
    return area;
}

static Int doubled_area(const Polygon& polygon) {
    Int area = 0;
    for (std::size_t r = 0; r + 1 < polygon.offsets.size(); ++r) {
        std::vector<Index> ring;
        for (Index k = polygon.offsets[r]; k < polygon.offsets[r + 1]; ++k) ring.push_back(k);
        area += doubled_area(polygon.vertices, ring);
    }
    return area;
}

// Strictly convex, and as large as the polygon altogether.
static void check_pieces(const Polygon& polygon) {
    Int area = 0;
    for (const auto& piece : polygon.pieces()) {
        const std::size_t n = piece.size();
        for (std::size_t k = 0; k < n; ++k)
            CHECK(polygon.vertices.orient(piece[k], piece[(k + 1) % n], piece[(k + 2) % n]) > 0);
        area += doubled_area(polygon.vertices, piece);
    }
    CHECK(area == doubled_area(polygon));
}

static const Numbers square{{"0", "0"}, {"12", "0"}, {"12", "12"}, {"0", "12"}};

static void numbers_are_what_they_are_written_as() {
    CHECK((ratio_of("0.1") == Ratio{1, 10}));
    CHECK((ratio_of(" -2.50e+2 ") == Ratio{-250, 1}));
    CHECK((ratio_of("6/-4") == Ratio{-3, 2}));
    CHECK((ratio_of("1e-20").value().d == boost::multiprecision::pow(Int(10), 20)));
    for (const char* wrong : {"", "x", "1/0", "1e", "1.2.3", "0x1", "1e99999", "nan", "-", "1 2"}) CHECK(!ratio_of(wrong));
    CHECK((ratio_of(0.75) == Ratio{3, 4}));
    CHECK((ratio_of(-0.1).d == Int(1) << 55));
    CHECK((ratio_of(0x1p-1074) == Ratio{1, Int(1) << 1074}));
    std::mt19937_64 random(1);
    for (int k = 0; k < 2000; ++k) {
        const double x = std::ldexp(static_cast<double>(random() >> 11), static_cast<int>(random() % 2000) - 1080);
        const Ratio exact = ratio_of(x);
        CHECK(nearest(exact.n, exact.d) == x);
        if (x == 0) continue;
        const double above = std::nextafter(x, 2 * x);
        const Ratio next = ratio_of(above);
        // a hair on either side of the middle
        const Int middle = exact.n * next.d + next.n * exact.d, unit = 2 * exact.d * next.d;
        CHECK(nearest(middle * 1000000007 - 1, unit * 1000000007) == x);
        CHECK(nearest(middle * 1000000007 + 1, unit * 1000000007) == above);
        CHECK(nearest(-middle * 1000000007 - 1, unit * 1000000007) == -above);
    }
    CHECK(text_of(0.1) == "0.1" && text_of(1e-5) == "1e-05" && text_of(-2.0) == "-2.0" && text_of(1e16) == "1e+16");
}

static void rings_are_cleaned_and_turned_around() {
    const Polygon p = polygon_of({{{"0", "0"}, {"0", "1/2"}, {"0", "1"}, {"1", "0"}, {"1", "0"}, {"0", "0"}}});
    CHECK(p.vertices.size() == 3 && p.denominator == 1 && p.removed.size() == 2 && p.is_convex());
    CHECK(p.vertices.orient(0, 1, 2) > 0 && p.vertices.X(0) == 0 && p.vertices.X(1) == 1);
    const Polygon holed = polygon_of({square, {{"1", "1"}, {"2", "1"}, {"1", "2"}}});
    CHECK(holed.vertices.orient(4, 5, 6) < 0 && !holed.is_convex());
}

static void faults_are_named() {
    CHECK(fault_of({{{"0", "0"}, {"2", "2"}, {"2", "0"}, {"0", "3"}}}) ==
          "outer ring: edges 0 and 2 cross at (6/5, 6/5); split it into simple polygons");
    CHECK(fault_of({square, {{"6", "6"}, {"18", "6"}, {"6", "7"}}}) ==
          "hole 0: edge 0 crosses edge 1 of outer ring at (12, 6); keep the rings apart");
    CHECK(fault_of({square, {{"20", "6"}, {"28", "6"}, {"26", "7"}}}) ==
          "hole 0: it lies outside the outer ring; move it, or leave it out");
    CHECK(fault_of({{{"1", "1"}, {"2", "1"}, {"1", "2"}}, square}) == "hole 0: it lies around the outer ring; swap the two");
    CHECK(fault_of({{{"0", "0"}, {"1", "1"}, {"3", "3"}}}) ==
          "outer ring: its points lie on one line, its area is zero; give points that bound an area");
    CHECK(fault_of({{{"0", "0"}, {"4", "0"}, {"2", "0"}, {"2", "2"}}}) == "outer ring: the angle at point 1 is zero; remove this spike");
    CHECK(fault_of({square, {{"1", "1"}, {"9", "1"}, {"1", "9"}}, {{"2", "2"}, {"3", "2"}, {"2", "3"}}}) ==
          "hole 1: it lies inside hole 0; give it as another polygon");
}

static void pieces_of_known_polygons() {
    CHECK((polygon_of({{{"0", "0"}, {"2", "0"}, {"2", "1"}, {"1", "1"}, {"1", "2"}, {"0", "2"}}}).pieces() ==
           Pieces{{0, 1, 2, 3}, {0, 3, 4, 5}}));
    CHECK(polygon_of({square, {{"4", "4"}, {"8", "4"}, {"8", "8"}, {"4", "8"}}}).pieces().size() == 4);
    for (const auto& holes : std::vector<std::vector<Numbers>>{
             {{{"0", "0"}, {"2", "1"}, {"1", "2"}}},
             {{{"0", "6"}, {"3", "5"}, {"3", "7"}}},
             {{{"2", "0"}, {"3", "3"}, {"1", "3"}}, {{"3", "3"}, {"5", "3"}, {"5", "5"}}},
             {{{"0", "6"}, {"6", "5"}, {"12", "6"}, {"6", "7"}}},
             {{{"0", "3"}, {"3", "0"}, {"3", "3"}}, {{"12", "9"}, {"9", "12"}, {"9", "9"}}, {{"3", "3"}, {"9", "9"}, {"4", "8"}}}}) {
        std::vector<Numbers> rings{square};
        rings.insert(rings.end(), holes.begin(), holes.end());
        check_pieces(polygon_of(rings));
    }
}

// Random stars, on a coarse grid and far away with 2^-70 between neighbours: triangles cover them, before and after flips,
// and no edge between two triangles should be flipped.
static void triangles_are_delaunay() {
    std::mt19937 random(7);
    for (int round = 0; round < 300; ++round) {
        const int n = 5 + static_cast<int>(random() % 40);
        std::vector<Int> x, y;
        const Int place = round % 2 ? Int(1) << 100 : Int(0);
        for (int k = 0; k < n; ++k) {
            const double r = 20 + static_cast<double>(random() % 40), angle = 6.283185307179586 * k / n;
            x.push_back(place + static_cast<int>(r * std::cos(angle))), y.push_back(place - static_cast<int>(r * std::sin(angle)));
        }
        std::optional<Polygon> polygon;
        try {
            polygon.emplace(std::vector{Points(x, y)}, Int(1) << 70);
        } catch (const InvalidPolygon&) {
            continue;
        }
        const Points& v = polygon->vertices;
        std::vector<std::vector<Index>> rings(1);
        for (Index k = 0; k < v.size(); ++k) rings[0].push_back(k);
        CHECK(!twins(v, rings, swept_triangles(v, rings)).empty());
        const Cover cover = constrained_delaunay(v, rings);
        CHECK(cover.twin == twins(v, rings, cover.triangles));
        Triangles missing = cover.triangles;
        missing.pop_back();
        CHECK(twins(v, rings, missing).empty());
        check_pieces(*polygon);
    }
}

static void rings_that_cross_are_found() {
    const auto points = [](std::vector<Int> x, std::vector<Int> y) { return Points(std::move(x), std::move(y)); };
    const auto found = sweep(points({0, 2, 2, 0}, {0, 2, 0, 2}), {0, 4});
    const auto* meeting = std::get_if<EdgesMeet>(&found);
    CHECK(meeting && meeting->first == 0 && meeting->second == 2);
    const auto nested = sweep(points({0, 9, 9, 0, 3, 3, 4}, {0, 0, 9, 9, 0, 4, 4}), {0, 4, 7});
    const auto* nesting = std::get_if<Nesting>(&nested);
    CHECK(nesting && nesting->below[0] == -1 && nesting->below[1] == 0);
    CHECK(nesting && nesting->touching == (std::vector<std::pair<Index, Index>>{{0, 4}}));
    CHECK(is_inside(polygon_of({{{"1", "1"}, {"2", "1"}, {"1", "2"}}}), polygon_of({square})));
    CHECK(!is_inside(polygon_of({{{"0", "1"}, {"2", "1"}, {"1", "2"}}}), polygon_of({square})));
    CHECK(!is_inside(polygon_of({square}), polygon_of({square})));
}

// Points of a coarse grid, at 0 and so far away that they are no machine integers, in one of the two and in both axes.
static void signs_are_those_of_points_far_away() {
    std::mt19937 random(11);
    for (int round = 0; round < 200; ++round) {
        std::vector<Int> x, y, far_x, far_y;
        const Int by_x = round % 3 ? Int(1) << 63 : Int(0), by_y = round % 3 == 1 ? Int(0) : -(Int(1) << 200);
        for (int k = 0; k < 6; ++k) {
            x.push_back(static_cast<int>(random() % 4) - 2), y.push_back(static_cast<int>(random() % 4) - 2);
            far_x.push_back(x.back() + by_x), far_y.push_back(y.back() + by_y);
        }
        const Points near(x, y), far(far_x, far_y);
        CHECK(near.are_small() && !far.are_small() && near.size() == 6 && far.size() == 6);
        CHECK(near.coordinates() == (std::array{x, y}) && far.coordinates() == (std::array{far_x, far_y}));
        const auto [x0, x1] = std::minmax_element(far_x.begin(), far_x.end());
        const auto [y0, y1] = std::minmax_element(far_y.begin(), far_y.end());
        CHECK(far.box() == (std::array{*x0, *y0, *x1, *y1}));
        CHECK(near.box() == (std::array{Int(*x0 - by_x), Int(*y0 - by_y), Int(*x1 - by_x), Int(*y1 - by_y)}));
        CHECK(far.chosen({4, 1}).X(0) == far_x[4] && near.chosen({4, 1}).Y(1) == y[1]);
        for (Index p = 0; p < 6; ++p)
            for (Index q = 0; q < 6; ++q) {
                CHECK(near.compare(p, q) == far.compare(p, q) && near.is_upper(p, q) == far.is_upper(p, q));
                CHECK(near.turn(p, q, 4, 5) == far.turn(p, q, 4, 5) && near.along(p, q, 4, 5) == far.along(p, q, 4, 5));
                CHECK(near.compare_lengths(p, q, 4, 5) == far.compare_lengths(p, q, 4, 5));
            }
    }
}

int main() {
    signs_are_those_of_points_far_away();
    numbers_are_what_they_are_written_as();
    rings_are_cleaned_and_turned_around();
    faults_are_named();
    pieces_of_known_polygons();
    triangles_are_delaunay();
    rings_that_cross_are_found();
    return failures > 0;
}

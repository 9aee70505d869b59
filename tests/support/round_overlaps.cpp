// Read pairs of regions of segments and circular arcs, and print for each pair 1 if their interiors meet, else 0, by CGAL.
//
// A region is a number of rings, the outer one first; a ring is a number of curves; a curve is x and y of its start, its end
// and its center, in fractions, and its turn: 0 for a segment. The inside is on the left.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/General_polygon_set_2.h>
#include <CGAL/Gps_circle_segment_traits_2.h>

#include <iostream>
#include <list>

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Traits = CGAL::Gps_circle_segment_traits_2<Kernel>;
using Regions = CGAL::General_polygon_set_2<Traits>;
using Ring = Traits::General_polygon_2;
using Region = Traits::General_polygon_with_holes_2;
using Number = Kernel::FT;

void add(Ring& ring, const Traits::Curve_2& curve) {
    std::list<CGAL::Object> parts;
    Traits().make_x_monotone_2_object()(curve, std::back_inserter(parts));
    for (const CGAL::Object& part : parts) {
        Traits::X_monotone_curve_2 monotone;
        if (CGAL::assign(monotone, part)) ring.push_back(monotone);
    }
}

Ring read_ring() {
    Ring ring;
    int count = 0;
    std::cin >> count;
    for (int k = 0; k < count; ++k) {
        Number px, py, qx, qy, cx, cy;
        int turn = 0;
        std::cin >> px >> py >> qx >> qy >> cx >> cy >> turn;
        const Kernel::Point_2 p(px, py), q(qx, qy), center(cx, cy);
        if (turn == 0) {
            add(ring, Traits::Curve_2(p, q));
            continue;
        }
        const Kernel::Circle_2 circle(center, CGAL::squared_distance(center, p), turn > 0 ? CGAL::COUNTERCLOCKWISE : CGAL::CLOCKWISE);
        add(ring, Traits::Curve_2(circle, Traits::Point_2(px, py), Traits::Point_2(qx, qy)));
    }
    return ring;
}

Region read_region(int rings) {
    const Ring outer = read_ring();
    std::list<Ring> holes;
    for (int k = 1; k < rings; ++k) holes.push_back(read_ring());
    return {outer, holes.begin(), holes.end()};
}

int main() {
    for (int rings = 0; std::cin >> rings;) {
        Regions first;
        first.insert(read_region(rings));
        std::cin >> rings;
        std::cout << first.do_intersect(read_region(rings)) << '\n';
    }
}

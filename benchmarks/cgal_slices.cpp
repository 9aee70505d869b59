// Slices of the forbidden space by CGAL's exact Minkowski sums: median seconds of one.
//
// Input: how many orientations, and the half-angle tangent of each; how many polygons the robot and the obstacles have;
// each polygon as the number of its rings, each ring as the number of its vertices and their coordinates. Numbers are
// doubles, all that follows is exact.

#include <CGAL/Boolean_set_operations_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_set_2.h>
#include <CGAL/minkowski_sum_2.h>

#include <algorithm>
#include <ctime>
#include <iostream>
#include <vector>

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Ring = CGAL::Polygon_2<Kernel>;
using Polygon = CGAL::Polygon_with_holes_2<Kernel>;
using Number = Kernel::FT;
using Polygons = std::vector<Polygon>;

Polygons read()
{
    std::size_t count;
    std::cin >> count;
    Polygons polygons;
    while (count--) {
        std::size_t rings;
        std::cin >> rings;
        std::vector<Ring> found;
        while (rings--) {
            std::size_t vertices;
            std::cin >> vertices;
            Ring ring;
            while (vertices--) {
                double x, y;
                std::cin >> x >> y;
                ring.push_back({x, y});
            }
            found.push_back(ring);
        }
        polygons.emplace_back(found.front(), found.begin() + 1, found.end());
    }
    return polygons;
}

Polygon turned(Polygon const& polygon, double tau)  // - R A
{
    Number const t = tau, c = (1 - t * t) / (1 + t * t), s = 2 * t / (1 + t * t);
    CGAL::Aff_transformation_2<Kernel> const by(-c, s, -s, -c);
    std::vector<Ring> holes;
    for (auto hole = polygon.holes_begin(); hole != polygon.holes_end(); ++hole)
        holes.push_back(CGAL::transform(by, *hole));
    return {CGAL::transform(by, polygon.outer_boundary()), holes.begin(), holes.end()};
}

double slice(Polygons const& robot, Polygons const& obstacles, double tau)  // seconds
{
    std::clock_t const start = std::clock();
    Polygons sums;
    for (Polygon const& part : robot) {
        Polygon const by = turned(part, tau);
        for (Polygon const& obstacle : obstacles)
            sums.push_back(CGAL::minkowski_sum_2(obstacle, by));
    }
    Polygons joined;
    CGAL::join(sums.begin(), sums.end(), std::back_inserter(joined));
    return double(std::clock() - start) / CLOCKS_PER_SEC;
}

int main()
{
    std::size_t count;
    std::cin >> count;
    std::vector<double> taus(count);
    for (double& tau : taus)
        std::cin >> tau;
    Polygons const robot = read(), obstacles = read();
    std::vector<double> times;
    for (double tau : taus)
        times.push_back(slice(robot, obstacles, tau));
    std::nth_element(times.begin(), times.begin() + times.size() / 2, times.end());
    std::cout << times[times.size() / 2] << '\n';
}

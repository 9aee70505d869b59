// Shapes of segments and arcs in doubles: gaps between curves, and verdicts on pairs of shapes with a bound of all rounding.
//
// Coordinates are scaled so that M, the largest of all coordinates and radii that occur, is at most 1. Every length computed
// here from placed curves is then within 2^-44 of the truth: `margin` is 2^-40. What is nearer to a tie than that is uncertain.
#pragma once
#include <memory>
#include <utility>

#include "cfree/arcs/shape.hpp"
#include "cfree/collision/pose_checker.hpp"
#include "collision/box_tree.hpp"

namespace cfree {

inline constexpr double margin = 0x1p-40;

// A curve in doubles; `corner` is where the end tangents of an arc meet.
struct NearCurve {
    Vec<double> start, end, center, corner;
    double radius;
    int turn;
};

// A disc inside of a shape, or all of it.
struct InnerDisc {
    Vec<double> center{0, 0};
    double radius = 0;  // 0: there is none
    bool is_all = false;
};

struct NearShape {
    std::vector<NearCurve> curves;
    std::vector<Box> boxes;
    std::vector<Index> ring;
    bool is_outside = false;
    double radius = 0;
    InnerDisc disc;  // radius included
    Box around;  // of its rings
    NearShape() = default;
    NearShape(const ArcShape& shape, int shift);
    void set_boxes();
    // True if a point inside, farther than the margin from all curves, is in the shape.
    bool has(const Vec<double>& p) const;
    // Distance of a point from the rings, or 0 inside; within the margin.
    double distance(const Vec<double>& p) const;

private:
    void find_disc(const ArcShape& shape);
};

// Distance of two curves, within the margin; 0 if it may be less than that, -1 if the two certainly cross.
double gap_between(const NearCurve& a, const NearCurve& b);

// What is certain of two shapes that are `within` apart, or nearer: `forbidden` and `free` hold for all poses in which points
// have moved by at most `slack`. Pairs of curves that may come so near are added to `near`, if it is not null; then the verdict
// is never `forbidden` before all are found.
using CurvePairs = std::vector<std::pair<Index, Index>>;
Verdict verdict_on(const NearShape& a, const NearShape& b, double within, double slack, CurvePairs* near = nullptr);
// What is certain of it by a disc in one of the two, or by all curves.
Verdict by_disc(const InnerDisc& disc, const NearShape& other, double slack);
Verdict verdict_by_curves(const NearShape& a, const NearShape& b, double within, double slack, CurvePairs* near = nullptr);
// Bounds of the distance of two shapes, or of `most` if that is less, within the margin; 0, 0 if they certainly overlap.
struct Gap {
    double low, high;
};
Gap distance_of(const NearShape& a, const NearShape& b, double most);

// All shapes of a scene.
class NearScene {
public:
    explicit NearScene(std::shared_ptr<const ArcScene> scene);
    int shift;    // doubles are lengths times 2^-shift,
    double unit;  // which is this
    std::vector<NearShape> robot, obstacles;
    double reach = 0;  // of the robot, about its reference point
    const std::shared_ptr<const ArcScene> scene;
    // Numbers of the obstacles that may be within a distance of a box.
    template <class F>
    void near(const Box& box, double within, F&& report) const {
        tree->query(grown(box, within + most_radius), [&](Index k) { report(inside[static_cast<std::size_t>(k)]); });
        for (const Index j : outside) report(j);
    }
    // A shape of the robot in a pose: c, s and x, y, scaled.
    void place(std::size_t part, double x, double y, double c, double s, NearShape& placed) const;

private:
    double most_radius = 0;  // of grown obstacles
    std::vector<Index> inside, outside;
    std::unique_ptr<BoxTree> tree;
};

}  // namespace cfree

// Curves of contact surfaces of grown shapes, which are lines and circles at each angle: positions, with bounds by intervals;
// theory, "Meshes among rounded shapes".
//
// A position on a line counts as in mesh_face.hpp: on an e-v surface from the foot of the perpendicular from the reference point, on a
// v-e surface from the origin. On a circle it is psi, the angle from the beginning of the patch's quadrant; on that of a concave arc
// it counts clockwise, and the circle's points are opposite to its normals.
#pragma once
#include <cmath>
#include <numbers>

#include "cfree/contact/contact_curve.hpp"

namespace cfree {

// An angle from the beginning of a quadrant, at most half a turn from its middle.
inline double in_quadrant(double psi) {
    using std::numbers::pi;
    return 0.25 * pi + std::remainder(psi - 0.25 * pi, 2 * pi);
}

// Direction of the point from the centre of a circle of radius rho at which t is 0 on its quadrant.
inline double begin_of(int quadrant, double rho) { return 0.5 * std::numbers::pi * (rho < 0 ? quadrant - 1 : quadrant); }

// a + b cos + c sin
struct Harmonic {
    double a = 0, b = 0, c = 0;
    double at(double phi) const;
};

// Curve of a face: its position at an angle, and bounds between two.
class RoundCurve {
public:
    RoundCurve() = default;
    RoundCurve(const Places& places, const Feature& on, const Feature& other, double from, double to);
    double position(double phi) const;
    // Position and its derivatives, which are large where the curve begins like a square root.
    struct Motion {
        double s, velocity, acceleration;
    };
    Motion motion(double phi) const;
    // Bound of the difference in position of the curve and its chord between two angles.
    double bow(double from, double to) const;

private:
    enum class Form { still, turning, line, on_line, on_circle };
    Motion root_at(double phi) const;  // half of the chord, on a circle over its radius; 0 where the surfaces touch
    double bow_of_line(double from, double to) const;
    void join_branches();
    void meet_on_line(const Places& places, const Feature& on, const Feature& other);
    void meet_on_circle(const Places& places, const Feature& on, const Feature& other, double from, double to);

    Form form = Form::still;
    double start = 0;             // position, at phi = 0 if it is turning
    int branch = 0;
    double inside = 0;            // an angle between the ends
    // on a line: its middle and the height of the circle's centre; on a circle: delta, |n|^2, and n x n' if n is of a circle
    Harmonic middle, height, delta, square, turn;
    double radius = 0;            // on a line: of the other circle; on a circle: its own
    double other_radius = 0;      // of a circle that meets this one
    bool meets_line = false;      // true on a circle that meets a line
    Complex still = 0, moving = 0;  // n = still + exp(i phi) moving
    double begin = 0, side = 1;   // direction from which psi counts; -1 if it counts clockwise
    bool is_equal = false;        // circles of one radius that coincide at the angle `meeting`
    double meeting = 0;
    // two lines
    ContactCurve curve;
    Complex origin = 0, direction = 0;
    bool is_saddle = false;
};

}  // namespace cfree

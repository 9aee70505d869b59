// Scenes and poses from words: what a page has made of a file, every number as it is written there.
//
//   robot ring x y x y .. ring ..   obstacle ring ..   workspace ring ..   bounds x0 y0 x1 y1   clearance r
//
// A round shape has rings `circle x y radius` or `path x y ..`, where `arc x y about x y left` or `right`, and `conjugate x y` after it, and `arc x y through x y`
// may stand for points; or `grown radius` after polygons.
#pragma once
#include <string_view>

#include "cfree/planning/driving.hpp"
#include "cfree/planning/rational_pose.hpp"
#include "cfree/scene/features.hpp"
#include "rounds.hpp"

namespace cfree {

// Throws std::invalid_argument, which says what is wrong where.
GivenScene scene_of(std::string_view words);
void refuse_range(const SceneShapes& shapes);
// "x y tau", tau a rational or "inf".
RationalPose pose_of(std::string_view words);
std::string words_of(const RationalPose& pose);
// "car left right x y tau both", or "forward" at the end: least radii, axle point, heading; "differential x y tau".
GivenVehicle vehicle_of(std::string_view words);
// "short sideways backward turning", three factors, or "clear" in place of the first word; nothing in an empty text.
struct Wishes {
    bool is_clear = false;
    double sideways = 1, backward = 1, turning = 1;
};
Wishes wishes_of(std::string_view words);
// Half of an angle in radians, within 2^-20 or, if fine, about a double's rounding; right angles are exact.
HalfAngle half_angle_of(double theta, bool fine);

}  // namespace cfree

// Slides from a pose in two contacts: the rational curve that keeps both; theory, "Motions".
#pragma once
#include <map>
#include <mutex>

#include "cfree/collision/motion_checker.hpp"
#include "cfree/planning/rational_pose.hpp"

namespace cfree {

// After a turn by 2 atan(t), t from 0 to tau, the reference point has moved by (x, y) / d, in the user's units: polynomials
// in t, the constant first.
struct ContactSlide {
    RationalPose from, to;
    std::array<Feature, 2> contacts;
    std::array<Int, 5> x, y, d;
    Ratio tau;
    Slide motion(const Scene& scene) const;
};

// Slide along two contacts of a pose; it need not be free. Nothing if a contact is not one of the scene's own features, or if
// the lines become parallel or do not meet at the pose. Also nothing if Bernstein coefficients do not prove that the points
// of contact stay within their edges: shorter slides may exist.
std::optional<ContactSlide> slide_along(const Scene& scene, const RationalPose& pose, const Feature& first, const Feature& last,
                                        const Ratio& tau);

// Free slide from a pose to another, along a contact's surface and a curve on it, whose name stands for all edges on its
// line.
std::optional<ContactSlide> free_slide(const Scene& scene, const MotionChecker& checker, const RationalPose& from,
                                       const RationalPose& to, const Feature& contact, const Feature& curve);

// Free slides, by the poses that they join. Several threads may call this.
class FoundSlides {
public:
    void add(ContactSlide slide);
    // Slides that join neighbours on a path, in either direction.
    std::vector<ContactSlide> along(const std::vector<RationalPose>& way) const;

private:
    mutable std::mutex lock;
    std::map<std::pair<RationalPose::Key, RationalPose::Key>, ContactSlide> found;
};

}  // namespace cfree

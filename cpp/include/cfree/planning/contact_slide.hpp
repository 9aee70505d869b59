// Slides from a pose that is in two contacts: the rational curve on which both are kept; theory, "Motions".
#pragma once
#include <map>
#include <mutex>

#include "cfree/collision/motion_checker.hpp"
#include "cfree/planning/rational_pose.hpp"

namespace cfree {

// Turned by 2 atan(t), t from 0 to tau, the reference point is (x, y) / d from where it was, in the user's units: polynomials in
// t, the constant first.
struct ContactSlide {
    RationalPose from, to;
    std::array<Feature, 2> contacts;
    std::array<Int, 5> x, y, d;
    Ratio tau;
    Slide motion(const Scene& scene) const;
};

// Along two contacts that a pose is in; it need not be free. Nothing if a contact is not one of the scene's own features, the
// lines become parallel or do not meet at the pose, or Bernstein coefficients do not say that the points of contact stay within
// their edges: shorter slides may exist.
std::optional<ContactSlide> slide_along(const Scene& scene, const RationalPose& pose, const Feature& first, const Feature& last,
                                        const Ratio& tau);

// A free one from a pose to another, along a contact's surface and a curve on it, whose name stands for all edges on its line.
std::optional<ContactSlide> free_slide(const Scene& scene, const MotionChecker& checker, const RationalPose& from,
                                       const RationalPose& to, const Feature& contact, const Feature& curve);

// Free slides, by the poses that they join. Calls from several threads are fine.
class FoundSlides {
public:
    void add(ContactSlide slide);
    // Those that join neighbours on a way, in either direction.
    std::vector<ContactSlide> along(const std::vector<RationalPose>& way) const;

private:
    mutable std::mutex lock;
    std::map<std::pair<RationalPose::Key, RationalPose::Key>, ContactSlide> found;
};

}  // namespace cfree

// Exact tests of motions between rational poses.
#pragma once
#include "cfree/planning/contact_slide.hpp"
#include "cfree/planning/sheet.hpp"

namespace cfree {

using Poses = std::vector<RationalPose>;

class FreeMotions {
public:
    // Keeps references to all three; adds the slides that are found.
    FreeMotions(const Scene& of, const MotionChecker& by, FoundSlides& along) : scene(of), checker(by), slides(along) {}

    // True if the one motion from each pose to the next is free.
    bool join(const Poses& way) const;
    std::optional<Poses> first_free(std::initializer_list<Poses> ways) const;
    // True if there is one free motion to another pose on the same curve of a sheet.
    bool along_curve(const RationalPose& from, const RationalPose& to, const Sheet& sheet, std::size_t side) const;
    // Share of the vector, below 1, over which the translation is free; nothing if all of it is free.
    std::optional<Ratio> free_share(const RationalPose& from, const Ratio& dx, const Ratio& dy) const;

private:
    const Scene& scene;
    const MotionChecker& checker;
    FoundSlides& slides;
};

}  // namespace cfree

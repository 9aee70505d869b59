// Message at the time limit.
#include "cfree/planning/deadline.hpp"

#include "cfree/exact/ratio.hpp"

namespace cfree {

void Deadline::heed() const {
    if (is_over()) throw TooLate(text_of(seconds) + " seconds were not enough to compute the free space; give more");
}

}  // namespace cfree

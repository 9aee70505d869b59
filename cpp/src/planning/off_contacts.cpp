// Move off a contact like a free pose near by, by a half, a quarter, and so on of its offset; theory, "Separations".
#include "cfree/planning/off_contacts.hpp"

#include <algorithm>

#include "cfree/support/elementary.hpp"

namespace cfree {

namespace {

constexpr unsigned most_halvings = 10;
constexpr int most_passed = 16;  // free poses in a row to which no search leads

bool is_free(const RationalPose& pose, const FreeMotions& motions) { return motions.join({pose, pose}); }

struct Offset {
    Ratio x{0}, y{0};
    double length() const { return norm(nearest(x.n, x.d), nearest(y.n, y.d)); }
};

// Offset from a pose of contact to a free one of the same orientation, about as long as another offset.
Offset between(const RationalPose& contact, const RationalPose& free) {
    if (contact.half != free.half) return {};
    return {free.x - contact.x, free.y - contact.y};
}
Offset scaled(const Offset& d, double by) {
    const Ratio share = ratio_of(by);
    return {share * d.x, share * d.y};
}

// Bridge from a free pose over contacts to another free one. The first pose is off the first contact, the last one is off the
// last contact; the way in between is off both.
std::optional<Poses> bridge(const RationalPose& from, const Poses& contacts, const RationalPose& to, const FreeMotions& motions) {
    if (motions.join({from, to})) return Poses{from, to};
    if (contacts.empty()) return {};
    const Offset first = between(contacts.front(), from), last = between(contacts.back(), to);
    const double a = first.length(), b = last.length(), least = a > 0 && b > 0 ? std::min(a, b) : std::max(a, b);
    const Offset u = a > 0 ? scaled(first, least / a) : first, v = b > 0 ? scaled(last, least / b) : last;
    for (unsigned k = 1; k <= most_halvings; ++k) {
        const Ratio share{1, Int(1) << k};
        const auto way = [&](bool ends_too) {
            Poses found{from};
            for (std::size_t i = 0; i < contacts.size(); ++i) {
                const bool by_first = ends_too || i + 1 < contacts.size(), by_last = ends_too || i > 0;
                RationalPose q = contacts[i];
                if (by_first) q.x = q.x + share * u.x, q.y = q.y + share * u.y;
                if (by_last) q.x = q.x + share * v.x, q.y = q.y + share * v.y;
                found.push_back(q);
            }
            found.push_back(to);
            return found;
        };
        if (auto found = motions.first_free({way(false), way(true)})) return found;
    }
    return {};
}

}  // namespace

std::optional<Poses> off_contacts(const Poses& way, const FreeMotions& motions, const LocalSearch& search) {
    Poses found{way.front()};
    int passed = 0;
    for (std::size_t k = 1; k < way.size(); ++k) {
        Poses contacts;
        for (; k + 1 < way.size() && !is_free(way[k], motions); ++k) contacts.push_back(way[k]);
        auto part = bridge(found.back(), contacts, way[k], motions);
        if (!part && search) part = search(found.back(), way[k]);
        if (!part && (!search || k + 1 == way.size() || ++passed > most_passed)) return {};
        if (!part) continue;
        passed = 0;
        found.insert(found.end(), part->begin() + 1, part->end());
    }
    return found;
}

}  // namespace cfree

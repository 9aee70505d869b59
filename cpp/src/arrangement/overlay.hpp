// One contact patch in the arrangement: what its own pair leaves of it, cut by all other pairs.
//
// A pair is a polygon of the robot and one of the obstacles. First the own pillars are taken away: what is left bounds the set
// that the pair forbids. Then pillars of other pairs cut: areas inside get the pair's number, those outside go on to its next
// pillar. A pillar that only touches the surface along a curve cuts there, too: its edge is one of the arrangement.
#pragma once
#include <map>
#include <tuple>

#include "cfree/forbidden/trim.hpp"

namespace cfree {

// Which pairs hold an area of a sheet, in order: those inside of which it is, and those whose boundary it is as well, with the
// same side forbidden or the opposite one.
struct Holders {
    std::vector<Index> around, same, opposite;
    bool operator<(const Holders& o) const {
        return std::tie(around, same, opposite) < std::tie(o.around, o.same, o.opposite);
    }
};

class Overlay : public Trimmer {
public:
    using Trimmer::Trimmer;

    // From here on other pairs come; what is left now is what they cut.
    void begin();
    // What comes from here on belongs to this pair.
    void start(Index of);
    // A trapezoid of another patch on the same surface: this patch cedes it, or holds it with that pair.
    enum class With { ceded, same, opposite };
    void share(const Trapezoid& other, With how);
    bool is_empty() const { return pieces.empty(); }
    std::size_t size() const { return pieces.size(); }
    // Trapezoids of a patch, in order, and who holds each.
    void put(Index patch, std::vector<Trapezoid>& out, std::vector<Holders>& holders);
    // What the own pair leaves.
    void put_own(std::vector<Trapezoid>& out);

private:
    struct Piece {
        Area area;
        Index holders;
        bool is_in;  // its pair's number has been given
    };
    // What an area is cut into between two angles.
    struct Bit {
        Index from, lower, upper;
        bool is_in;
    };
    struct Touch {
        Span span;
        Index curve;
    };
    void take(const Band& band) override;
    void pass(const State& state, const Span& span) override;
    void meet(const State& state, Index event) override;
    void note_touch(const Overlap& x);
    void touch(const Touch& at);
    template <class Into>
    bool cut(const Band& band, bool along_curve, Into&& into);
    bool split(const Piece& piece, const Band& band, bool along_curve, std::vector<Bit>& bits);
    Index with(Index holders, std::vector<Index> Holders::* list);
    bool vanishes(Index s, Index v) const;
    Index named(const Feature& feature, const Sample& at);
    void cut_at_angle(Index event);
    void join();

    bool has_begun = false;
    Index pair = -1;
    std::vector<Piece> pieces, cut_up;
    std::vector<Holders> all{{}};
    std::map<std::array<Index, 3>, Index> added;  // holders and what is added to them
    std::vector<Touch> touches;                   // of the own pair
    std::vector<Index> grazed;   // angles at which a pillar covers nothing between two at which it does
    std::vector<Index> touched;  // at which one only touches a piece in a point of its rim
};

}  // namespace cfree

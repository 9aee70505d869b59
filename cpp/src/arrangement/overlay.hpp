// One contact patch in the arrangement: the rest after its own pair, cut by all other pairs.
//
// A pair is a polygon of the robot and one of the obstacles. First the own pillars are subtracted: the rest bounds the set
// that the pair forbids. Then pillars of other pairs cut: areas inside get the pair's number, those outside go on to its next
// pillar. A pillar that only touches the surface along a curve also cuts there: its edge belongs to the arrangement.
#pragma once
#include <map>
#include <tuple>

#include "cfree/forbidden/trim.hpp"

namespace cfree {

// Pairs of an area of a sheet, in order: those that overlap in it, and the other pairs whose boundary contains it, with the
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

    // Begin with the other pairs, which cut the areas left now.
    void begin();
    // Start a pair, to which all following pillars belong.
    void start(Index of);
    // A trapezoid of another patch on the same surface: this patch cedes it, or holds it with that pair.
    enum class With { ceded, same, opposite };
    void share(const Trapezoid& other, With how);
    bool is_empty() const { return pieces.empty(); }
    std::size_t size() const { return pieces.size(); }
    // Append the trapezoids of a patch, in order, and the holders of each.
    void put(Index patch, std::vector<Trapezoid>& out, std::vector<Holders>& holders);
    // Append the areas that the own pair leaves.
    void put_own(std::vector<Trapezoid>& out);

private:
    struct Piece {
        Area area;
        Index holders;
        bool is_in;  // it has its pair's number
    };
    // Part of an area between two angles.
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
    std::map<std::array<Index, 3>, Index> added;  // holders and additions to them
    std::vector<Touch> touches;                   // touches of the own pair
    std::vector<Index> grazed;   // angles at which a covering pillar covers nothing
    std::vector<Index> touched;  // angles at which one only touches a piece in a point of its rim
};

}  // namespace cfree

// Match five sides by the names of their curves; theory, "Closed surfaces".
#include "forbidden/meetings_of_three.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "forbidden/partners.hpp"

namespace cfree {

namespace {

class MeetingOfThree {
public:
    static constexpr std::size_t size = 5;  // sides
    MeetingOfThree(const Scene& s, Junction& j, const CriticalAngle::Name& met) : name(met), scene(s), at(j) {}

    const CriticalAngle::Name name;
    bool read(const SideAtAngle& side);
    bool match();
    bool is_apart(const MeetingOfThree& other) const;
    void add(const Whole& whole, Parts& parts) const;

private:
    struct Level {
        const SideAtAngle* side;
        Code own;
        std::array<Code, 2> ends;  // names of its curves
    };
    // The sides of one surface: one of no length, or one below the angle and one above between the same two places.
    struct Line {
        std::array<const Level*, 2> levels{};  // the second may be null
        std::array<LinePlace<Junction>, 2> ends;
    };
    bool add_to_line(const Level& level);
    bool find_helix();
    bool is_there(const Level& on, Code curve) const;
    bool match(Line& line);

    const Scene& scene;
    Junction& at;
    std::array<Level, size> levels;
    Code helix = 0;  // 0: three surfaces meet in a point of none of their helices
    std::array<Line, 3> lines;  // in the order of their first levels
    std::size_t read_levels = 0, found = 0;
};

// Take a side; false if there are too many, or of too many surfaces.
bool MeetingOfThree::read(const SideAtAngle& side) {
    if (read_levels == levels.size()) return false;
    Level& level = levels[read_levels++];
    level = {&side, code(scene, side.on.contact), {code(scene, side.lower), code(scene, side.upper)}};
    return add_to_line(level);
}

bool MeetingOfThree::add_to_line(const Level& level) {
    for (std::size_t k = 0; k < found; ++k) {
        auto& on_it = lines[k].levels;
        if (on_it[0]->own != level.own) continue;
        if (on_it[1] || on_it[0]->side->is_above == level.side->is_above) return false;
        on_it[1] = &level;
        return true;
    }
    if (found == lines.size()) return false;
    lines[found++].levels[0] = &level;
    return true;
}

// The meeting is that of the three surfaces, or that of a helix of two of them with the third.
bool MeetingOfThree::find_helix() {
    std::array<Code, 3> own{};
    for (std::size_t k = 0; k < own.size(); ++k) own[k] = lines[k].levels[0]->own;
    const auto is_own = [&](Code x) { return std::find(own.begin(), own.end(), x) != own.end(); };
    if (name[0] != 0) return std::all_of(name.begin(), name.end(), is_own);
    if (is_own(name[1]) == is_own(name[2])) return false;
    helix = name[is_own(name[1]) ? 2 : 1];
    return std::all_of(lines.begin(), lines.end(), [&](const Line& line) {
        const Level& level = *line.levels[0];
        const auto ends_at = [&](int end) { return code(scene, end_helix(scene, level.side->on.contact, end)) == helix; };
        return level.own == name[1] || level.own == name[2] || ends_at(0) || ends_at(1);
    });
}

// True if a curve is certainly where they meet.
bool MeetingOfThree::is_there(const Level& on, Code curve) const {
    if (curve == on.own) return false;
    const bool is_through = helix == 0 || on.own == name[1] || on.own == name[2];  // each of the others is a curve on it
    if (!is_through) return curve == name[1] || curve == name[2];                  // the helix, and the surface that it meets
    return std::any_of(lines.begin(), lines.end(), [&](const Line& line) { return line.levels[0]->own == curve; });
}

// True if the meeting has all its sides, and they are matched.
bool MeetingOfThree::match() {
    if (read_levels < levels.size() || found < lines.size() || !find_helix()) return false;
    const auto contact = [&](int k) -> const Feature& { return lines[k].levels[0]->side->on.contact; };
    for (const int k : {0, 1, 2})
        if (at.turn(contact(k), contact((k + 1) % 3)) == 0) return false;  // their lines are parallel
    return std::all_of(lines.begin(), lines.end(), [&](Line& line) { return match(line); });
}

bool MeetingOfThree::match(Line& line) {
    const auto& [x, y] = line.levels;
    if (!y) return is_there(*x, x->ends[0]) && is_there(*x, x->ends[1]);
    const bool same_low = x->ends[0] == y->ends[0], same_high = x->ends[1] == y->ends[1];
    const std::size_t other = same_low ? 1 : 0;
    if (same_low == same_high || !is_there(*x, x->ends[other]) || !is_there(*x, y->ends[other])) return false;
    const Feature& contact = x->side->on.contact;
    const auto place = [&](const Feature& curve, Code own) { return LinePlace<Junction>::read(contact, {curve, own, contact}, at); };
    line.ends = {place(x->side->lower, x->ends[0]), place(x->side->upper, x->ends[1])};
    return line.ends[0].t.hi < line.ends[1].t.lo;
}

// True if no side of another meeting is on the line of one of this one.
bool MeetingOfThree::is_apart(const MeetingOfThree& other) const {
    const auto are_apart = [&](const Line& x, const Line& y) {
        if (!x.levels[1] || !y.levels[1]) return true;
        const Feature &p = x.levels[0]->side->on.contact, &q = y.levels[0]->side->on.contact;
        if (at.turn(p, q) != 0) return true;
        const Interval offset = at.offset(p, q);
        return offset.lo > 0 || offset.hi < 0;
    };
    return std::all_of(lines.begin(), lines.end(), [&](const Line& x) {
        return std::all_of(other.lines.begin(), other.lines.end(), [&](const Line& y) { return are_apart(x, y); });
    });
}

void MeetingOfThree::add(const Whole& whole, Parts& parts) const {
    for (const Line& line : lines) {
        const auto& [x, y] = line.levels;
        if (!y || (!whole[x->side->trapezoid] && !whole[y->side->trapezoid])) continue;
        pair_on_piece(level_side(*x->side), level_side(*y->side), line.ends[0], line.ends[1], at, parts);
    }
}

}  // namespace

bool glue_meetings_of_three(const Scene& scene, const Whole& whole, std::span<const SideAtAngle> sides, Junction& at, Parts& parts) {
    constexpr std::size_t most = 4;
    if (sides.size() % MeetingOfThree::size != 0 || sides.size() > most * MeetingOfThree::size) return false;
    std::array<std::optional<MeetingOfThree>, most> meetings;
    const auto end = meetings.begin() + static_cast<std::ptrdiff_t>(sides.size() / MeetingOfThree::size);
    for (const SideAtAngle& side : sides) {
        const auto name = side.angle().name(scene);
        const auto found = std::find_if(meetings.begin(), end, [&](const auto& x) { return !x || x->name == name; });
        if (found == end) return false;
        if (!*found) found->emplace(scene, at, name);
        if (!(*found)->read(side)) return false;
    }
    for (auto x = meetings.begin(); x != end; ++x)
        if (!*x || !(*x)->match() || !std::all_of(meetings.begin(), x, [&](const auto& y) { return (*x)->is_apart(*y); })) return false;
    for (auto x = meetings.begin(); x != end; ++x) (*x)->add(whole, parts);
    return true;
}

}  // namespace cfree

// Match five sides by the names of their curves; theory, "Closed surfaces".
#include "forbidden/meeting_of_three.hpp"

#include <algorithm>
#include <array>

namespace cfree {

namespace {

struct Level {
    const SideAtAngle* side;
    Code own;
    std::array<Code, 2> ends;  // names of its curves
};

// The sides of one surface: one of no length, or one below the angle and one above between the same two places.
struct Line {
    std::array<const Level*, 2> levels{};  // the second may be null
    std::array<Spot, 2> ends;
};

class Meeting {
public:
    Meeting(const Scene& s, const Whole& w, Junction& j) : scene(s), whole(w), at(j) {}

    bool read(std::span<const SideAtAngle> sides);
    bool match();
    void add(Parts& parts) const;

private:
    bool add_to_line(const Level& level);
    bool find_helix();
    bool is_there(const Level& on, Code curve) const;
    bool cross(const Feature& x, const Feature& y) const;
    bool match(Line& line);

    const Scene& scene;
    const Whole& whole;
    Junction& at;
    std::array<Level, 5> levels;
    CriticalAngle::Name name{};
    Code helix = 0;  // 0: three surfaces meet in a point of none of their helices
    std::array<Line, 3> lines;  // in the order of their first levels
    std::size_t found = 0;
};

// Read the sides; false unless all name the same meeting, and are on three surfaces.
bool Meeting::read(std::span<const SideAtAngle> sides) {
    if (sides.size() != levels.size()) return false;
    for (std::size_t k = 0; k < levels.size(); ++k) {
        const SideAtAngle& side = sides[k];
        const auto met = side.angle().name(scene);
        if (k == 0) name = met;
        if (met != name) return false;
        levels[k] = {&side, code(scene, side.on.contact), {code(scene, side.lower), code(scene, side.upper)}};
        if (!add_to_line(levels[k])) return false;
    }
    return found == lines.size() && find_helix();
}

bool Meeting::add_to_line(const Level& level) {
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
bool Meeting::find_helix() {
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
bool Meeting::is_there(const Level& on, Code curve) const {
    if (curve == on.own) return false;
    const bool is_through = helix == 0 || on.own == name[1] || on.own == name[2];  // each of the others is a curve on it
    if (!is_through) return curve == name[1] || curve == name[2];                  // the helix, and the surface that it meets
    return std::any_of(lines.begin(), lines.end(), [&](const Line& line) { return line.levels[0]->own == curve; });
}

// True if the lines of two surfaces are certainly not parallel.
bool Meeting::cross(const Feature& x, const Feature& y) const {
    if (x.kind != y.kind) return at.turn(x, y) != 0;
    const Shape& shape = x.kind == Kind::vertex_edge ? scene.obstacles : scene.robot;
    const auto edge = [](const Feature& f) { return f.kind == Kind::vertex_edge ? f.obstacle : f.robot; };
    return shape.direction[edge(x)] != shape.direction[edge(y)];
}

bool Meeting::match() {
    const auto contact = [&](int k) -> const Feature& { return lines[k].levels[0]->side->on.contact; };
    if (!cross(contact(0), contact(1)) || !cross(contact(0), contact(2)) || !cross(contact(1), contact(2))) return false;
    return std::all_of(lines.begin(), lines.end(), [&](Line& line) { return match(line); });
}

bool Meeting::match(Line& line) {
    const auto& [x, y] = line.levels;
    if (!y) return is_there(*x, x->ends[0]) && is_there(*x, x->ends[1]);
    const bool same_low = x->ends[0] == y->ends[0], same_high = x->ends[1] == y->ends[1];
    const std::size_t other = same_low ? 1 : 0;
    if (same_low == same_high || !is_there(*x, x->ends[other]) || !is_there(*x, y->ends[other])) return false;
    const Feature& contact = x->side->on.contact;
    line.ends = {Spot{x->side->lower, x->ends[0], contact}, Spot{x->side->upper, x->ends[1], contact}};
    return at.range(contact, line.ends[0]).hi < at.range(contact, line.ends[1]).lo;
}

void Meeting::add(Parts& parts) const {
    for (const Line& line : lines) {
        const auto& [x, y] = line.levels;
        if (!y || (!whole[x->side->trapezoid] && !whole[y->side->trapezoid])) continue;
        parts.begin_edge();
        const auto add_level = [&](const SideAtAngle& of) {
            const Side side = of.is_above ? Side::first : Side::last;
            return parts.add(of.trapezoid, side, false, at.value(of.on.contact, line.ends[is_forwards(side) ? 0 : 1]));
        };
        const Index first = add_level(*x->side);
        parts.pair(first, add_level(*y->side));
    }
}

}  // namespace

bool glue_meeting_of_three(const Scene& scene, const Whole& whole, std::span<const SideAtAngle> sides, Junction& at, Parts& parts) {
    Meeting meeting(scene, whole, at);
    if (!meeting.read(sides) || !meeting.match()) return false;
    meeting.add(parts);
    return true;
}

}  // namespace cfree

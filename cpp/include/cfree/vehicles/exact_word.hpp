// Words made rational: they end exactly at their goal; theory, "Vehicles", Lemmas 1 to 3.
//
// Headings between the pieces are rational, so that a piece moves the axle point by a multiple of a rational vector: along
// w = h g, the product of the half angles of the headings h before and g after it. Two multiples solve a linear system.
#pragma once
#include <optional>

#include "cfree/vehicles/reeds_shepp.hpp"
#include "cfree/vehicles/vehicle.hpp"

namespace cfree {

// A piece of a word: travel of the axle point, negative backward; and its turn, less than half a turn.
struct Piece {
    double travel, turn;
};
// Axle poses with the pieces between them; all have one unit.
struct ExactWord {
    std::vector<Configuration> joints;
    std::vector<Piece> pieces;
};

inline constexpr double most_turn_of_piece = 2.625;  // in radians: less than half a turn
// Slack of the radius of words in doubles: their rational form is accepted if no radius is less than the vehicle's.
inline constexpr double slack = 1 + 0x1p-16;

// Rational form of a word; the lengths are in radii of `radius`, in the doubles of shapes. Nothing if it has none.
std::optional<ExactWord> exact_word(const Vehicle& vehicle, int shift, const Configuration& from, const Configuration& to,
                                    const Word& word, double radius);
// Two arcs in one gear, nearly straight; nothing if a radius is too small.
std::optional<ExactWord> biarc(const Vehicle& vehicle, int shift, const Configuration& from, const Configuration& to);
// Five pieces of a car that reverses, at any scale: nothing only if the turn is half a turn, or the goal far to the side.
std::optional<ExactWord> steer(const Vehicle& vehicle, int shift, const Configuration& from, const Configuration& to);

// Words of a differential drive.
// Turn, drive on nearly straight, turn; forward or back.
std::optional<ExactWord> turn_drive_turn(const Vehicle& vehicle, int shift, const Configuration& from, const Configuration& to,
                                         bool back);
// One arc, and a turn before it or after it.
std::optional<ExactWord> arc_and_turn(const Vehicle& vehicle, int shift, const Configuration& from, const Configuration& to,
                                      bool turn_first);
// Turn, straight, turn, straight, turn; the two directions are `angle` beside the middle heading.
std::optional<ExactWord> zigzag(const Vehicle& vehicle, int shift, const Configuration& from, const Configuration& to, double angle);

}  // namespace cfree

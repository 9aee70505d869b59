// Words of Reeds and Shepp, and of Dubins, in doubles: paths of arcs of radius 1 and straight lines from (0, 0, 0).
//
// J. A. Reeds, L. A. Shepp, Optimal paths for a car that goes both forwards and backwards, 1990, formulas 8.1 to 8.11.
#pragma once
#include <array>
#include <vector>

namespace cfree {

// Pieces: their kind, 1 for a turn to the left, -1 to the right, 0 straight; and their length, negative for going back.
struct Word {
    int count = 0;
    std::array<signed char, 5> kind{};
    std::array<double, 5> length{};
    double total() const;
    int cusps() const;
};

// Up to 48 words that lead to a pose; the shortest path is among them.
void reeds_shepp_words(double x, double y, double phi, std::vector<Word>& out);
// Up to six words without going back; an arc may be nearly a whole turn.
void dubins_words(double x, double y, double phi, std::vector<Word>& out);
// The shortest of the words of Reeds and Shepp.
Word shortest_word(double x, double y, double phi);

}  // namespace cfree

// Words of vehicles: in doubles they lead to the goal; exact ones end there, with no radius below the vehicle's.
#include "cfree/vehicles/exact_word.hpp"

#include <cmath>

#include "cfree/search/random.hpp"
#include "check.hpp"

using namespace cfree;

static Place end_of(const Word& word) {
    Place q{0, 0, 0};
    for (int k = 0; k < word.count; ++k) {
        const double l = word.length[static_cast<std::size_t>(k)];
        const int kind = word.kind[static_cast<std::size_t>(k)];
        if (kind == 0) {
            q.x += l * std::cos(q.theta), q.y += l * std::sin(q.theta);
            continue;
        }
        const double theta = q.theta + kind * l;
        q.x += kind * (std::sin(theta) - std::sin(q.theta)), q.y -= kind * (std::cos(theta) - std::cos(q.theta));
        q.theta = theta;
    }
    return q;
}

static Configuration axle(double x, double y, double theta) { return Grid{0, 30, 30}.exact(x, y, theta); }

static bool is_same(const Configuration& a, const Configuration& b) {
    return a.x * b.unit == b.x * a.unit && a.y * b.unit == b.y * a.unit && a.hx * b.hy == a.hy * b.hx;
}

int main() {
    Random random(1);
    const auto any = [&](double size) { return size * (2 * random() - 1); };
    Vehicle car;
    car.left = {2, 1}, car.right = {3, 1}, car.radius = 3;
    Vehicle drive;
    drive.turns_in_place = true;
    for (int n = 0; n < 300; ++n) {
        const double size = std::pow(10.0, any(2));
        const double x = any(size), y = any(size), theta = any(3);
        std::vector<Word> words;
        reeds_shepp_words(x, y, theta, words);
        CHECK(words.size() > 3);
        for (const Word& word : words) {
            const Place q = end_of(word);
            CHECK(std::abs(q.x - x) + std::abs(q.y - y) + std::abs(std::remainder(q.theta - theta, 6.283185307179586)) < 1e-9 * (1 + size));
        }
        const Configuration a = axle(any(9), any(9), any(3)), b = axle(a.px + any(size), a.py + any(size), a.theta + any(2));
        const Place local = seen_from(a, b);
        const Word word = shortest_word(local.x / (3 * slack), local.y / (3 * slack), local.theta);
        int found = 0;
        for (const auto& exact : {exact_word(car, 0, a, b, word, 3 * slack), steer(car, 0, a, b)}) {
            if (!exact) continue;
            ++found;
            CHECK(is_same(exact->joints.front(), a) && is_same(exact->joints.back(), b));
            for (const Piece& p : exact->pieces)
                if (p.turn != 0) CHECK(std::abs(p.travel / p.turn) >= (p.travel * p.turn > 0 ? 2 : 3) * (1 - 1e-12));
        }
        CHECK(found > 0);
        for (const bool back : {false, true}) {
            const auto exact = turn_drive_turn(drive, 0, a, b, back);
            CHECK(exact && is_same(exact->joints.back(), b));
        }
    }
    return failures > 0;
}

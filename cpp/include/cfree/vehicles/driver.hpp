// A vehicle's ways from pose to pose, proved free; along a whole path; and shorter ones.
#pragma once
#include <functional>
#include <span>

#include "cfree/search/motion_guess.hpp"
#include "cfree/search/random.hpp"
#include "cfree/search/way.hpp"
#include "cfree/vehicles/boxes.hpp"
#include "cfree/vehicles/exact_word.hpp"

namespace cfree {

// Costs of driving: factor of going back; of a change of gear, of another stop, and of a radian turned in place, as lengths.
struct Dues {
    double backward = 1, cusp = 0, stop = 0, in_place = 0;
};

// Travel in one gear: 1, -1, or 0 for none; with the curvature at the end that is joined.
struct Run {
    int gear = 0;
    double length = 0, curvature = 0;
};

// A word from one axle pose to another.
struct Leg {
    ExactWord word;
    double from = 0, to = 0;  // marks of its ends
    double cost = 0;
    Run first, last;          // up to its first change of gear, and from its last
    bool changes = false;
    const Configuration& begin() const { return word.joints.front(); }
    const Configuration& end() const { return word.joints.back(); }
};
using Legs = std::vector<Leg>;

// Words between two poses.
class Driver {
public:
    // The way has what is asked of motions; size: the robot's length.
    Driver(Vehicle vehicle, Way way, MotionGuess seems, const Dues& dues, double size);

    // The cheapest free word of at most `tries`, cheaper than `most`; with Lemma 3's or more zigzags if it is to be found at
    // any scale.
    std::optional<Leg> join(const Configuration& a, const Configuration& b, double from, double to, double most, int tries,
                            bool at_any_scale = false);
    // A word in doubles from pose to pose, made exact, if it is free.
    std::optional<Leg> made(const Configuration& a, const Configuration& b, double from, double to, const Word& word);
    // A pose of few bits.
    Configuration rounded(const Place& axle, int bits) const;
    double cost_of(const Word& word) const;
    double total(std::span<const Leg> legs, Run run = {}, const Run& beyond = {}) const;
    // Mark of the path's nearest pose.
    double mark_of(const Configuration& axle, double from, double to) const;
    // True if a pose, or those of a word, seem free.
    bool is_free(const Place& axle) const { return seems(vehicle.robot_of(axle), vehicle.robot_of(axle)); }
    bool seems_free(const Place& from, const Word& word) const;
    bool seems_free(const Place& from, const Place& to) const { return seems(vehicle.robot_of(from), vehicle.robot_of(to)); }

    const Vehicle vehicle;
    const Way way;
    const Dues dues;
    const double size;
    double radius() const { return vehicle.radius * slack; }
    long long looked = 0;  // words tried

private:
    struct Candidate {
        double cost;
        Word word;
        std::optional<ExactWord> exact;
    };
    std::optional<Leg> leg(ExactWord word, double from, double to) const;
    bool seems_free(const ExactWord& word) const;
    bool proved(const ExactWord& word, double from, double to) const;
    void set_costs(Leg& leg) const;
    // Cost of going on in one gear where the curvature changes: a car stands while its wheels turn.
    double steering(double from, double to) const;
    // Further cost of a run between two cusps, if it is short.
    double short_run(double length) const;
    void car_words(const Configuration& a, const Configuration& b);
    void drive_words(const Configuration& a, const Configuration& b, bool at_any_scale);

    MotionGuess seems;
    std::vector<Candidate> candidates;
    std::vector<Word> words;
};

// The words along a path of robot poses, or as far as they got.
struct Followed {
    Legs legs;
    bool is_whole = false;
    double share = 0;  // of the path
};
// The path is halved until words join its poses; at most about so many words are tried.
Followed follow(Driver& driver, const Marked& path, long long most);

// Words of a vehicle without reverse gear, by two trees of poses in doubles, from the start and to the goal; half of the
// poses are near the path. The chain is made exact when the trees meet. Nothing if they do not.
std::optional<Legs> search_forward(Driver& driver, const Marked& path, const Area& area, std::uint64_t seed, int poses);

// Words of a tree of poses from the start, with at most one in each box from which the goal may be reached, those of fewest
// steps first. The boxes are of the way back from the goal, in the user's units; each has `unit` of the driver's.
std::optional<Legs> search_in_boxes(Driver& driver, const Marked& path, const Boxes& boxes, double unit, int poses);

// Shorter words between the same ends.
class Shortening {
public:
    Shortening(Driver driver, Legs legs, std::uint64_t seed);
    // One pass that joins far poses, then so many attempts by turns: random words, and windows where these gain nothing.
    void join_far();
    void run(int rounds);
    double cost() const { return driver.total(path); }
    const Legs& legs() const { return path; }
    const Driver& by() const { return driver; }
    int without_gain() const { return idle; }
    int cusps() const;

private:
    bool attempt();
    bool window();
    bool replace(std::size_t i, std::size_t j, Legs fresh);
    double gauss();
    std::span<const Leg> part(std::size_t i, std::size_t j) const { return {path.data() + i, j - i}; }
    Run run_before(std::size_t i) const;
    Run run_after(std::size_t j) const;

    Driver driver;
    Legs path;
    Random random;
    int idle = 0;
};

}  // namespace cfree

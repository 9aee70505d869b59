// Layout in columns: their number and shift lead to the fewest triangles to first order. Their distance follows, and the
// bounds themselves correct the height of triangles.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "cfree/mesh/layout.hpp"
#include "cfree/support/lookout.hpp"

namespace cfree {

namespace {

constexpr double wall_cost = 0.25;   // measured extra triangles of a column at each side
constexpr double corner_cost = 6;   // and of the face at its corners
constexpr double least_gap = 0.03;  // gap of points from the face's sides, in steps
constexpr double longest = 1.6;     // step, in units of the lattice
constexpr double behind = 0.7;      // share of the sum of both gaps beside it; a column's end with more is not next to the side
constexpr double usual = 2;         // distance of columns, in the same units
constexpr int most_columns = 100, levels = 33, halvings = 10;

struct Choice {
    int columns = 0;
    double shift = 0.5;  // shift of a column against the one before, in steps
    bool coarse = false;  // true if the curves need points between those of the columns
    double triangles = 1e300;
};

// Greatest value up to a limit with a property that small values have.
template <class Holds>
double greatest(double limit, const Holds& holds) {
    if (holds(limit)) return limit;
    double good = 0, bad = limit;
    for (int k = 0; k < halvings; ++k) {
        const double middle = 0.5 * (good + bad);
        (holds(middle) ? good : bad) = middle;
    }
    return good;
}

class Columns {
public:
    Columns(const MeshFace& on, double most_error)
        : face(on), error(most_error), high(on.to - on.from), half(0.5 * on.height()) {}

    Layout run() {
        const Choice best = choose();
        if (best.columns == 0) return {};
        const double middle = 0.5 * (face.from + face.to);
        set_shares(best, widest(level(middle), best));
        const double fit = correction(best, [&](const Level& at) { return step(at, best); });
        return fit > 0 ? laid_out(best, fit) : Layout{};
    }

    // Layout with as few columns as possible for these steps.
    Layout run(const Wanted& wanted) {
        const auto at = some_levels();
        const auto steps = [&](const Level&) { return wanted.step; };
        for (int n = least_columns(at[1]); n <= most_columns; ++n) {
            Choice of{n, 0.5, false};
            of.shift = best_shift(at[1], wanted.step);
            const auto is_fine = [&](const Level& each) { return widest(each, of) >= wanted.step * (1 - 1e-9); };
            if (!std::all_of(at.begin(), at.end(), is_fine)) continue;
            set_shares(of, wanted.step);
            if (correction(of, steps) < 1) continue;
            of.triangles = corner_cost + 2 * n * (high / wanted.step + wall_cost);
            return laid_out(of, 1, &wanted);
        }
        return {};
    }

private:
    // The face at an angle: u = low + share * wide, its change, and the greatest steps on the curves.
    struct Level {
        double phi, low, wide, low_slope, wide_slope;
        std::array<double, 2> caps;
    };
    Level level(double phi) const {
        const double d = 1e-3 * high, a = std::max(face.from, phi - d), b = std::min(face.to, phi + d);
        const double low_slope = (low(b) - low(a)) / (b - a), wide_slope = (face.width_u(b) - face.width_u(a)) / (b - a);
        const std::array caps{rim_step(face, error, phi, 0), rim_step(face, error, phi, 1)};
        return {phi, low(phi), face.width_u(phi), low_slope, wide_slope, caps};
    }
    double low(double phi) const { return face.u(face.position(face.curves[0].at(phi), phi)); }
    double unit() const { return 2 * std::sqrt(error / face.scale()); }
    double cap(const Level& at, const Choice& of) const {
        return of.coarse ? std::min(high, longest * unit()) : std::min(at.caps[0], at.caps[1]);
    }

    // Place of a column at an angle: position, its change, and the largest form of an edge there.
    struct Place {
        double s, slope, room;
    };
    Place place(const Level& at, double share) const {
        const double s = face.s(at.low + share * at.wide), gradient = face.gradient(s);
        return {s, face.scale() * gradient * (at.low_slope + share * at.wide_slope), 4 * error * gradient};
    }

    // Share of the width at the last column if each is as far from the one before as edges between them allow.
    double reach(const Level& at, const Choice& of, double step, std::vector<double>* found = nullptr) const {
        const double up = of.shift * step, down = step - up;
        double share = 0;
        for (int i = 0; i < of.columns; ++i) {
            const Place p = place(at, share);
            double far = p.s, room = p.room;
            for (int k = 0; k < 2; ++k) {
                far = p.s + std::min(room / up - (p.slope + half) * up, room / down + (p.slope + half) * down);
                room = 0.5 * (p.room + 4 * error * face.gradient(far));
            }
            if (!(far > p.s)) return 0;
            share = (face.u(far) - at.low) / at.wide;
            if (found) found->push_back(share);
        }
        return share;
    }
    // Greatest step at which this many columns suffice.
    double widest(const Level& at, const Choice& of) const {
        double most = cap(at, of);
        for (const double share : {0.0, 0.5, 1.0}) {
            const Place p = place(at, share);
            most = std::min(most, std::sqrt(p.room / std::max(std::abs(p.slope + half), 1e-9)));
        }
        return greatest(most, [&](double step) { return reach(at, of, step) >= 1; });
    }

    // Greatest step for columns at their present places.
    double step(const Level& at, const Choice& of) const {
        return greatest(cap(at, of), [&](double t) {
            const double up = of.shift * t, down = up - t;
            Place before{};
            for (std::size_t i = 0; i < shares.size(); ++i) {
                const Place p = place(at, shares[i]);
                if (std::abs(t * t * (p.slope + half)) > p.room) return false;
                const double a = up * (p.s + p.slope * up - before.s + half * up);
                const double b = down * (p.s + p.slope * up - before.s - before.slope * t + half * down);
                if (i > 0 && std::max(std::abs(a), std::abs(b)) > 0.5 * (p.room + before.room)) return false;
                before = p;
            }
            return true;
        });
    }

    // The largest triangles with an edge (eta, 1) along the columns have x^2 - (2 + eta) x + eta = 0 and the shift 1 / x.
    double best_shift(const Level& at, double step) const {
        const Place middle = place(at, 0.5);
        const double lean = middle.slope + half, eta = std::min(1.0, step * step * std::abs(lean) / middle.room);
        const double x = 0.5 * (2 + eta + std::sqrt(4 + eta * eta));
        return lean > 0 ? 1 / x : 1 - 1 / x;
    }
    std::array<Level, 3> some_levels() const {
        return {level(face.from + high / 6), level(face.from + high / 2), level(face.to - high / 6)};
    }
    int least_columns(const Level& at) const { return 1 + static_cast<int>(at.wide / (2 * usual * unit())); }

    Choice choose() const {
        const auto at = some_levels();
        const bool is_bent = std::min(at[1].caps[0], at[1].caps[1]) < 0.95 * unit();
        Choice best;
        const int first = least_columns(at[1]);
        for (int n = first; n <= most_columns + 2 * first; ++n) {
            double least = 1e300;
            for (const bool coarse : {false, true}) {
                if (coarse && !is_bent) continue;
                Choice of{n, 0.5, coarse};
                for (int k = 0; k < 2; ++k) of.shift = best_shift(at[1], widest(at[1], of));
                of.triangles = corner_cost;
                for (const Level& each : at) {
                    const double t = widest(each, of);
                    double rate = 2 * n * (1 / t + wall_cost / high);
                    for (const double most : each.caps) {  // points of the curves for this face, or for its neighbours
                        const double parts = std::ceil(t / most - 1e-9);
                        rate += (parts - 1) / t + spare_point_cost * std::max(0.0, parts / t - 1 / most);
                    }
                    of.triangles += high / 3 * rate;
                }
                least = std::min(least, of.triangles);
                if (of.triangles < best.triangles) best = of;
            }
            if (least > 1.3 * best.triangles) break;
        }
        return best;
    }

    void set_shares(const Choice& of, double step) {
        shares.assign(1, 0);
        reach(level(0.5 * (face.from + face.to)), of, step, &shares);
        for (double& each : shares) each /= shares.back();
    }

    // Share of the steps that the bounds allow.
    template <class Steps>
    double correction(const Choice& of, const Steps& steps) const {
        double fit = 1;
        for (const double share : {0.2, 0.5, 0.8}) {
            const Level at = level(face.from + share * high);
            const double first = steps(at);
            for (int k = 0; k < halvings; ++k) {
                const double most = excess(at, of, fit * first);
                if (most <= 1) break;
                fit *= std::clamp(0.998 / most, 0.3, 1.0);
            }
        }
        return fit;
    }
    double excess(const Level& at, const Choice& of, double step) const {
        const auto point = [&](std::size_t i, double steps) {
            const double phi = std::min(at.phi + steps * step, face.to);
            MeshPoint p = face.point(face.s(low(phi) + face.width_u(phi) * shares[i]), phi);
            if (i == 0) p.inward[0] = 0;
            if (i + 1 == shares.size()) p.inward[1] = 0;
            return p;
        };
        double most = 0;
        for (std::size_t i = 0; i + 1 < shares.size(); ++i) {
            const MeshPoint a = point(i, 0), b = point(i, 1), c = point(i + 1, of.shift), d = point(i + 1, 1 + of.shift);
            if (i > 0 || step <= at.caps[0]) most = std::max(most, face.excess({&a, &c, &b}));
            if (i + 2 < shares.size() || step <= at.caps[1]) most = std::max(most, face.excess({&c, &d, &b}));
        }
        return most;
    }

    // Ends without those that are behind the ends beside them.
    static std::vector<Layout::Point> in_front(const std::vector<Layout::Point>& ends, double phi) {
        std::vector<Layout::Point> chain;
        const auto gap = [&](std::size_t of) { return std::abs(ends[of].phi - phi); };
        for (std::size_t k = 0; k < ends.size(); ++k)
            if (k == 0 || k + 1 == ends.size() || gap(k) < behind * (gap(k - 1) + gap(k + 1))) chain.push_back(ends[k]);
        return chain;
    }

    Layout laid_out(const Choice& of, double fit, const Wanted* wanted = nullptr) const {
        // steps from the first side on, by angles
        std::array<double, levels> steps{};
        double before = 0;
        for (int k = 0; k < levels; ++k) {
            const double rate = 1 / (wanted ? wanted->step : fit * step(level(face.from + high * k / (levels - 1)), of));
            if (k > 0) steps[k] = steps[k - 1] + 0.5 * (before + rate) * high / (levels - 1);
            before = rate;
        }
        const double whole = steps.back();
        const auto angle = [&](double v) {
            const auto after = std::upper_bound(steps.begin(), steps.end(), v) - steps.begin();
            const auto k = std::clamp<std::ptrdiff_t>(after, 1, levels - 1);
            const double part = (v - steps[k - 1]) / (steps[k] - steps[k - 1]);
            return face.from + high * (static_cast<double>(k) - 1 + part) / (levels - 1);
        };
        const double phase = wanted ? (wanted->first - face.from) / wanted->step - wanted->curve * of.columns * of.shift : 0;
        Layout result;
        std::array<std::vector<Layout::Point>, 2> ends;
        for (int i = 0; i <= of.columns; ++i) {
            heed_stop();
            std::vector<Layout::Point> column;
            double v = i * of.shift + phase;
            for (v -= std::floor(v - least_gap); v < whole - least_gap; v += 1) {
                const double phi = angle(v);
                column.push_back({low(phi) + face.width_u(phi) * shares[i], phi});
            }
            if (column.empty()) continue;
            ends[0].push_back(column.front()), ends[1].push_back(column.back());
            if (i > 0 && i < of.columns) result.inside.insert(result.inside.end(), column.begin(), column.end());
            else
                for (const Layout::Point& p : column) result.stops[i > 0].push_back(p.phi);
        }
        for (const int side : {0, 1}) result.ends[side] = in_front(ends[side], side == 0 ? face.from : face.to);
        const Level at = level(0.5 * (face.from + face.to));
        const double mean = high / whole;
        result.lean = at.low_slope + 0.5 * at.wide_slope;
        result.stretch = std::sqrt(2 / std::numbers::sqrt3 * std::max(at.wide / of.columns, 1e-3 * mean) / mean);
        result.triangles = of.triangles / fit;
        return result;
    }

    const MeshFace& face;
    const double error, high, half;
    std::vector<double> shares;  // share of the width at each column
};

}  // namespace

Layout columns_along(const MeshFace& face, double error) { return Columns(face, error).run(); }
Layout columns_along(const MeshFace& face, double error, const Wanted& wanted) { return Columns(face, error).run(wanted); }

}  // namespace cfree

// Layout in rows from one side to the other, each pair of strips as high as its triangles allow.
#include "cfree/mesh/layout.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cfree/support/lookout.hpp"

namespace cfree {

namespace {

constexpr std::size_t most_rows = 200'000;

class Marcher {
public:
    Marcher(const MeshFace& on, double most_error) : face(on), error(most_error) {}

    // Layout with the first number of parts that leads to the fewest triangles.
    Layout run() const {
        const int likely = best_parts(0.5 * (face.from + face.to));
        Rows best;
        double least = 1e300;
        for (int parts = std::max(1, likely - 1); parts <= likely + 1; ++parts) {
            Rows found = march(parts);
            double triangles = 0;
            for (std::size_t k = 1; k < found.rows.size(); k += 2) {
                const double high = found.rows[k + 1].angle - found.rows[k - 1].angle;
                triangles += high * rate(found.rows[k - 1].angle, found.rows[k].parts, 0.5 * high);
            }
            if (!found.rows.empty() && triangles < least) least = triangles, best = std::move(found);
        }
        return laid_out(best, least);
    }

private:
    struct Row {
        double angle;
        int parts;  // parts of the row, or of the rows before and after it
    };
    struct Rows {
        std::vector<Row> rows;  // an odd number of rows, from the first side to the last; none without a good choice
        double stretch = 1;
    };

    Layout laid_out(const Rows& of, double triangles) const {
        if (of.rows.empty()) return {};
        Layout result;
        result.triangles = triangles, result.stretch = of.stretch, result.lean = -face.shear;
        for (std::size_t k = 1; k + 1 < of.rows.size(); ++k) {
            const auto [phi, parts] = of.rows[k];
            const bool between = k % 2 == 1;
            if (!between)
                for (auto& stops : result.stops) stops.push_back(phi);
            const double low = face.u(face.position(face.curves[0].at(phi), phi)), wide = face.width_u(phi);
            const double shift = between ? 0.5 : 0;
            for (int i = between ? 0 : 1; i < parts; ++i) result.inside.push_back({low + wide * (i + shift) / parts, phi});
        }
        result.parts = {of.rows.front().parts, of.rows.back().parts};
        return result;
    }

    Rows march(int parts) const {
        double phi = face.from, height = 0, wide = 0;
        std::vector<double> steps;
        std::vector<int> counts;
        while (phi < face.to && steps.size() < most_rows) {
            heed_stop();
            if (steps.size() % 4 == 3) parts = best_near(phi, parts);
            const double y = half_height(phi, parts);
            if (!(y > 0)) return {};
            steps.push_back(y), counts.push_back(parts);
            wide += face.width_u(std::min(phi + y, face.to)) / parts * y, height += 2 * y;
            phi += 2 * y;
        }
        if (phi < face.to) return {};
        Rows result;
        const double scale = (face.to - face.from) / height;
        double at = face.from;
        for (std::size_t k = 0; k < steps.size(); ++k) {
            result.rows.push_back({at, k == 0 ? counts[k] : std::max(counts[k - 1], counts[k])});
            result.rows.push_back({at + scale * steps[k], counts[k]});
            at += 2 * scale * steps[k];
        }
        result.rows.push_back({face.to, counts.back()});
        const double y = 0.5 * (face.to - face.from) / static_cast<double>(steps.size());
        result.stretch = std::sqrt(0.5 * std::numbers::sqrt3 * std::max(2 * wide / height, 1e-3 * y) / y);
        return result;
    }

    int best_parts(double phi) const {
        int best = 1;
        double least = 1e300;
        for (int n = 1; n <= 64; ++n) {
            const double found = rate(phi, n, half_height(phi, n));
            if (found < least) least = found, best = n;
            else if (found > 1.3 * least) break;
        }
        return best;
    }
    // Best number of parts: one more or one less if that saves much.
    int best_near(double phi, int parts) const {
        const auto of = [&](int n) { return rate(phi, n, half_height(phi, n)); };
        const double here = 0.9 * of(parts);
        if (parts > 1 && of(parts - 1) < here) return parts - 1;
        return of(parts + 1) < here ? parts + 1 : parts;
    }
    // Triangles per radian, with those of the neighbours for points on the rim that they do not need.
    double rate(double phi, int parts, double y) const {
        const double spare = std::max(0.0, 1 - 2 * y / rim_step(face, error, phi));
        return (4 * parts + spare_point_cost * spare) / (2 * y);
    }

    // Half of the height of two strips from phi on, of this many parts.
    double half_height(double phi, int parts) const {
        const double cap = std::min(0.5 * rim_step(face, error, phi), 0.5 * (face.to - phi));
        double y = cap, good = 0;
        for (int tries = 0; tries < 8; ++tries) {
            const double most = excess(phi, y, parts);
            if (most <= 1) good = std::max(good, y);
            if (most <= 1 && (y >= cap || most > 0.995)) break;
            y = std::min(cap, y * std::clamp(0.998 / most, 0.2, 2.0));
        }
        return good;
    }

    double excess(double phi, double y, int parts) const {
        const auto row = [&](double at, double shift, int count) {
            std::vector<MeshPoint> points;
            const double low = face.u(face.position(face.curves[0].at(at), at)), wide = face.width_u(at);
            for (int i = 0; i < count; ++i) points.push_back(face.point(face.s(low + wide * (i + shift) / parts), at));
            return points;
        };
        auto below = row(phi, 0, parts + 1), above = row(std::min(phi + 2 * y, face.to), 0, parts + 1);
        const auto middle = row(phi + y, 0.5, parts);
        for (auto* of : {&below, &above}) of->front().inward[0] = of->back().inward[1] = 0;
        double most = 0;
        const auto add = [&](const MeshPoint& p, const MeshPoint& q, const MeshPoint& r) {
            most = std::max(most, face.excess({&p, &q, &r}));
        };
        const auto n = static_cast<std::size_t>(parts);
        for (std::size_t i = 0; i < n; ++i) {
            add(below[i], below[i + 1], middle[i]), add(above[i], above[i + 1], middle[i]);
            if (i + 1 < n) add(middle[i], middle[i + 1], below[i + 1]), add(middle[i], middle[i + 1], above[i + 1]);
        }
        add(below[0], middle[0], above[0]);
        add(below[n], middle[n - 1], above[n]);
        return most;
    }

    const MeshFace& face;
    const double error;
};

}  // namespace

Layout rows_across(const MeshFace& face, double error) { return Marcher(face, error).run(); }

}  // namespace cfree

// The core as a page calls it: one scene, what is computed of it, and answers as columns. Errors are text.
#include <emscripten.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "answers.hpp"
#include "asking.hpp"
#include "shown.hpp"

// Tells whoever waits the share that is done.
EM_JS(void, report_share, (double share), { if (Module['share']) Module['share'](share); });

namespace {

cfree::Reply reply;
std::string error;
std::shared_ptr<cfree::World> world, drawn;  // one that decides, and one with the boundary: another with round shapes
cfree::SharedBoundary last;                  // computed so far; the next one has the patches that are the same
// Errors of polygons, in parts of the robot's size: those that guide, and the least and the greatest of those that are drawn where
// shapes are not rounded, which are as fine as so many patches allow.
constexpr double guides = 0x1p-6, finest = 0x1p-9, coarsest = 0x1p-6;
constexpr std::int64_t most_patches = 6000;

// Answer a call; 1 if it went well.
int answer(const std::function<void()>& call) {
    reply.columns.clear(), error.clear();
    try {
        call();
        return 1;
    } catch (const std::invalid_argument& fault) {
        error = fault.what();
    } catch (const std::bad_alloc&) {
        error = "there is not enough memory";
    } catch (const std::exception& fault) {
        error = std::string("a fault of cfree: ") + fault.what();
    }
    return 0;
}

cfree::World& some(const std::shared_ptr<cfree::World>& which) {
    if (!which) throw std::invalid_argument("no scene yet");
    return *which;
}
cfree::World& given() { return some(world); }
cfree::World& seen() { return some(drawn); }

void trim() {
    seen().trim(report_share, last);
    last = seen().boundary;
}

// None from an empty text.
std::optional<cfree::GivenVehicle> driver(const char* vehicle) {
    return *vehicle ? std::optional(cfree::vehicle_of(vehicle)) : std::nullopt;
}

}  // namespace

extern "C" {
EMSCRIPTEN_KEEPALIVE int scene(const char* words) {
    return answer([&] {
        cfree::GivenScene read = cfree::scene_of(words);  // the one before stays if this is none
        if (read.is_round()) {
            const auto rounds = std::make_shared<const cfree::Rounds>(std::move(read));
            const auto near = [&](double share, bool is_drawn) {
                cfree::NearShapes shapes = is_drawn ? rounds->drawn(share) : rounds->polygons(share, false);
                cfree::refuse_range(shapes.shapes);
                return std::make_shared<cfree::World>(rounds, std::move(shapes), is_drawn);
            };
            auto inside = near(guides, false);
            const bool is_drawn = rounds->asked.clearance.n == 0;
            auto seen = is_drawn ? near(finest, true) : inside;
            for (double share = 2 * finest; is_drawn && share <= coarsest && !seen->is_exact() && seen->known->patches() > most_patches; share *= 2)
                seen = near(share, true);
            world = inside, drawn = seen;
        } else {
            const cfree::SceneShapes shapes = read.polygons();
            cfree::refuse_range(shapes);
            drawn = world = std::make_shared<cfree::World>(shapes);
        }
        cfree::show_scene(*drawn, reply);
    });
}
// The boundary without its cells, for slices.
EMSCRIPTEN_KEEPALIVE int trimmed() {
    return answer([] { trim(); });
}
EMSCRIPTEN_KEEPALIVE int boundary() {
    return answer([] {
        trim();
        seen().compute_cells(report_share);
        cfree::show_counts(seen(), reply);
    });
}
EMSCRIPTEN_KEEPALIVE int columns() {
    return answer([] { cfree::show_columns(seen(), reply); });
}
EMSCRIPTEN_KEEPALIVE int mesh(double error_allowed, double most) {
    return answer([&] { cfree::show_mesh(seen(), error_allowed, most, reply); });
}
EMSCRIPTEN_KEEPALIVE int slice(double theta) {
    return answer([&] { cfree::show_slice(seen(), theta, reply); });
}
EMSCRIPTEN_KEEPALIVE int pose(const char* words) {
    return answer([&] { cfree::ask_pose(given(), seen(), cfree::pose_of(words), reply); });
}
EMSCRIPTEN_KEEPALIVE int plan(const char* start, const char* goal, const char* vehicle, int attempts, const char* wishes) {
    const std::string_view wished = wishes ? wishes : "";
    return answer([&] { cfree::ask_way(given(), cfree::pose_of(start), cfree::pose_of(goal), driver(vehicle), attempts, cfree::wishes_of(wished), reply); });
}
EMSCRIPTEN_KEEPALIVE int missing(const char* start, const char* goal) {
    return answer([&] { cfree::ask_missing(given(), cfree::pose_of(start), cfree::pose_of(goal), reply); });
}
EMSCRIPTEN_KEEPALIVE int joined(const char* start, const char* goal) {
    return answer([&] { cfree::ask_joined(seen(), cfree::pose_of(start), cfree::pose_of(goal), reply); });
}
EMSCRIPTEN_KEEPALIVE int walk(const char* poses, const char* vehicle) {
    return answer([&] { cfree::ask_walk(given(), poses, driver(vehicle), reply); });
}
EMSCRIPTEN_KEEPALIVE int written() {
    return answer([] { cfree::write_answer(given(), reply); });
}
EMSCRIPTEN_KEEPALIVE int stop(const char* from, const char* to) {
    return answer([&] { cfree::ask_stop(given(), cfree::pose_of(from), cfree::pose_of(to), reply); });
}
EMSCRIPTEN_KEEPALIVE int picked(int trapezoid, double x, double y, double theta) {
    return answer([&] { cfree::show_contact(seen(), trapezoid, {x, y, theta}, reply); });
}
EMSCRIPTEN_KEEPALIVE int cell(int which) {
    return answer([&] { cfree::show_cell(seen(), which, reply); });
}
EMSCRIPTEN_KEEPALIVE int angle(double theta, int fine) {
    return answer([&] {
        const cfree::HalfAngle half = cfree::half_angle_of(theta, fine);
        reply.text("tau", cfree::words_of({{}, {}, half}).substr(4));
        reply.add("theta", half.theta());
    });
}

EMSCRIPTEN_KEEPALIVE const char* fault() { return error.c_str(); }
EMSCRIPTEN_KEEPALIVE int count() { return static_cast<int>(reply.columns.size()); }
EMSCRIPTEN_KEEPALIVE const char* name(int k) { return reply.columns[static_cast<std::size_t>(k)].name.c_str(); }
EMSCRIPTEN_KEEPALIVE int type(int k) { return static_cast<int>(reply.columns[static_cast<std::size_t>(k)].type); }
EMSCRIPTEN_KEEPALIVE const void* bytes(int k) { return reply.columns[static_cast<std::size_t>(k)].bytes.data(); }
EMSCRIPTEN_KEEPALIVE int size(int k) { return static_cast<int>(reply.columns[static_cast<std::size_t>(k)].bytes.size()); }
}

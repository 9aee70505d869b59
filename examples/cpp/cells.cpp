// Polygons in, cells out: which cell of the free space a robot is in, at orientation 0.
//
// Lines of a file: `robot x y x y ...`, `obstacle x y ...` and `hole x y ...` (of the obstacle before it), exact numbers such as
// 0.1 or 1/3; `pose x y`, numbers as doubles.
#include <cfree/free/free_space.hpp>
#include <cfree/scene/features.hpp>

#include <fstream>
#include <iostream>
#include <sstream>

using namespace cfree;

static RatioRing ring(std::istream& line) {
    RatioRing points;
    for (std::string x, y; line >> x >> y;) points.push_back({ratio_of(x).value(), ratio_of(y).value()});
    return points;
}

int main(int, char** arguments) {
    std::vector<std::vector<RatioRing>> robot, obstacles;
    std::vector<Vec<double>> poses;
    std::ifstream file(arguments[1]);
    for (std::string text; std::getline(file, text);) {
        std::istringstream line(text);
        std::string word;
        line >> word;
        if (word == "robot") robot.push_back({ring(line)});
        if (word == "obstacle") obstacles.push_back({ring(line)});
        if (word == "hole") obstacles.back().push_back(ring(line));
        if (double x, y; word == "pose" && line >> x >> y) poses.push_back({x, y});
    }
    SceneShapes shapes;
    for (const auto& rings : robot) shapes.robot.push_back(std::make_shared<const Polygon>(rings));
    for (const auto& rings : obstacles) shapes.obstacles.push_back(std::make_shared<const Polygon>(rings));

    const auto scene = scene_features(shapes).scene;
    const auto space = FreeSpace::of(*glue(compute_boundary(scene)));
    std::cout << space->cells() << " cells\n";
    for (const auto& [x, y] : poses) {
        const Index cell = space->locate(ExactPose::from(x, y, 0, 0, scene->scale));
        std::cout << "(" << x << ", " << y << "): " << (cell < 0 ? "forbidden" : "cell " + std::to_string(cell)) << "\n";
    }
}

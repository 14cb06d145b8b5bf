#include "viewer/scene/inside/arrows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <Eigen/Geometry>

#include "viewer/scene/inside/shapes.h"

namespace kerf::view {

namespace {

constexpr double cubes_per_diagonal = 14;
constexpr double head_length = 0.28, head_width = 0.11;  // of the arrow
constexpr double least_share = 0.01;                     // of the longest: a shorter arrow would be a dot

}  // namespace

double longest_arrow(double diagonal) { return diagonal / cubes_per_diagonal; }

std::vector<Arrow> spread(const std::vector<Arrow>& arrows, double diagonal) {
    const double side = diagonal / cubes_per_diagonal;
    struct Chosen {
        std::size_t index;
        double distance;
    };
    std::map<std::array<std::int64_t, 3>, Chosen> chosen;
    for (std::size_t i = 0; i < arrows.size(); ++i) {
        std::array<std::int64_t, 3> cube = {};
        Vec3 middle;
        for (Eigen::Index k = 0; k < 3; ++k) {
            const double number = std::floor(arrows[i].rest[k] / side);
            cube[k] = static_cast<std::int64_t>(number);
            middle[k] = (number + 0.5) * side;
        }
        const double distance = (arrows[i].rest - middle).squaredNorm();
        const auto [place, is_new] = chosen.emplace(cube, Chosen{i, distance});
        if (!is_new && distance < place->second.distance) place->second = {i, distance};
    }
    std::vector<Arrow> some;
    for (const auto& [cube, one] : chosen) some.push_back(arrows[one.index]);
    return some;
}

std::shared_ptr<Geometry> arrow_segments(const std::vector<Arrow>& arrows, double longest, double diagonal,
                                         const Frame& frame) {
    if (!(longest > 0))
        for (const Arrow& arrow : arrows) longest = std::max(longest, arrow.along.norm());
    std::vector<std::array<Vec3, 2>> lines;
    for (const Arrow& arrow : arrows) {
        if (!(arrow.along.norm() > least_share * longest)) continue;
        const Vec3 shaft = arrow.along * (longest_arrow(diagonal) / longest);
        const Vec3 tip = arrow.from + shaft;
        const Vec3 across = shaft.unitOrthogonal() * shaft.norm(), other = shaft.cross(across) / shaft.norm();
        lines.push_back({arrow.from, tip});
        for (const Vec3& side : {across, other})
            for (const double sign : {-1.0, 1.0})
                lines.push_back({tip, tip - head_length * shaft + sign * head_width * side});
    }
    return segments(lines, frame);
}

}  // namespace kerf::view

// Facets that lie in the direction of the plane are summed up by their place along its normal, in thousandths of the
// box; where they have a noticeable share of the surface's area there is a face. Places are whole numbers from there
// on, so that the same body gives the same plane, whatever rounds.
#include "viewer/model/off_faces.h"

#include <cmath>
#include <cstdlib>
#include <vector>

namespace kerf::view {

namespace {

constexpr int divisions = 1000;                                  // of the extent of the box
constexpr int too_close = 8, longest_move = 30;                  // distance of a face, and of a move of the plane
constexpr double parallel_cosine = 0.9998, least_share = 0.002;  // of the area of the surface

std::vector<int> places_of_faces(const NodeSurface& surface, const Vec3& normal, const ValueRange& extent) {
    std::vector<double> area(divisions + 1);
    double whole = 0;
    for (const Triangle& t : surface.facets) {
        const Vec3 &a = surface.vertices[t[0]], &b = surface.vertices[t[1]], &c = surface.vertices[t[2]];
        const Vec3 across = (b - a).cross(c - a);
        const double size = across.norm();
        if (!std::isfinite(size)) continue;
        whole += size;
        if (!(std::abs(across.dot(normal)) > parallel_cosine * size)) continue;
        const double place = ((a + b + c).dot(normal) / 3 - extent.low) / (extent.high - extent.low);
        if (place >= 0 && place <= 1) area[static_cast<std::size_t>(std::lround(divisions * place))] += size;
    }
    std::vector<int> places;
    for (int i = 0; i <= divisions; ++i)
        if (area[i] > least_share * whole) places.push_back(i);
    return places;
}

}  // namespace

void keep_off_faces(Clip& clip, const NodeSurface& surface, const Eigen::AlignedBox3d& box) {
    const ValueRange extent = extent_along(box, clip.normal);
    if (!(extent.high > extent.low) || !(clip.position > 0 && clip.position < 1)) return;
    const int wanted = static_cast<int>(std::lround(divisions * clip.position));
    std::vector<int> ends = {std::max(0, wanted - longest_move)};
    bool is_close = false;
    for (const int face : places_of_faces(surface, clip.normal, extent)) {
        is_close |= std::abs(face - wanted) < too_close;
        if (face > ends.front() && face < wanted + longest_move) ends.push_back(face);
    }
    if (!is_close) return;
    ends.push_back(std::min(divisions, wanted + longest_move));
    std::size_t best = 1;
    const auto width = [&](std::size_t i) { return ends[i] - ends[i - 1]; };
    const auto moved = [&](std::size_t i) { return std::abs(ends[i] + ends[i - 1] - 2 * wanted); };
    for (std::size_t i = 2; i < ends.size(); ++i)
        if (width(i) > width(best) || (width(i) == width(best) && moved(i) < moved(best))) best = i;
    clip.position = (ends[best] + ends[best - 1]) / (2.0 * divisions);
}

}  // namespace kerf::view

#include "surface/openings/hole_triangulation.h"

#include <algorithm>

// Nothing asks for triangulations in a plane, and they would have to be compiled, too.
#define CGAL_HOLE_FILLING_DO_NOT_USE_CDT2
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/utility.h>

namespace kerf {

namespace {

using RimPoint = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
using RimTriangle = CGAL::Triple<int, int, int>;

std::vector<RimPoint> cgal_points(const std::vector<Vec3>& points) {
    std::vector<RimPoint> copies;
    for (const Vec3& p : points) copies.emplace_back(p.x(), p.y(), p.z());
    return copies;
}

}  // namespace

std::vector<Triangle> triangulate_hole(const std::vector<Vec3>& rim, const std::vector<Vec3>& apexes) {
    std::vector<RimTriangle> patch;
    CGAL::Polygon_mesh_processing::triangulate_hole_polyline(cgal_points(rim), cgal_points(apexes),
                                                             std::back_inserter(patch));
    std::vector<Triangle> triangles;
    for (const RimTriangle& t : patch) {
        Triangle triangle = {t.first, t.second, t.third};
        std::sort(triangle.begin(), triangle.end());  // in the direction of the rim
        triangles.push_back(triangle);
    }
    return triangles;
}

}  // namespace kerf

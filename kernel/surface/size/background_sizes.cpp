#include "surface/size/background_sizes.h"

#include <algorithm>

#include "base/core/check.h"
#include "base/core/elements.h"
#include "base/geometry/tetrahedron.h"

namespace kerf {

namespace {

constexpr double slack = 1e-9;  // of barycentric coordinates: neighbours leave no gap

double smallest_coordinate_of(const std::array<double, 4>& t) { return std::min({t[0], t[1], t[2], t[3]}); }

// Barycentric coordinates; all -1 for a cell without volume.
std::array<double, 4> barycentric(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const double volume = six_volumes_of(a, b, c, d);
    if (volume == 0) return {-1, -1, -1, -1};
    const double tb = six_volumes_of(a, p, c, d) / volume, tc = six_volumes_of(a, b, p, d) / volume,
                 td = six_volumes_of(a, b, c, p) / volume;
    return {1 - tb - tc - td, tb, tc, td};
}

// Faces that one cell alone has, each with its corners ascending.
std::vector<Triangle> border_faces(const std::vector<Tetrahedron>& tets) {
    std::vector<Triangle> faces;
    for (const Tetrahedron& t : tets)
        for (std::size_t omitted = 0; omitted < 4; ++omitted) {
            Triangle face{t[(omitted + 1) % 4], t[(omitted + 2) % 4], t[(omitted + 3) % 4]};
            std::sort(face.begin(), face.end());
            faces.push_back(face);
        }
    std::sort(faces.begin(), faces.end());
    std::vector<Triangle> border;
    for (std::size_t i = 0, j = 0; i < faces.size(); i = j) {
        while (j < faces.size() && faces[j] == faces[i]) ++j;
        if (j - i == 1) border.push_back(faces[i]);
    }
    return border;
}

void limit_growth(SizedMesh& mesh, double growth) {
    std::vector<SizedTriangle> points;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        const Vec3& p = mesh.vertices[v];
        points.emplace_back(p, p, p, std::array{mesh.size[v], mesh.size[v], mesh.size[v]});
    }
    const SizedTriangles sources(std::move(points));
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
        mesh.size[v] = sources.size_at(mesh.vertices[v], growth, mesh.size[v]);
}

}  // namespace

BackgroundSizes::BackgroundSizes(SizedMesh mesh, double growth) : mesh_(std::move(mesh)) {
    KERF_CHECK(mesh_.size.size() == mesh_.vertices.size() && are_in_range(mesh_.tets, mesh_.vertices.size()));
    limit_growth(mesh_, growth);
    index();
}

void BackgroundSizes::index() {
    cells_ = std::make_shared<const BoxTree>(boxes_around(mesh_.vertices, mesh_.tets));
    std::vector<SizedTriangle> border;
    const auto& size = mesh_.size;
    for (const auto& [a, b, c] : border_faces(mesh_.tets))
        border.emplace_back(mesh_.vertices[a], mesh_.vertices[b], mesh_.vertices[c],
                            std::array{size[a], size[b], size[c]});
    border_ = SizedTriangles(std::move(border));
}

double BackgroundSizes::size_at(const Vec3& p, double growth, double bound) const {
    bool is_inside = false;
    cells_->for_each_meeting(Box(p, p), [&](std::int32_t cell) {
        const auto& [a, b, c, d] = mesh_.tets[cell];
        const auto& x = mesh_.vertices;
        const std::array<double, 4> t = barycentric(p, x[a], x[b], x[c], x[d]);
        if (smallest_coordinate_of(t) < -slack) return;
        is_inside = true;
        const auto& s = mesh_.size;
        bound = std::min(bound, s[a] + t[1] * (s[b] - s[a]) + t[2] * (s[c] - s[a]) + t[3] * (s[d] - s[a]));
    });
    return is_inside ? bound : border_.size_at(p, growth, bound);
}

}  // namespace kerf

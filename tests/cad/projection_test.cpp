// Points put on the faces and curves of CAD files.
#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "cad/cad_files.h"
#include "files/cad/cad_import.h"
#include "files/io/file_bytes.h"
#include "run/prepare/cad_input.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

struct Solid {
    const char* name;
    std::function<test::CadShape()> make;
    std::function<double(const Vec3&)> distance;  // to its surface
};

std::vector<Solid> solids() {
    return {{"sphere", [] { return test::sphere(2); }, [](const Vec3& p) { return p.norm() - 2; }},
            {"cylinder", [] { return test::cylinder(1, 3); },
             [](const Vec3& p) {
                 const double r = std::hypot(p.x(), p.y()) - 1, z = std::abs(p.z() - 1.5) - 1.5;
                 return std::max(r, z);
             }},
            {"torus", [] { return test::torus(3, 1); },
             [](const Vec3& p) { return std::hypot(std::hypot(p.x(), p.y()) - 3, p.z()) - 1; }},
            {"rounded_box", [] { return test::rounded_box(4, 1); },
             [](const Vec3& p) {
                 const Vec3 centre = Vec3(2, 2, 2), off = (p - centre).cwiseAbs() - Vec3(1, 1, 1);
                 return off.cwiseMax(0).norm() + std::min(off.maxCoeff(), 0.0) - 1;
             }}};
}

// Vertices are on the faces, and there are some hundreds of facets, not thousands.
const CadOptions of_few_facets = {.deflection = 0.003, .on_faces = true};

class ProjectionLaws : public testing::TestWithParam<Solid> {
 protected:
    CadBody import(const CadOptions& options, const char* ending = "step") {
        path_ = folder_.file(std::string("solid.") + ending);
        test::write_cad(path_, GetParam().make());
        content_ = read_file(path_);
        return import_cad(content_, path_, options);
    }
    test::TemporaryFolder folder_;
    std::string path_, content_;
};

// The middles of the facets, and points around them, each with its patch.
CadPoints points_near(const CadBody& body, double off) {
    CadPoints points;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> some(-off, off);
    points.patch_names = body.soup.patch_names;
    for (std::size_t p = 0; p < body.soup.patch_names.size(); ++p)
        points.places.push_back({{static_cast<std::int32_t>(p)}, 0});
    for (std::size_t f = 0; f < body.soup.facets.size(); ++f) {
        const auto& [a, b, c] = body.soup.facets[f];
        const std::vector<Vec3>& v = body.soup.vertices;
        points.points.push_back((v[a] + v[b] + v[c]) / 3 + Vec3(some(random), some(random), some(random)));
        points.place.push_back(body.soup.patch[f]);
    }
    return points;
}

TEST_P(ProjectionLaws, PointsComeToLieOnTheSurfaceAndStayNear) {
    for (const char* ending : {"step", "brep"}) {
        const CadOptions options = of_few_facets;
        const CadPoints points = points_near(import(options, ending), 0.05);
        const ProjectedPoints projected = project_on_cad(content_, path_, options, points);
        ASSERT_EQ(projected.points.size(), points.points.size());
        for (std::size_t i = 0; i < points.points.size(); ++i) {
            const Vec3 &before = points.points[i], &now = projected.points[i];
            // Planes go on beyond their faces: by 0.05 along two axes.
            if ((now - before).norm() < 0.09) {
                EXPECT_LE(std::abs(GetParam().distance(now)), 0.071) << now.transpose();
            }
            EXPECT_LE((now - before).norm(), 0.2);
        }
    }
}

TEST_P(ProjectionLaws, NodesOfFacetsLieOnTheSurface) {
    const CadOptions options = of_few_facets;
    const CadBody body = import(options);
    CadPoints points = points_near(body, 0);
    points.points.clear();
    points.place.clear();
    for (const Vec3& p : body.soup.vertices) {
        EXPECT_NEAR(GetParam().distance(p), 0, 1e-7) << p.transpose();
        points.points.push_back(p);
        points.place.push_back(-1);
    }
    for (std::size_t f = 0; f < body.soup.facets.size(); ++f)
        for (std::size_t i = 0; i < 3; ++i) {
            points.ends.push_back({body.soup.facets[f][i], body.soup.facets[f][(i + 1) % 3]});
            points.place_of_middle.push_back(body.soup.patch[f]);
        }
    const ProjectedPoints projected = project_on_cad(content_, path_, options, points);
    EXPECT_EQ(projected.points, points.points);
    for (const Vec3& p : projected.middles) EXPECT_NEAR(GetParam().distance(p), 0, 1e-7) << p.transpose();
    const ProjectedPoints again = project_on_cad(content_, path_, options, points);
    EXPECT_EQ(again.middles, projected.middles);
}

INSTANTIATE_TEST_SUITE_P(Projection, ProjectionLaws, testing::ValuesIn(solids()),
                         [](const auto& solid) { return solid.param.name; });

TEST(Projection, RimsStayRims) {
    const test::TemporaryFolder folder;
    const std::string path = folder.file("rod.step");
    test::write_cad(path, test::cylinder(1, 3), "INCH");
    const std::string content = read_file(path);
    const CadOptions options{.unit = LengthUnit::cm};
    const CadBody body = import_cad(content, path, options);
    CadPoints points;
    points.patch_names = body.soup.patch_names;
    points.places = {{{0, 1}, 1}, {{0, 2}, 1}, {{1, 2}, 1}};
    for (std::int32_t place = 0; place < 3; ++place)
        for (const double height : {0.001, 0.299})
            for (int i = 0; i < 12; ++i) {
                points.points.emplace_back(0.11 * std::cos(i), 0.11 * std::sin(i), height);
                points.place.push_back(place);
            }
    const ProjectedPoints projected = project_on_cad(content, path, options, points);
    int on_rim = 0;
    for (const Vec3& p : projected.points)
        on_rim +=
            std::abs(std::hypot(p.x(), p.y()) - 0.1) < 1e-9 && std::min(std::abs(p.z()), std::abs(p.z() - 0.3)) < 1e-9;
    EXPECT_GE(on_rim, 48) << "two of the three pairs of faces share a rim, and it is the only one";
}

TEST(Projection, TheProgramDoesWhatTheLibraryDoes) {
    const test::TemporaryFolder folder;
    const std::string path = folder.file("ball.step");
    test::write_cad(path, test::sphere(1));
    const std::string content = read_file(path);
    CadPoints points;
    points.patch_names = {"unknown to the model"};
    points.places = {{{0}, 0}};
    points.points = {{1, 1, 1}, {-2, 0.5, 0}};
    points.place = {0, 0};
    points.ends = {{0, 1}};
    points.place_of_middle = {0};
    const ProjectedPoints here = project_on_cad(content, path, {}, points);
    const ProjectedPoints there = project_on_cad_file(path, digest_of(content), {}, points, test::cad_program());
    EXPECT_EQ(here.points, there.points);
    EXPECT_EQ(here.middles, there.middles);
    EXPECT_NEAR(here.points[0].norm(), 1, 1e-12);
    EXPECT_NEAR(here.middles[0].norm(), 1, 1e-12);
    EXPECT_THROW(project_on_cad_file(path, FileHash{1, 2}, {}, points, test::cad_program()), Error);
}

}  // namespace
}  // namespace kerf

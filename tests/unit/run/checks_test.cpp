// Broken preconditions end the process at the place that states them, where the build has checks; elsewhere they cost
// nothing.
#include <fstream>
#include <functional>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/core/check.h"
#include "cut/cut/inside/contour.h"
#include "cut/cut/inside/interface.h"
#include "cut/cut/planar_triangulation.h"
#include "cut/cut/split.h"
#include "cut/decompose/tree_node.h"
#include "files/io/stl_writer.h"
#include "fill/mesh/adjacency.h"
#include "fill/mesh/quality.h"
#include "run/prepare/numbering.h"
#include "support/places.h"
#include "support/shapes.h"
#include "surface/diagnosis/orientation.h"

namespace kerf {
namespace {

using namespace test;

TEST(Checks, AreMadeOnlyWhereTheBuildHasThem) {
    int made = 0;
    KERF_CHECK(++made > 0);
    EXPECT_EQ(made, has_checks ? 1 : 0);
}

// The option of a preset, which it may inherit.
bool has_checks_on(const std::map<std::string, nlohmann::json>& presets, const std::string& name) {
    const nlohmann::json& preset = presets.at(name);
    const nlohmann::json options = preset.value("cacheVariables", nlohmann::json::object());
    if (options.contains("KERF_CHECKS")) return options["KERF_CHECKS"] == "ON";
    return preset.contains("inherits") && has_checks_on(presets, preset["inherits"]);
}

TEST(Checks, AreOnInAllPresetsButRelease) {
    std::map<std::string, nlohmann::json> presets;
    std::ifstream file(test::source_folder() + "/CMakePresets.json");
    const nlohmann::json all = nlohmann::json::parse(file);
    for (const nlohmann::json& preset : all.at("configurePresets")) presets[preset["name"]] = preset;
    ASSERT_GT(presets.size(), 2U);
    for (const auto& [name, preset] : presets)
        if (!preset.value("hidden", false)) {
            EXPECT_EQ(has_checks_on(presets, name), name != "release") << name;
        }
}

#ifdef KERF_CHECKS

TEST(Checks, NameFileLineAndCondition) {
    EXPECT_DEATH(KERF_CHECK(1 > 2),
                 fmt::format("checks_test\\.cpp:{}: this must hold, but does not: 1 > 2", __LINE__ - 1));
}

struct Misuse {
    const char* place;  // where it is found: the file, and what the condition says
    std::function<void()> action;
};

// What `change` makes of the arrays of a box.
SurfaceArrays changed_box(const std::function<void(SurfaceArrays&)>& change) {
    SurfaceArrays arrays = to_arrays(box());
    change(arrays);
    return arrays;
}

Plane skewed_plane() {
    Plane plane;
    plane.u = Vec3(1, 1, 0);
    return plane;
}

std::vector<Misuse> misuses() {
    const Surface surface = to_surface(box());
    const Band band = make_band(surface, Plane({0.5, 0.5, 0.5}, Vec3::UnitZ()));
    const std::vector<std::int32_t> no_hits(8, 0);
    const Array<Facet, Side> labels(12), too_few(11);
    return {
        {"surface.h:[0-9]+: .*has_vertex", [=] { surface.point(Vertex(8)); }},
        {"surface.h:[0-9]+: .*has_facet", [=] { surface.half_edges(Facet::none()); }},
        {"surface.h:[0-9]+: .*has_half_edge", [=] { surface.next(HalfEdge(36)); }},
        {"surface.cpp:[0-9]+: .*is_well_formed",
         [] { Surface::build(changed_box([](SurfaceArrays& box) { box.patch.pop_back(); })); }},
        {"surface.cpp:[0-9]+: .*is_well_formed",
         [] { Surface::build(changed_box([](SurfaceArrays& box) { box.facets[3][1] = 8; })); }},
        {"surface.cpp:[0-9]+: .*are_partners",
         [] { Surface::build(to_arrays(box()), std::vector<std::int32_t>(36, 0)); }},
        {"orientation.cpp:[0-9]+: .*is_closed",
         [] {
             Soup open = box();
             open.facets.pop_back();
             orient(open);
         }},
        {"soup.cpp:[0-9]+: .*drop.size",
         [] {
             Soup soup = box();
             drop_facets(soup, {1, 0});
         }},
        {"cut.cpp:[0-9]+: .*is_orthonormal", [] { Plane(Vec3::Zero(), Vec3(0, 0, 2)); }},
        {"band.cpp:[0-9]+: .*is_orthonormal", [=] { make_band(surface, skewed_plane()); }},
        {"contour.cpp:[0-9]+: .*fit", [=] { contour_edges(surface, band, too_few); }},
        {"split.cpp:[0-9]+: .*fit", [=] { split(surface, too_few, {}, root_node); }},
        {"interface.cpp:[0-9]+: .*is_closed_path",
         [=] {
             build_interface(surface, band, labels, {{Vertex(0), Vertex(7), Vertex(1)}}, no_hits, {});
         }},
        {"planar_triangulation.cpp:[0-9]+: .*has_closed_loops",
         [] {
             PlanarRegion region;
             region.contour = {{0, 0}, {1, 0}, {0, 1}};
             region.edges = {{0, 1}, {1, 2}};
             triangulate(region);
         }},
        {"tree_node.cpp:[0-9]+: .*leaves",
         [] {
             leaves_below({1, 1}, 1, {});
         }},
        {"adjacency.cpp:[0-9]+: .*are_in_range",
         [] {
             TetMesh mesh;
             mesh.tets = {{0, 1, 2, 3}};
             connect_tets(mesh);
         }},
        {"quality.cpp:[0-9]+: .*low", [] { Distribution(Distribution::Scale::logarithmic, 0, 1); }},
        {"stl_writer.cpp:[0-9]+: .*are_in_range",
         [] {
             write_stl("", {Vec3::Zero()}, {{0, 1, 2}});
         }},
        {"numbering.cpp:[0-9]+: .*node", [] { VertexNumbering(8, {}).global_id(make_key(NodeId(1), 0)); }},
    };
}

TEST(Checks, EndTheProcessWhereAPreconditionIsBroken) {
    for (const Misuse& misuse : misuses()) {
        SCOPED_TRACE(misuse.place);
        EXPECT_DEATH(misuse.action(), misuse.place);
    }
}

#endif

}  // namespace
}  // namespace kerf

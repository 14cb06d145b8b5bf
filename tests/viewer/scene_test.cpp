// What is drawn, without pixels: cells and facets as triangles, offsets, caches.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "fill/mesh/adjacency.h"
#include "fill/mesh/quality.h"
#include "support/assets.h"
#include "support/places.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"
#include "support/write_off.h"
#include "viewer/driver.h"
#include "viewer/golden_image.h"
#include "viewer/scene/inside/cell_shapes.h"
#include "viewer/scene/selection.h"
#include "viewer/scene/stand_in.h"

namespace kerf::test {
namespace {

using namespace view;

// A cube of n^3 small cubes, each of six tetrahedra.
PartCells grid(int n) {
    PartCells cells;
    const auto number = [&](int x, int y, int z) { return (x * (n + 1) + y) * (n + 1) + z; };
    for (int x = 0; x <= n; ++x)
        for (int y = 0; y <= n; ++y)
            for (int z = 0; z <= n; ++z) cells.vertices.emplace_back(x, y, z);
    constexpr std::array<std::array<int, 3>, 6> orders = {
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}}};
    for (int x = 0; x < n; ++x)
        for (int y = 0; y < n; ++y)
            for (int z = 0; z < n; ++z)
                for (std::size_t o = 0; o < orders.size(); ++o) {
                    std::array<int, 3> p = {x, y, z};
                    Tetrahedron tet = {number(p[0], p[1], p[2])};
                    for (std::size_t k = 0; k < 3; ++k) {
                        ++p[static_cast<std::size_t>(orders[o][k])];
                        tet[k + 1] = number(p[0], p[1], p[2]);
                    }
                    if (o >= 3) std::swap(tet[1], tet[2]);
                    cells.tets.push_back(tet);
                }
    TetMesh mesh;
    mesh.vertices = cells.vertices;
    mesh.tets.assign(cells.tets.begin(), cells.tets.end());
    connect_tets(mesh);
    cells.neighbours = mesh.neighbours;
    return cells;
}

double area(const Geometry& geometry) {
    double sum = 0;
    for (std::size_t i = 0; i < geometry.corners.size(); i += 3) {
        const auto p = [&](std::size_t k) {
            const auto& q = geometry.corners[i + k].position;
            return Vec3(q[0], q[1], q[2]);
        };
        sum += (p(1) - p(0)).cross(p(2) - p(0)).norm() / 2;
    }
    return sum;
}

// Six times the volume that triangles enclose, if they close.
double enclosed(const Geometry& geometry) {
    double sum = 0;
    for (std::size_t i = 0; i < geometry.corners.size(); i += 3) {
        const auto p = [&](std::size_t k) {
            const auto& q = geometry.corners[i + k].position;
            return Vec3(q[0], q[1], q[2]);
        };
        sum += p(0).dot(p(1).cross(p(2)));
    }
    return sum;
}

const Frame plain_frame = {Vec3::Zero(), 1};

TEST(Cells, WithoutAChoiceTheyShowTheirBoundary) {
    const auto faces = cell_faces(grid(4), plain_frame, {});
    EXPECT_EQ(faces->triangle_count(), 6u * 16 * 2);
    EXPECT_NEAR(area(*faces), 96, 1e-4);
    EXPECT_NEAR(enclosed(*faces) / 6, 64, 1e-3);
}

// Faces of chosen cells enclose as much as the cells fill.
TEST(Cells, WhateverIsChosenIsClosed) {
    const PartCells cells = grid(4);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> number(-1, 1);
    for (int i = 0; i < 60; ++i) {
        const Vec3 normal = Vec3(number(random), number(random), number(random)).normalized();
        const ShownSide side{normal, normal.dot(Vec3(2, 2, 2)) + number(random)};
        std::vector<float> value;
        for (std::size_t t = 0; t < cells.tets.size(); ++t) value.push_back(static_cast<float>(number(random)));
        for (const ClipStyle style : {ClipStyle::cells, ClipStyle::layer}) {
            CellChoice choice;
            choice.side = &side;
            choice.style = style;
            choice.value = value;
            if (i % 2) choice.filter = ValueRange{-0.5, 0.7};
            const std::vector<char> chosen = chosen_cells(cells, choice);
            const auto count = std::count(chosen.begin(), chosen.end(), 1);
            EXPECT_NEAR(enclosed(*cell_faces(cells, plain_frame, choice)), static_cast<double>(count), 1e-3);
        }
    }
}

// The section of the whole cube has the area that the cube's section has.
TEST(Cells, SmoothSectionsCoverThePlane) {
    const PartCells cells = grid(4);
    const auto section_area = [&](const Vec3& normal, double offset) {
        const ShownSide side{normal.normalized(), offset / normal.norm()};
        CellChoice choice;
        choice.side = &side;
        choice.style = ClipStyle::smooth;
        return area(*cell_sections(cells, plain_frame, choice));
    };
    EXPECT_NEAR(section_area({1, 0, 0}, 1.3), 16, 1e-4);
    EXPECT_NEAR(section_area({0, 0, 1}, 2), 16, 1e-4) << "through vertices";
    EXPECT_NEAR(section_area({1, 1, 0}, 4), 16 * std::sqrt(2), 1e-4);
    EXPECT_NEAR(section_area({1, 1, 1}, 6), 3 * std::sqrt(3) / 4 * 16, 1e-3) << "a regular hexagon of side sqrt 8";
    EXPECT_EQ(section_area({1, 0, 0}, 9), 0);
}

TEST(Cells, SectionsFaceTheSideThatWasCutAway) {
    const PartCells cells = grid(2);
    const ShownSide side{Vec3(1, 2, 3).normalized(), 1.5};
    CellChoice choice;
    choice.side = &side;
    choice.style = ClipStyle::smooth;
    const auto sections = cell_sections(cells, plain_frame, choice);
    ASSERT_GT(sections->triangle_count(), 10u);
    for (std::size_t i = 0; i < sections->corners.size(); i += 3) {
        const auto p = [&](std::size_t k) {
            const auto& q = sections->corners[i + k].position;
            return Vec3(q[0], q[1], q[2]);
        };
        EXPECT_GT((p(1) - p(0)).cross(p(2) - p(0)).dot(side.normal), -1e-6);
    }
}

TEST(Cells, ShrunkOnesAreComplete) {
    const PartCells cells = grid(3);
    CellChoice choice;
    choice.shrink = 0.5;
    const auto faces = cell_faces(cells, plain_frame, choice);
    std::map<std::int32_t, int> faces_of;
    for (const std::int32_t cell : faces->element) ++faces_of[cell];
    double outer = 0;
    for (std::size_t t = 0; t < cells.tets.size(); ++t) {
        const auto& n = cells.neighbours[t];
        if (std::find(n.begin(), n.end(), CellId::none()) == n.end()) continue;
        ++outer;
        EXPECT_EQ(faces_of[static_cast<std::int32_t>(t)], 4) << t;
    }
    const double inner = static_cast<double>(cells.tets.size()) - outer;
    EXPECT_GT(inner, 0);
    EXPECT_NEAR(enclosed(*faces), outer / 8 + inner, 1e-3) << "each an eighth of its volume, the others whole";
}

TEST(Explosion, SistersPartByTheirCut) {
    Tree tree;
    for (NodeId id = root_node; id < NodeId(8); ++id) {
        TreeRow& row = tree.at(id);
        row.state = id < NodeId(4) ? NodeState::divided : NodeState::done;
        row.volume = 8;
        if (id >= NodeId(4)) continue;
        row.cut.emplace().strategy = CutStrategy::first_try;
        row.cut->plane = Plane(Vec3::Zero(), id == root_node ? Vec3(Vec3::UnitX()) : Vec3(Vec3::UnitY()));
    }
    EXPECT_EQ(explosion_offset(tree, NodeId(6), root_node, 0, 1), Vec3::Zero());
    EXPECT_EQ(explosion_offset(tree, NodeId(4), root_node, 1, 1), Vec3(-1, -1, 0));
    EXPECT_EQ(explosion_offset(tree, NodeId(7), root_node, 1, 1), Vec3(1, 1, 0));
    EXPECT_EQ(explosion_offset(tree, NodeId(7), NodeId(3), 1, 1), Vec3(0, 1, 0))
        << "only cuts below the root that is shown";
}

// The layer of a step has these edges of the node's surface, each where it is.
void expect_edges(Driver& driver, const Step& step, const std::vector<SurfaceEdge>& edges) {
    const auto surface = driver.app().session().fetched().surface(driver.state().node);
    const BuiltScene& built = driver.app().scene();
    const Layer* layer = built.scene.find(layer_of(step.stage));
    ASSERT_TRUE(surface && layer) << name(step);
    const std::vector<Segment>& drawn = layer->geometry->segments;
    ASSERT_EQ(drawn.size(), edges.size()) << name(step);
    EXPECT_EQ(driver.drawn(layer_of(step.stage)).segments, std::ssize(edges)) << name(step);
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const auto end = [&](std::size_t k) {
            return built.frame.draw(surface->vertices[static_cast<std::size_t>(edges[i][k].value())]);
        };
        EXPECT_EQ(drawn[i].from, end(0)) << name(step) << " " << i;
        EXPECT_EQ(drawn[i].to, end(1)) << name(step) << " " << i;
    }
}

// What each layer draws at every stage of every node, against the numbers of the cut.
void expect_numbers_of_the_cuts(Driver& driver) {
    const Document& document = driver.document();
    for (const TreeRow& row : document.tree.rows) {
        driver.state().node = row.id;
        driver.state().step = {};
        driver.settle();
        EXPECT_EQ(driver.drawn(LayerKind::surface).triangles, row.facets);
        const Cut* cut = document.trace->find(row.id);
        if (!cut) continue;
        for (const Step& step : steps_of(document, row.id)) {
            driver.state().step = step;
            driver.settle();
            const std::string where = std::to_string(row.id.value()) + " " + name(step);
            const auto interface = static_cast<std::int64_t>(cut->interface.triangles.size());
            switch (step.stage) {
                case Stage::crossed_edges:
                    expect_edges(driver, step, cut->stages.crossed_edges);
                    break;
                case Stage::hanging_removed:
                    expect_edges(driver, step, cut->stages.hanging_edges_removed);
                    break;
                case Stage::closed_loops:
                    expect_edges(driver, step, cut->stages.closed_loops);
                    break;
                case Stage::paths_removed:
                    expect_edges(driver, step, cut->stages.multiple_paths_removed);
                    break;
                case Stage::contour:
                    EXPECT_EQ(driver.drawn(LayerKind::contour).segments, cut->contour_edges) << where;
                    break;
                case Stage::projected:
                    EXPECT_EQ(driver.drawn(LayerKind::projected).segments, cut->contour_edges) << where;
                    break;
                case Stage::triangulation:
                    EXPECT_EQ(driver.drawn(LayerKind::triangulation).triangles, interface) << where;
                    break;
                case Stage::interface:
                    EXPECT_EQ(driver.drawn(LayerKind::interface).triangles, interface) << where;
                    break;
                case Stage::split:
                    EXPECT_EQ(driver.drawn(LayerKind::half).triangles, row.facets + 2 * interface) << where;
                    break;
                default:
                    break;
            }
        }
    }
}

TEST(Layers, HaveTheNumbersOfTheCut) {
    Driver driver;
    driver.show_panels(false);
    driver.open(asset_path("hollow_box"));
    expect_numbers_of_the_cuts(driver);
    const Document& document = driver.document();
    std::int64_t part_facets = 0;
    for (const NodeId part : document.tree.parts_below(root_node)) part_facets += document.tree.find(part)->facets;
    driver.state().node = root_node;
    driver.state().step = {Stage::tetrahedra, -1};
    driver.settle();
    EXPECT_EQ(driver.drawn(LayerKind::part).triangles, part_facets);
}

// Where parts are whole and together what lies between them is not drawn, and nobody sees that it is not: as pictures
// of parts that are apart by next to nothing, which draw all.
TEST(Layers, OfPartsThatAreTogetherDrawNoInside) {
    Driver driver;
    driver.show_panels(false);
    driver.open(asset_path("hollow_box"));
    driver.state().step = {Stage::tetrahedra, -1};
    const auto count_inside = [&] {
        driver.settle();
        std::int64_t inside = 0;
        for (const Layer& layer : driver.app().scene().scene.layers)
            for (const Range& range : layer.ranges) inside += range.inside ? range.count : 0;
        return inside;
    };
    const Image together = driver.picture();
    std::int64_t interfaces = 0;
    for (const NodeId part : driver.document().tree.parts_below(root_node)) {
        const auto surface = driver.app().session().fetched().part_surface(part);
        for (std::int32_t f = 0; surface && f < std::ssize(surface->facets); ++f)
            interfaces += surface->is_interface(f);
    }
    EXPECT_GT(interfaces, 0);
    EXPECT_EQ(count_inside(), interfaces);
    driver.state().explosion.amount = 1e-9;
    EXPECT_EQ(count_inside(), 0);
    EXPECT_LT(compare(together, driver.picture()).differing, most_differing);
    driver.state().explosion.amount = 0;
    driver.state().visibility.set_hidden(NodeId(2), true);
    EXPECT_EQ(count_inside(), 0) << "one looks at the insides";
}

Driver::Options cut_straight() {
    Driver::Options options;
    options.parts = 3;
    options.contour = ContourMethod::straight;
    return options;
}

void expect_facets_of(const NodeSurface& surface, const Layer& layer, const Frame& frame) {
    const Geometry& drawn = *layer.geometry;
    for (std::size_t t = 0; t < drawn.triangle_count(); ++t) {
        Vec3 middle = Vec3::Zero(), expected = Vec3::Zero();
        const auto facet = static_cast<std::size_t>(drawn.element[t]);
        ASSERT_LT(facet, surface.facets.size());
        for (std::size_t k = 0; k < 3; ++k) {
            const auto& [x, y, z] = drawn.corners[3 * t + k].position;
            middle += Vec3(x, y, z) / 3;
            expected += frame.to_draw(surface.vertices[static_cast<std::size_t>(surface.facets[facet][k])]) / 3;
        }
        ASSERT_LT((middle - expected).norm(), 1e-5) << "facet " << facet << " of " << surface.facets.size();
    }
}

// Parts have other numbers in their files than in the trace, where interfaces are triangulated anew after the last cut:
// a click would select another facet than the one that is seen.
TEST(Layers, HaveTheNumbersThatSelectionsUse) {
    Driver driver(cut_straight());
    driver.show_panels(false);
    driver.open(asset_path("cylinder"));
    ASSERT_TRUE(driver.document().trace);
    ViewState& state = driver.state();
    std::map<LayerKind, int> found;
    for (const TreeRow& row : driver.document().tree.rows)
        for (const Stage stage : {Stage::input, Stage::split, Stage::tetrahedra}) {
            SCOPED_TRACE(std::string(name(stage)) + " of node " + std::to_string(row.id.value()));
            state.node = row.id;
            state.step = {stage, -1};
            driver.settle();
            for (const Layer& layer : driver.app().scene().scene.layers) {
                const bool is_of_facets =
                    layer.kind == LayerKind::surface || layer.kind == LayerKind::half || layer.kind == LayerKind::part;
                if (!is_of_facets) continue;
                const auto surface = surface_of(driver.app().session(), layer.owner);
                ASSERT_TRUE(surface);
                expect_facets_of(*surface, layer, driver.app().scene().frame);
                ++found[layer.kind];
            }
        }
    EXPECT_EQ(found[LayerKind::half], 4);
    EXPECT_GT(found[LayerKind::surface], 0);
    EXPECT_GT(found[LayerKind::part], 0);
}

// The surface that the trace has of a part does not stand in for that of its file.
TEST(Selections, WaitForTheNumbersOfTheFile) {
    Driver driver(cut_straight());
    driver.open(asset_path("cylinder"));
    const NodeId part = driver.document().tree.parts_below(root_node).front();
    Session session(kerf_program());
    session.open(driver.document().folder);
    const auto await = [&](const auto& is_there) {
        for (int i = 0; i < 6000 && !is_there(); ++i) session.wait(0.01);
    };
    await([&] { return session.document().trace && session.fetched().surface(part); });
    ASSERT_TRUE(session.fetched().surface(part));
    EXPECT_EQ(surface_of(session, part), nullptr);
    await([&] { return session.fetched().part_surface(part) != nullptr; });
    ASSERT_TRUE(session.fetched().part_surface(part));
    EXPECT_EQ(surface_of(session, part), session.fetched().part_surface(part));
}

// Here multiple paths are removed, and each stage shows its own edges.
TEST(Layers, ShowEveryStageOfAContourThatMeetsItself) {
    const TemporaryFolder folder;
    const Soup ring = uneven_ring();
    write_off(folder.file("ring.off"), ring.vertices, ring.facets);
    Driver::Options options;
    options.parts = 3;
    options.contour = ContourMethod::edges;
    options.volume = false;
    Driver driver(options);
    driver.show_panels(false);
    driver.open(folder.file("ring.off"));
    const ContourStages& stages = driver.document().trace->find(root_node)->stages;
    EXPECT_GT(stages.crossed_edges.size(), stages.hanging_edges_removed.size());
    EXPECT_GT(stages.hanging_edges_removed.size(), stages.closed_loops.size());
    EXPECT_NE(stages.closed_loops, stages.multiple_paths_removed);
    expect_numbers_of_the_cuts(driver);
}

// Lines along the edges of triangles of a few pixels fade, so that a fine mesh is as bright as without them.
TEST(Edges, OfTinyTrianglesFade) {
    const TemporaryFolder folder;
    Driver::Options options;
    options.width = 320;
    options.height = 240;
    options.auto_run = false;
    Driver driver(options);
    driver.show_panels(false);
    const auto darkening = [&](int n) {
        const Soup body = box(Vec3::Zero(), Vec3::Ones(), {n, n, n});
        write_off(folder.file("box.off"), body.vertices, body.facets);
        driver.open(folder.file("box.off"));
        const auto brightness = [&](bool edges) {
            driver.state().look.edges = edges;
            driver.settle();
            const Image picture = driver.picture();
            return std::accumulate(picture.rgb.begin(), picture.rgb.end(), 0.0) /
                   static_cast<double>(picture.rgb.size());
        };
        return 1 - brightness(true) / brightness(false);
    };
    EXPECT_GT(darkening(8), 0.005) << "edges of 15 pixels are seen";
    EXPECT_LT(darkening(48), 1e-4) << "those of 3 are not";
}

// All channels of a pixel by one factor, most of them by none.
TEST(Hollows, AreDarkerInTheSameHue) {
    Driver::Options options;
    options.width = 320;
    options.height = 240;
    options.auto_run = false;
    Driver driver(options);
    driver.show_panels(false);
    driver.open(asset_path("pipe_with_holes"));
    driver.state().look.edges = false;
    driver.settle();
    Scene scene = driver.app().scene().scene;
    std::erase_if(scene.layers, [](const Layer& layer) { return layer.kind != LayerKind::surface; });
    const Projection projection = project(driver.app().camera(), driver.app().scene().frame, driver.app().scene().box,
                                          options.width, options.height);
    const auto drawn = [&] {
        driver.app().renderer().clear(scene.background_bottom);
        driver.app().renderer().draw(scene, projection);
        return driver.app().renderer().read();
    };
    EXPECT_GT(scene.occlusion, 0);
    const Image dark = drawn();
    scene.occlusion = 0;
    const Image bright = drawn();
    int darker = 0;
    for (std::size_t i = 0; i < bright.rgb.size(); i += 3) {
        const double factor = dark.rgb[i] / std::max<double>(1, bright.rgb[i]);
        for (std::size_t k = i; k < i + 3; ++k) ASSERT_NEAR(dark.rgb[k], factor * bright.rgb[k], 3);
        ASSERT_LE(factor, 1);
        darker += factor < 0.8;
    }
    EXPECT_GT(darker, 60) << "the holes";
    EXPECT_LT(darker, 320 * 240 / 4);
}

TEST(StandIn, HasTheShapeOfTheSceneWithFewerTriangles) {
    Scene scene;
    for (const int n : {800, 20}) {
        auto geometry = std::make_shared<Geometry>();
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n / 4; ++j)
                for (const auto& [s, t] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}}) {
                    const double u = 2 * M_PI * (i + s) / n, v = 8 * M_PI * (j + t) / n, r = 0.6 + 0.2 * std::cos(v);
                    const Vec3 p(r * std::cos(u), r * std::sin(u), 0.2 * std::sin(v));
                    Corner corner;
                    for (int k = 0; k < 3; ++k) corner.position[k] = static_cast<float>(p[k]);
                    geometry->corners.push_back(corner);
                }
        Layer& layer = scene.layers.emplace_back();
        const auto half = static_cast<std::uint32_t>(geometry->triangle_count() / 2);
        for (const std::uint32_t first : {0u, half}) {
            Range& range = layer.ranges.emplace_back();
            range.first = first;
            range.count = half;
        }
        layer.geometry = std::move(geometry);
    }
    const Scene coarse = stand_in_for(scene), again = stand_in_for(scene);
    EXPECT_EQ(coarse.layers[1].geometry, scene.layers[1].geometry) << "a small layer stays";
    const Geometry &before = *scene.layers[0].geometry, &after = *coarse.layers[0].geometry;
    EXPECT_LT(after.triangle_count(), before.triangle_count() * 2 / 3);
    EXPECT_GT(after.triangle_count(), before.triangle_count() / 10);
    std::array<double, 2> reach = {};
    for (const auto& [geometry, most] : {std::pair(&before, &reach[0]), {&after, &reach[1]}})
        for (const Corner& c : geometry->corners)
            *most = std::max<double>(*most, std::hypot(c.position[0], c.position[1]));
    EXPECT_NEAR(reach[1], reach[0], 0.01);
    const std::vector<Range>& ranges = coarse.layers[0].ranges;
    EXPECT_GT(ranges[0].count, after.triangle_count() / 3);
    EXPECT_EQ(ranges[1].first, ranges[0].count);
    EXPECT_EQ(ranges[0].count + ranges[1].count, after.triangle_count());
    const Geometry& twin = *again.layers[0].geometry;
    ASSERT_EQ(twin.corners.size(), after.corners.size());
    for (std::size_t i = 0; i < twin.corners.size(); ++i)
        ASSERT_EQ(twin.corners[i].position, after.corners[i].position);
}

// The camera looks along the normal, and what is left fits: half of a long body is seen larger than the whole.
TEST(Clip, IsLookedAt) {
    const TemporaryFolder folder;
    const Soup body = box({0, 0, 0}, {8, 2, 1}, {8, 2, 1});
    write_off(folder.file("box.off"), body.vertices, body.facets);
    Driver::Options options;
    options.auto_run = false;
    Driver driver(options);
    driver.show_panels(false);
    driver.open(folder.file("box.off"));
    ViewState state;
    state.look.context = false;
    const auto camera = [&](const Vec3& normal, double position, bool flipped, bool faces_clip) {
        state.clip = {true, ClipStyle::smooth, normal, position, flipped};
        driver.app().show(state, {.faces_clip = faces_clip});
        driver.settle();
        return driver.app().camera();
    };
    EXPECT_NEAR((camera(Vec3::UnitX(), 0.5, false, true).back() - Vec3::UnitX()).norm(), 0, 1e-12);
    EXPECT_NEAR((camera(Vec3::UnitX(), 0.5, true, true).back() + Vec3::UnitX()).norm(), 0, 1e-12);
    EXPECT_NEAR((driver.app().scene().left.min() - Vec3(4, 0, 0)).norm(), 0, 1e-12);
    EXPECT_NEAR((driver.app().scene().left.max() - Vec3(8, 2, 1)).norm(), 0, 1e-12);
    // From the side, across the long axis, a quarter of the body alone is to fit.
    const double whole = camera(Vec3::UnitZ(), 0.5, false, true).height;
    const Vec3 oblique = Vec3(1, 0, 0.2).normalized();
    const Camera cut = camera(oblique, 0.25, false, true);
    EXPECT_LT(cut.height, 0.6 * whole);
    // As they are seen, near ones larger, the corners of what is left reach about as far to either side of the middle:
    // exactly so before the margin is added.
    const Eigen::AlignedBox3d left = driver.app().scene().left;
    Eigen::AlignedBox2d seen;
    for (int i = 0; i < 8; ++i)
        seen.extend(*seen_from_target(cut, left.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i))));
    EXPECT_LT(seen.center().norm(), 0.02);
    EXPECT_EQ(camera(oblique, 0.25, false, false).back(), camera(oblique, 0.25, true, false).back()) << "the corner";
}

TEST(Layers, GoingBackMakesNothingAgain) {
    Driver driver;
    driver.open(asset_path("cylinder"));
    const std::vector<Step> steps = driver.app().steps();
    const auto visit = [&] {
        for (const Step& step : steps) {
            driver.state().step = step;
            driver.settle();
        }
    };
    visit();
    const std::int64_t made = driver.app().geometry_made();
    visit();
    EXPECT_EQ(driver.app().geometry_made(), made);
}

}  // namespace
}  // namespace kerf::test

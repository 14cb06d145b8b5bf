// Keys, dialogs and panels around the scene, and what one sees of places, cells and colours, as a user works with them.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include <gtest/gtest.h>
#include <imgui.h>

#include "files/io/surface_reader.h"
#include "support/assets.h"
#include "support/temporary_folder.h"
#include "support/write_off.h"
#include "viewer/app/keys.h"
#include "viewer/driver.h"
#include "viewer/model/line_of_sight.h"
#include "viewer/scene/inside/shapes.h"
#include "viewer/scene/selection.h"
#include "viewer/words_on_screen.h"

namespace kerf::test {
namespace {

using namespace view;

Driver::Options only_shown() {
    Driver::Options options;
    options.auto_run = false;
    return options;
}

Driver::Options cut_in_two() {
    Driver::Options options;
    options.parts = 2;
    return options;
}

bool is_visible(Driver& driver, const std::string& label) {
    driver.settle();
    const auto item = driver.app().widgets().find(label);
    return item && item->visible;
}

float top_of(Driver& driver, const std::string& label) {
    driver.settle();
    return driver.app().widgets().find(label).value_or(ItemRect{}).top;
}

using Pixel = std::array<int, 3>;

Pixel pixel_at(const Image& image, int x, int y) {
    const auto at =
        3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
    return {image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]};
}

// A cube that lacks two facets of its lower side, the far one of its first picture.
std::string write_open_cube(const TemporaryFolder& folder) {
    Soup soup = read_surface(asset_path("cube"));
    const double bottom =
        std::min_element(soup.vertices.begin(), soup.vertices.end(), [](const Vec3& a, const Vec3& b) {
            return a.z() < b.z();
        })->z();
    const auto is_at_bottom = [&](const Triangle& t) {
        return std::all_of(t.begin(), t.end(), [&](std::int32_t v) {
            return soup.vertices[static_cast<std::size_t>(v)].z() < bottom + 1e-6;
        });
    };
    std::vector<std::size_t> lower;
    for (std::size_t f = 0; f < soup.facets.size(); ++f)
        if (is_at_bottom(soup.facets[f])) lower.push_back(f);
    for (const std::size_t f : {lower.at(lower.size() / 2), lower.at(lower.size() / 4)})
        soup.facets.erase(soup.facets.begin() + static_cast<std::ptrdiff_t>(f));
    write_off(folder.file("open.off"), soup.vertices, soup.facets);
    return folder.file("open.off");
}

TEST(SceneUi, AFlightToADefectEndsBeforeIt) {
    const TemporaryFolder folder;
    Driver driver;
    driver.open(write_open_cube(folder));
    const auto& defects = driver.document().checked->diagnosis.defects;
    ASSERT_EQ(defects.size(), 2u);
    ASSERT_GT(driver.app().camera().back().z(), 0.3) << "it looks from above";
    driver.click("defect 1");
    EXPECT_LT(driver.app().camera().back().z(), -0.4) << "the lower side is seen from below";
    EXPECT_EQ(driver.app().camera().target, defects[0].where);
    driver.settle();
    EXPECT_GE(driver.drawn(LayerKind::selection).segments, std::ssize(defects[0].facets)) << "its facets are outlined";
    EXPECT_TRUE(driver.app().scene().scene.find(LayerKind::selection)->shines_through);
    EXPECT_NE(driver.app().facts().selection.find("open edge"), std::string::npos);

    // A place that is seen already does not turn the picture; keys go on in the list, and from it.
    const Eigen::Quaterniond turn = driver.app().camera().turn;
    driver.key(key_down);
    EXPECT_EQ(driver.app().camera().target, defects[1].where);
    EXPECT_EQ(driver.state().selection, (Selection{Selection::Kind::defect, root_node, 1, defects[1].where}));
    EXPECT_EQ(driver.app().camera().turn.coeffs(), turn.coeffs());
    driver.key(key_down);
    EXPECT_EQ(driver.state().selection.index, 1) << "the last one";
    driver.key(key_up);
    EXPECT_EQ(driver.state().selection.index, 0);
}

// Turned facets have their normals inside, and what looks over a rim may be hidden by it.
TEST(SceneUi, TheEyeGoesWhereNothingLiesBefore) {
    const Soup soup = read_surface(asset_path("hollow_box"));
    std::vector<Triangle> turned = soup.facets;
    for (Triangle& t : turned) std::swap(t[1], t[2]);
    const auto size = [&](const Vec3& p) { return p.cwiseAbs().maxCoeff(); };
    double diagonal = 0;
    for (const Vec3& p : soup.vertices) diagonal = std::max(diagonal, size(p - soup.vertices[0]));
    int seen = 0, hidden = 0;
    for (std::int32_t f = 0; f < std::ssize(soup.facets); f += 53) {
        Vec3 middle = Vec3::Zero();
        for (const std::int32_t v : soup.facets[static_cast<std::size_t>(f)])
            middle += soup.vertices[static_cast<std::size_t>(v)] / 3;
        const Vec3 outward = mean_normal(soup.vertices, soup.facets, {f});
        for (const Vec3& present : {Vec3(0, 0, 1), Vec3(-1, 0, 0)}) {
            const auto direction = [&](const Vec3& n) {
                return direction_to_eye(soup.vertices, soup.facets, middle, 1e-6 * diagonal, n, present)
                    .value_or(Vec3::Zero());
            };
            const Vec3 to_eye = direction(outward);
            if (to_eye.isZero()) {
                ++hidden;
                continue;
            }
            ++seen;
            EXPECT_GT(to_eye.dot(outward), 0.3) << f;
            EXPECT_GT(direction(-outward).dot(outward), 0.3) << f;
        }
    }
    EXPECT_GT(seen, 50);
    EXPECT_GT(hidden, 5) << "the wall of the void";
    EXPECT_EQ(mean_normal(soup.vertices, turned, {5}), -mean_normal(soup.vertices, soup.facets, {5}));
}

TEST(SceneUi, KeysWithinAFrameAllCount) {
    Driver::Options options;
    options.volume = false;
    Driver driver(options);
    driver.open(asset_path("cube"));
    const std::vector<NodeId> order = {root_node, NodeId(2), NodeId(4)};
    ASSERT_EQ(driver.state().node, order[0]);
    driver.keys_in_one_frame({{.key = key_down}, {.key = key_down}});
    EXPECT_EQ(driver.state().node, order[2]);
    driver.keys_in_one_frame({{.key = key_up}, {.key = key_up, .repeat = true}});
    EXPECT_EQ(driver.state().node, order[0]);
    driver.keys_in_one_frame({{.key = key_of('E')}, {.key = key_of('E')}, {.key = key_of('E'), .repeat = true}});
    EXPECT_TRUE(driver.state().look.edges) << "a held letter counts once";
    driver.keys_in_one_frame({{.key = key_of('Q'), .control = true}});
    EXPECT_TRUE(driver.app().desk().wants_to_quit());
}

TEST(SceneUi, EscapeClosesMenus) {
    Driver driver(only_shown());
    driver.open(asset_path("cube"));
    driver.click("File");
    ASSERT_TRUE(is_visible(driver, "Quit"));
    driver.key(key_escape);
    EXPECT_FALSE(is_visible(driver, "Quit"));
    driver.click("Colour by");
    EXPECT_FALSE(driver.offers("Colour by: von Mises stress")) << "there is no solution";
    EXPECT_FALSE(driver.offers("Colour by: Region"));
    ASSERT_TRUE(driver.app().widgets().find("Colour by: Patch"));
    driver.key(key_escape);
    EXPECT_FALSE(driver.app().widgets().find("Colour by: Patch"));
    driver.key(key_of('E'));
    EXPECT_FALSE(driver.state().look.edges) << "keys are the scene's again";
}

TEST(SceneUi, CtrlOTypesAPathAtOnce) {
    const TemporaryFolder folder;
    std::filesystem::copy_file(asset_path("cube"), folder.file("cube.stl"));
    Driver driver(only_shown());
    driver.key(key_of('O'), true);
    driver.settle();
    driver.type(folder.file("cube.stl"));
    driver.key(key_enter);
    driver.await("the cube", [&] { return driver.document().input_facets == 4660; });
    driver.key(key_of('O'), true);
    driver.settle();
    ASSERT_TRUE(is_visible(driver, "folder path"));
    driver.key(key_escape);
    EXPECT_FALSE(is_visible(driver, "folder path")) << "one Escape closes the dialog";
}

TEST(SceneUi, ASectionThatIsOpenedIsSeen) {
    Driver::Options options = only_shown();
    options.height = 560;  // so that its head is at the very bottom
    Driver driver(options);
    driver.open(asset_path("cube"));
    driver.click("Parameters");
    EXPECT_TRUE(driver.state().panels.parameters);
    EXPECT_TRUE(is_visible(driver, "Run all"));
    EXPECT_TRUE(is_visible(driver, "parts"));
    EXPECT_LT(top_of(driver, "Parameters"), 100);
}

TEST(SceneUi, AFilterMovesNothing) {
    Driver driver(cut_in_two());
    driver.open(asset_path("cube"));
    ViewState& state = driver.state();
    state.step = {Stage::tetrahedra, -1};
    state.coloring.by = ColorBy::min_dihedral;
    state.panels.quality = true;
    driver.await("the worst cells", [&] { return driver.app().widgets().find("worst 1").has_value(); });
    driver.settle();
    const float before = top_of(driver, "Worst cells");
    EXPECT_FALSE(driver.app().widgets().find("Clear filter")->enabled);
    driver.click("Only to");
    driver.key(key_of('A'), true);
    const MeasureHistogram& histogram = *driver.document().histograms[0];
    const double limit = std::ceil(histogram.median);
    driver.type(std::to_string(limit));
    driver.key(key_enter);
    ASSERT_TRUE(state.coloring.filter);
    EXPECT_EQ(state.coloring.filter->high, limit);
    EXPECT_EQ(state.coloring.filter->low, histogram.min);
    driver.settle();
    EXPECT_EQ(top_of(driver, "Worst cells"), before);

    // Where the few cells lie is seen by the outline of the body.
    EXPECT_GT(driver.drawn(LayerKind::outline).segments, 0);
    EXPECT_GT(driver.drawn(LayerKind::cells).triangles, 0);
    driver.click("Clear filter");
    EXPECT_FALSE(state.coloring.filter);
    EXPECT_EQ(top_of(driver, "Worst cells"), before);
    driver.settle();
    EXPECT_EQ(driver.drawn(LayerKind::outline).segments, 0);
}

TEST(SceneUi, TheColourBarCanBeDragged) {
    Driver driver(cut_in_two());
    driver.open(asset_path("cube"));
    ViewState& state = driver.state();
    state.step = {Stage::tetrahedra, -1};
    state.coloring.by = ColorBy::min_dihedral;
    driver.settle();
    const ValueRange all = *driver.app().facts().legend.values;
    const float before = top_of(driver, "histogram");
    driver.drag_over("colour bar", 0.25f, 0.5f);
    ASSERT_TRUE(state.coloring.range);
    const double length = all.high - all.low;
    EXPECT_NEAR(state.coloring.range->low, all.low + 0.25 * length, 0.01 * length);
    EXPECT_NEAR(state.coloring.range->high, all.low + 0.5 * length, 0.01 * length);
    driver.drag_over("colour bar", 0.5f, 0.75f);
    EXPECT_NEAR(state.coloring.range->low, all.low + 0.25 * length, 0.01 * length) << "the upper end alone";
    EXPECT_NEAR(state.coloring.range->high, all.low + 0.75 * length, 0.01 * length);
    EXPECT_EQ(top_of(driver, "histogram"), before);
    driver.click("Lowest");
    driver.key(key_of('A'), true);
    driver.type("7.5");
    driver.key(key_enter);
    EXPECT_EQ(state.coloring.range->low, 7.5);
    driver.click("Fixed range");
    EXPECT_FALSE(state.coloring.range);
}

// The words of every choice, whole.
TEST(SceneUi, AChoiceIsWideEnoughForItsWords) {
    Driver driver(only_shown());
    driver.open(asset_path("cube"));
    const ItemRect combo = *driver.app().widgets().find("Colour by");
    const float room = combo.right - combo.left - (combo.bottom - combo.top) - 2 * ImGui::GetStyle().FramePadding.x;
    for (int i = 0; i < color_by_count; ++i) {
        const char* words = title(static_cast<ColorBy>(i));
        EXPECT_LE(ImGui::CalcTextSize(words).x, room) << words;
    }
}

TEST(SceneUi, ClipsThroughTheSelection) {
    Driver driver(only_shown());
    driver.open(asset_path("cube"));
    ViewState& state = driver.state();
    const Eigen::AlignedBox3d box = driver.document().box;
    const Vec3 place = box.min() + 0.3 * box.sizes();
    const auto distance = [&] { return std::abs(shown_side(state.clip, box).distance(place)) / box.diagonal().norm(); };
    state.selection = {Selection::Kind::place, root_node, -1, place};
    driver.settle();
    state.clip.normal = Vec3(1, 2, 2).normalized();
    driver.click("Through selection");
    EXPECT_TRUE(state.clip.on);
    EXPECT_LT(distance(), 1e-9);
    EXPECT_LT((state.clip.normal - Vec3(1, 2, 2).normalized()).norm(), 1e-12);
    driver.click("Facing me");
    EXPECT_LT(distance(), 1e-9);
    EXPECT_LT((state.clip.normal - driver.app().camera().back()).norm(), 1e-12);
    state.clip = {};
    driver.key(key_of('C'), false, true);
    EXPECT_TRUE(state.clip.on);
    EXPECT_LT(distance(), 1e-9);

    // The same place in units of the file.
    state.clip = {};
    state.clip.on = true;
    driver.click("Clip at");
    driver.key(key_of('A'), true);
    driver.type(std::to_string(place.x()));
    driver.key(key_enter);
    EXPECT_LT(distance(), 1e-6);
}

// Of a picture of coloured cells: the tone of a face that is seen at an angle, against the colour of the legend.
TEST(SceneUi, ColoursAreThoseOfTheLegend) {
    Driver driver(cut_in_two());
    driver.show_panels(false);
    driver.open(asset_path("cube"));
    ViewState& state = driver.state();
    state.step = {Stage::tetrahedra, -1};
    state.coloring.by = ColorBy::min_dihedral;
    state.coloring.range = ValueRange{-2, -1};  // all of them have the last colour
    state.look.edges = state.look.context = state.look.legend = false;
    driver.settle();
    const Color legend = driver.app().facts().legend.scale.back();
    const Vec3 middle = driver.document().box.center();
    for (const auto& [angle, least] : {std::pair(0., 0.95), {70., 0.74}}) {
        Camera camera;
        camera.target = middle - Vec3(0, driver.document().box.sizes().y() / 2, 0);
        camera.height = 0.2 * driver.document().box.sizes().minCoeff();
        camera.perspective = false;
        const double a = angle * M_PI / 180;
        look_from(camera, Vec3(std::sin(a), -std::cos(a), 0));
        state.camera = camera;
        const Image image = driver.picture();
        const Pixel pixel = pixel_at(image, image.width / 2, image.height / 2);
        for (std::size_t k = 0; k < 3; ++k) {
            const double full = 255. * (k == 0 ? legend.r : k == 1 ? legend.g : legend.b);
            EXPECT_GE(pixel[k], least * full - 1) << angle;
            EXPECT_LE(pixel[k], 1.05 * full + 1) << angle;
        }
    }
}

// What takes too long is drawn coarser while the mouse moves it, and whole once it rests or is kept as a picture.
TEST(SceneUi, TurningALargeBodyDrawsAStandIn) {
    Driver::Options options = cut_in_two();
    options.auto_run = false;
    for (const double wanted : {0.0, 1e9}) {
        options.frame_seconds = wanted;
        Driver driver(options);
        driver.open(asset_path("bearing_cap_52k"));
        const auto painted = [&] {
            driver.app().paint();
            std::int64_t triangles = 0;
            for (const DrawnLayer& layer : driver.app().renderer().drawn()) triangles += layer.triangles;
            return triangles;
        };
        const Rectangle scene = driver.app().scene_area();
        const float x = scene.x + scene.width / 2, y = scene.y + scene.height / 2;
        const std::int64_t whole = painted();
        driver.move_to(x, y);
        driver.press();
        for (int i = 1; i < 4; ++i) driver.move_to(x + 20.f * static_cast<float>(i), y);
        if (wanted > 0)
            EXPECT_EQ(painted(), whole);
        else
            EXPECT_LT(painted(), whole);
        driver.settle();
        EXPECT_EQ(painted(), whole) << "the mouse rests, still pressed";
        driver.release();
    }
}

// Wherever there is the body without gaps, there is something of it with gaps.
TEST(SceneUi, NoGapShowsTheBackground) {
    Driver driver(cut_in_two());
    driver.show_panels(false);
    driver.open(asset_path("cylinder"));
    ViewState& state = driver.state();
    state.step = {Stage::tetrahedra, -1};
    state.look.edges = state.look.context = state.look.legend = false;
    const Image whole = driver.picture();
    state.visibility.hidden = {root_node};
    const Image nothing = driver.picture();
    state.visibility.hidden = {};
    state.explosion.shrink = 0.3;
    const Image gaps = driver.picture();
    int body = 0, holes = 0;
    for (int y = 0; y < whole.height; ++y)
        for (int x = 0; x < whole.width; ++x) {
            if (pixel_at(whole, x, y) == pixel_at(nothing, x, y)) continue;
            ++body;
            holes += pixel_at(gaps, x, y) == pixel_at(nothing, x, y);
        }
    EXPECT_GT(body, 10000);
    EXPECT_LT(holes, body / 1000) << "of " << body;
    EXPECT_GT(driver.drawn(LayerKind::cells).triangles, 0);
}

// An inner cell at the interface, its neighbours in both parts, and nothing else.
TEST(SceneUi, ACellAndItsNeighbours) {
    Driver driver(cut_in_two());
    driver.open(asset_path("cube"));
    ViewState& state = driver.state();
    state.step = {Stage::tetrahedra, -1};
    driver.await("the cells", [&] {
        return driver.app().session().fetched().cells(NodeId(2)) && driver.app().session().fetched().cells(NodeId(3)) &&
               driver.app().session().fetched().part_surface(NodeId(2));
    });
    const auto own = driver.app().session().fetched().cells(NodeId(2)),
               other = driver.app().session().fetched().cells(NodeId(3));
    const auto surface = driver.app().session().fetched().part_surface(NodeId(2));
    std::int32_t cell = -1;  // all of its corners lie inside, but for one on the interface alone
    for (std::size_t t = 0; t < own->tets.size() && cell < 0; ++t) {
        int at_interface = 0, at_boundary = 0;
        for (const std::int32_t v : own->tets[t]) {
            if (v >= own->boundary_vertex_count) continue;
            const auto number = own->vertex_number[static_cast<std::size_t>(v)];
            const bool shared = std::find(other->vertex_number.begin(), other->vertex_number.end(), number) !=
                                other->vertex_number.end();
            ++(shared ? at_interface : at_boundary);
        }
        if (at_interface > 0 && at_boundary == 0) cell = static_cast<std::int32_t>(t);
    }
    ASSERT_GE(cell, 0);
    state.selection = {Selection::Kind::cell, NodeId(2), cell, Vec3::Zero()};
    driver.settle();
    EXPECT_EQ(driver.drawn(LayerKind::selected_cell).triangles, 4);
    EXPECT_LT(driver.app().scene().scene.find(LayerKind::part, NodeId(2))->opacity, 1)
        << "it is seen through the others";
    EXPECT_LT(driver.app().scene().scene.find(LayerKind::part, NodeId(3))->opacity, 1);

    driver.click("Neighbours");
    EXPECT_TRUE(state.visibility.neighbours);
    driver.settle();
    EXPECT_EQ(std::ranges::count(words_on_screen(), "Only the selected cell and its neighbours"), 1);
    EXPECT_EQ(driver.drawn(LayerKind::part).triangles, 0);
    EXPECT_GT(driver.drawn(LayerKind::outline).segments, 0);
    std::set<std::int64_t> corners;
    for (const std::int32_t v : own->tets[static_cast<std::size_t>(cell)])
        corners.insert(own->vertex_number[static_cast<std::size_t>(v)]);
    const auto faces_of_ring = [&](const PartCells& cells) {
        const auto is_in = [&](std::int32_t t) {
            return t >= 0 && std::ranges::any_of(cells.tets[static_cast<std::size_t>(t)], [&](std::int32_t v) {
                       return corners.contains(cells.vertex_number[static_cast<std::size_t>(v)]);
                   });
        };
        std::int64_t faces = 0;
        for (std::int32_t t = 0; t < std::ssize(cells.tets); ++t)
            if (is_in(t))
                for (const CellId n : cells.neighbours[static_cast<std::size_t>(t)]) faces += !is_in(n.value());
        return faces;
    };
    EXPECT_GT(faces_of_ring(*other), 0);
    EXPECT_EQ(driver.drawn(LayerKind::cells, NodeId(2)).triangles, faces_of_ring(*own));
    EXPECT_EQ(driver.drawn(LayerKind::cells, NodeId(3)).triangles, faces_of_ring(*other));
    driver.key(key_of('N'));
    EXPECT_FALSE(state.visibility.neighbours);
    driver.key(key_escape);
    driver.settle();
    EXPECT_EQ(driver.drawn(LayerKind::selected_cell).triangles, 0);
    EXPECT_EQ(driver.app().scene().scene.find(LayerKind::part, NodeId(2))->opacity, 1);
}

TEST(SceneUi, KeysGoThroughTheWorstCells) {
    Driver driver(cut_in_two());
    driver.open(asset_path("cylinder"));
    ViewState& state = driver.state();
    state.step = {Stage::tetrahedra, -1};
    state.coloring.by = ColorBy::min_dihedral;
    state.panels.quality = true;
    driver.await("the worst cells", [&] { return driver.app().widgets().find("worst 1").has_value(); });
    state.coloring.by = ColorBy::radius_edge;  // the worst lie inside and at the surface
    driver.await("the largest cells",
                 [&] { return driver.app().session().fetched().worst_cells(state.coloring.by, 100) != nullptr; });
    const auto worst = driver.app().session().fetched().worst_cells(state.coloring.by, 100);
    driver.click("worst 1");
    EXPECT_EQ(state.selection.index, (*worst)[0].cell);
    driver.keys_in_one_frame({{.key = key_down}, {.key = key_down}});
    EXPECT_EQ(state.selection.index, (*worst)[2].cell);
    EXPECT_EQ(driver.app().camera().target, (*worst)[2].center);
    EXPECT_EQ(state.node, root_node) << "the keys are the list's";

    // A cell inside is seen through the others, one at the surface from where the camera goes.
    Session& session = driver.app().session();
    const auto seen_from = [&](const WorstCell& cell, const Vec3& back) {
        driver.await("the cells",
                     [&] { return session.fetched().cells(cell.part) && session.fetched().part_surface(cell.part); });
        return direction_to_cell(*session.fetched().cells(cell.part), *session.fetched().part_surface(cell.part),
                                 *session.fetched().surface(root_node), cell.cell, back);
    };
    std::size_t at = 2;
    for (const bool at_surface : {false, true}) {
        std::size_t next = 3;
        while (next < worst->size() && seen_from((*worst)[next], Vec3::UnitX()).has_value() != at_surface) ++next;
        ASSERT_LT(next, worst->size()) << at_surface;
        const KeyEvent step = {.key = next > at ? key_down : key_up};
        driver.keys_in_one_frame(std::vector<KeyEvent>(next > at ? next - at : at - next, step));
        at = next;
        driver.settle();
        EXPECT_EQ(state.selection.index, (*worst)[at].cell);
        EXPECT_EQ(driver.drawn(LayerKind::selected_cell).triangles, at_surface ? 0 : 4);
    }
    const Vec3 back = driver.app().camera().back();
    EXPECT_LT((seen_from((*worst)[at], back).value_or(Vec3::Zero()) - back).norm(), 1e-9);
    driver.click("node 1");
    driver.key(key_down);
    EXPECT_EQ(state.node, NodeId(2)) << "the keys are the tree's";
}

// One sees the cell that was chosen, whatever its size and wherever the clip plane is.
TEST(WorstCells, AreSeenFromNearby) {
    Driver::Options options;
    options.parts = 2;
    Driver driver(options);
    driver.open(asset_path("cube"));
    ViewState& state = driver.state();
    state.coloring.by = ColorBy::min_dihedral;
    state.panels.quality = true;
    state.clip = {true, ClipStyle::cells, Vec3::UnitX(), 0.01, false};
    driver.await("the list", [&] { return driver.app().widgets().find("worst 1").has_value(); });
    driver.click("worst 1");
    driver.settle();
    ASSERT_EQ(state.selection.kind, Selection::Kind::cell);
    const auto cells = driver.app().session().fetched().cells(state.selection.owner);
    ASSERT_TRUE(cells);
    const Eigen::AlignedBox3d& body = driver.document().box;
    Eigen::AlignedBox3d cell;
    for (const std::int32_t v : cells->tets[static_cast<std::size_t>(state.selection.index)])
        cell.extend(cells->vertices[static_cast<std::size_t>(v)]);
    EXPECT_GT(driver.app().camera().height, 2 * cell.sizes().maxCoeff());
    EXPECT_LT(driver.app().camera().height, 4 * cell.diagonal().norm());
    EXPECT_GE(body.min().x() + state.clip.position * body.sizes().x(), cell.max().x() - 1e-5 * body.sizes().x());
}

}  // namespace
}  // namespace kerf::test

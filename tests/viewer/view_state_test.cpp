// The view state as JSON, the camera, the names of steps, the clip plane of the command line.
#include <random>
#include <tuple>
#include <utility>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "support/shapes.h"
#include "viewer/app/command_line.h"
#include "viewer/model/off_faces.h"
#include "viewer/model/upright.h"
#include "viewer/model/view_state.h"
#include "viewer/scene/inside/shapes.h"

namespace kerf::view {
namespace {

// A point of the file on the screen: pixels from the upper left corner of the viewport; z is the depth in [-1, 1].
Vec3 to_screen(const Projection& projection, const Frame& frame, const Vec3& point) {
    Eigen::Vector4d q;
    q << frame.to_draw(point), 1;
    const Eigen::Vector4d clip = projection.projection.cast<double>() * (projection.view.cast<double>() * q);
    const double w = std::abs(clip.w()) > 1e-12 ? clip.w() : 1e-12;
    return {(clip.x() / w + 1) / 2 * projection.width, (1 - clip.y() / w) / 2 * projection.height, clip.z() / w};
}

ViewState unusual_state() {
    ViewState s;
    s.node = NodeId(13);
    s.step = {Stage::plane, 4};
    s.camera = Camera{{1, 2, 3}, Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5), 7, false};
    s.look.shading = Shading::smooth;
    s.look.edges = s.look.context = s.look.plane = s.look.contour = s.look.surface = s.look.interfaces = s.look.legend =
        s.look.scale_bar = s.look.times = false;
    s.look.axes = false;
    s.look.numbers = false;
    s.coloring.percentile = 95;
    s.look.features = s.look.beside = s.visibility.neighbours = true;
    s.explosion.amount = 0.25;
    s.explosion.shrink = 0.125;
    s.clip = {true, ClipStyle::layer, Vec3(0.6, 0, 0.8), 0.3, true};
    s.coloring.by = ColorBy::radius_edge;
    s.coloring.range = ValueRange{0.5, 3};
    s.coloring.filter = ValueRange{1, 2};
    s.coloring.isolines = s.coloring.extremes = s.deformation.vectors = true;
    s.deformation.load_case = 2;
    s.deformation.factor = 2.5;
    s.deformation.motion = Motion::rise;
    s.deformation.phase = 0.75;
    s.deformation.speed = 1.5;
    s.visibility.hidden = {NodeId(4), NodeId(11)};
    s.visibility.isolated = NodeId(3);
    s.visibility.hidden_regions = {"bone", "cement \xe4"};
    s.visibility.glass_regions = {"void_1"};
    s.visibility.hidden_patches = {"side*"};
    s.visibility.isolated_region = "cement";
    s.visibility.walls = s.explosion.regions = true;
    s.pick = PickMode::vertex;
    s.selection = {Selection::Kind::cell, NodeId(12), 34, {5, 6, 7}};
    s.theme = Theme::dark;
    s.panels = {false, false, false, true, true, true, false};
    return s;
}

// All fields: who adds one has to name it here, and to give it a value above.
auto fields(const ViewState& s) {
    const auto& [node, step, camera, look, visibility, coloring, explosion, deformation, clip, pick, selection, theme,
                 panels] = s;
    return std::tie(node, step, camera, look, visibility, coloring, explosion, deformation, clip, pick, selection,
                    theme, panels);
}
auto fields(const Look& l) {
    const auto& [shading, edges, context, plane, axes, contour, features, surface, interfaces, legend, scale_bar,
                 numbers, times, beside] = l;
    return std::tie(shading, edges, context, plane, axes, contour, features, surface, interfaces, legend, scale_bar,
                    numbers, times, beside);
}
auto fields(const Visibility& v) {
    const auto& [hidden, isolated, hidden_regions, glass_regions, isolated_region, hidden_patches, walls, neighbours] =
        v;
    return std::tie(hidden, isolated, hidden_regions, glass_regions, isolated_region, hidden_patches, walls,
                    neighbours);
}
auto fields(const Coloring& c) {
    const auto& [by, range, filter, percentile, isolines, extremes] = c;
    return std::tie(by, range, filter, percentile, isolines, extremes);
}
auto fields(const Explosion& e) {
    const auto& [amount, regions, shrink] = e;
    return std::tie(amount, regions, shrink);
}
auto fields(const Deformation& d) {
    const auto& [load_case, factor, motion, phase, speed, vectors] = d;
    return std::tie(load_case, factor, motion, phase, speed, vectors);
}
auto fields(const Camera& c) {
    const auto& [target, turn, height, perspective] = c;
    return std::tie(target, turn, height, perspective);
}
auto fields(const Clip& c) {
    const auto& [on, style, normal, position, flipped] = c;
    return std::tie(on, style, normal, position, flipped);
}
auto fields(const Selection& s) {
    const auto& [kind, owner, index, place] = s;
    return std::tie(kind, owner, index, place);
}
auto fields(const Panels& p) {
    const auto& [tree, display, timeline, keys, parameters, quality, problems] = p;
    return std::tie(tree, display, timeline, keys, parameters, quality, problems);
}

template <class... T>
void expect_all_differ(const std::tuple<T...>& a, const std::tuple<T...>& b) {
    const auto expect = [](std::size_t field, bool same) { EXPECT_FALSE(same) << "field " << field; };
    const auto expect_each = [&]<std::size_t... i>(std::index_sequence<i...>) {
        (expect(i, std::get<i>(a) == std::get<i>(b)), ...);
    };
    expect_each(std::index_sequence_for<T...>());
}

TEST(ViewState, ReadsBackWhatItHasWritten) {
    for (const ViewState& state : {ViewState(), unusual_state()})
        EXPECT_TRUE(state_from_json(to_json(state), "it") == state) << to_json(state);
}

// What it was seen of goes with it, and all of that may be missing.
TEST(ViewState, KnowsWhatItWasMadeOf) {
    ViewOrigin origin{"/models/body.stl", {{"parts", "24"}}, 1600, 900, 2, {Vec3(-1, -2, -3), Vec3(4, 5, 6)}}, read,
        none;
    EXPECT_TRUE(state_from_json(to_json(unusual_state(), origin), "it", &read) == unusual_state());
    EXPECT_TRUE(read == origin);
    state_from_json(to_json(unusual_state()), "it", &none);
    EXPECT_TRUE(none == ViewOrigin());
    origin.width = 4;
    EXPECT_THROW(state_from_json(to_json(unusual_state(), origin), "it"), Error);
}

// Of another body the camera keeps its direction only.
TEST(ViewState, FitsAnotherBody) {
    const Eigen::AlignedBox3d unit(Vec3(0, 0, 0), Vec3(1, 1, 1)), far(Vec3(50, 50, 50), Vec3(70, 60, 60));
    ViewState state;
    state.camera = Camera{{0.2, 0.3, 0.4}, Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5), 0.1, false};
    const ViewState before = state;
    ViewOrigin origin;
    fit_to_body(state, origin, far, 1.5);
    EXPECT_TRUE(state == before) << "nobody knows of which body it was";
    origin.body = unit;
    fit_to_body(state, origin, {Vec3(0, 0, 0), Vec3(1, 1, 1.001)}, 1.5);
    EXPECT_TRUE(state == before) << "remeshed";
    fit_to_body(state, origin, far, 1.5);
    EXPECT_EQ(state.camera->target, far.center());
    EXPECT_GT(state.camera->height, 10);
    EXPECT_TRUE(state.camera->turn.isApprox(before.camera->turn));
    EXPECT_FALSE(state.camera->perspective);
}

// Otherwise a field that is neither written nor read would go unnoticed.
TEST(ViewState, TheUnusualOneDiffersInEveryField) {
    const ViewState usual, unusual = unusual_state();
    const Camera usual_camera;
    expect_all_differ(fields(unusual), fields(usual));
    expect_all_differ(fields(*unusual.camera), fields(usual_camera));
    expect_all_differ(fields(unusual.look), fields(usual.look));
    expect_all_differ(fields(unusual.visibility), fields(usual.visibility));
    expect_all_differ(fields(unusual.coloring), fields(usual.coloring));
    expect_all_differ(fields(unusual.explosion), fields(usual.explosion));
    expect_all_differ(fields(unusual.deformation), fields(usual.deformation));
    expect_all_differ(fields(unusual.clip), fields(usual.clip));
    expect_all_differ(fields(unusual.selection), fields(usual.selection));
    expect_all_differ(fields(unusual.panels), fields(usual.panels));
}

TEST(ViewState, MissingFieldsHaveTheirDefaults) {
    EXPECT_EQ(to_json(state_from_json("{}", "it")), to_json(ViewState()));
    EXPECT_EQ(state_from_json(R"({"node": 5})", "it").node, NodeId(5));
}

TEST(ViewState, RefusesWhatItDoesNotKnowAndNamesIt) {
    const auto message = [](const std::string& text) -> std::string {
        try {
            state_from_json(text, "view.json");
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::usage);
            return error.what();
        }
        return "";
    };
    EXPECT_NE(message("{").find("view.json"), std::string::npos);
    EXPECT_NE(message("[]").find("no JSON object"), std::string::npos);
    EXPECT_NE(message(R"({"zoom": 1})").find("'zoom'"), std::string::npos);
    EXPECT_NE(message(R"({"node": "x"})").find("'node'"), std::string::npos);
    EXPECT_NE(message(R"({"stage": "sawing"})").find("closed-loops"), std::string::npos);
    EXPECT_NE(message(R"({"shrink": 2})").find("[0, 1]"), std::string::npos);
    EXPECT_NE(message(R"({"clip": {"normal": [0, 0, 0]}})").find("normal"), std::string::npos);
    EXPECT_NE(message(R"({"camera": {"back": [0, 0, 1], "up": [0, 0, 2]}})").find("parallel"), std::string::npos);
    EXPECT_NE(message(R"({"color": "green"})").find("min-dihedral"), std::string::npos);
}

TEST(ViewState, ANodeIsHiddenWithWhatLiesAboveIt) {
    ViewState s;
    s.visibility.set_hidden(NodeId(5), true);
    s.visibility.set_hidden(NodeId(5), true);
    EXPECT_TRUE(s.visibility.is_hidden(NodeId(5)));
    EXPECT_TRUE(s.visibility.is_hidden(NodeId(21)));
    EXPECT_FALSE(s.visibility.is_hidden(NodeId(2)));
    EXPECT_FALSE(s.visibility.is_hidden(NodeId(4)));
    s.visibility.set_hidden(NodeId(5), false);
    EXPECT_TRUE(s.visibility.hidden.empty());
}

TEST(Steps, HaveNamesThatReadBack) {
    for (int i = 0; i < stage_count; ++i) {
        const Step step{static_cast<Stage>(i), -1};
        EXPECT_EQ(step_from_name(name(step)), step);
    }
    EXPECT_EQ(step_from_name("try:17"), (Step{Stage::plane, 17}));
    for (const char* text : {"", "try:", "try:-1", "try:x", "Contour"})
        EXPECT_THROW(step_from_name(text), Error) << text;
}

TEST(Camera, JsonKeepsWhereItLooks) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-1, 1);
    for (int i = 0; i < 100; ++i) {
        Camera camera;
        camera.turn = Eigen::Quaterniond(number(random), number(random), number(random), number(random)).normalized();
        camera.target = {number(random), number(random), number(random)};
        const Camera read = camera_from_json(to_json(camera), "it");
        EXPECT_EQ(read.turn.coeffs(), camera.turn.coeffs());
        EXPECT_EQ(read.target, camera.target);
        EXPECT_EQ(read.height, camera.height);
    }
}

TEST(Camera, ReadsWhatPeopleWrite) {
    const Camera camera = camera_from_json(R"({"back": [0, -2, 0], "up": [0, 0, 1], "height": 3})", "it");
    Camera front;
    look_from(front, Direction::front);
    EXPECT_LT((camera.back() - front.back()).norm() + (camera.up() - front.up()).norm(), 1e-12);
    EXPECT_EQ(camera.height, 3);
}

TEST(Camera, LooksFromASideWithAnAxisUp) {
    const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
    const auto expect = [](Direction direction, int up_axis, const Vec3& right, const Vec3& up) {
        Camera camera;
        look_from(camera, direction, up_axis);
        EXPECT_LT((camera.right() - right).norm() + (camera.up() - up).norm(), 1e-12);
        EXPECT_LT((camera.back() - right.cross(up)).norm(), 1e-12);
    };
    expect(Direction::front, 2, x, z);
    expect(Direction::front, 1, x, y);
    expect(Direction::front, 0, y, x);
    expect(Direction::right, 1, -z, y);
    expect(Direction::top, 1, x, -z);
    expect(Direction::top, 0, y, z);
}

const Eigen::AlignedBox3d box(Vec3(10, 20, 30), Vec3(14, 22, 31));

// z, but for bodies of programs that have y up, which stand or lie along it.
TEST(Camera, GuessesWhatIsUp) {
    const auto up = [](const char* path, const char* run_of, const Vec3& size) {
        Document document;
        document.path = path;
        document.options.input = run_of;
        document.box = Eigen::AlignedBox3d(Vec3(Vec3::Zero()), size);
        return guessed_up(document);
    };
    EXPECT_EQ(up("skull.obj", "", {8.7, 13.9, 12.1}), 1);
    EXPECT_EQ(up("run", "skull.OBJ", {8.7, 13.9, 12.1}), 1) << "a run looks like its surface";
    EXPECT_EQ(up("terrain.obj", "", {90, 8, 70}), 1);
    EXPECT_EQ(up("bust.obj", "", {2.4, 3.6, 5}), 2);
    EXPECT_EQ(up("car.obj", "", {4.6, 2, 1.4}), 2);
    EXPECT_EQ(up("cube.obj", "", {1, 1, 1}), 2);
    EXPECT_EQ(up("bracket.stl", "", {8.7, 13.9, 12.1}), 2);
}

// However coarse it is, the outline of a body touches two borders of the picture.
TEST(Camera, FillsThePictureWithAnOutline) {
    std::vector<Vec3> ball;
    for (int i = 0; i < 400; ++i) {
        const double z = 1 - (i + 0.5) / 200, turn = 2.4 * i, r = std::sqrt(1 - z * z);
        ball.emplace_back(5 + r * std::cos(turn), r * std::sin(turn), z);
    }
    const Frame frame = Frame::around({Vec3(4, -1, -1), Vec3(6, 1, 1)});
    Camera camera;
    look_from(camera, Direction::corner);
    fit(camera, ball, 1.5);
    const Projection projection = project(camera, frame, {Vec3(4, -1, -1), Vec3(6, 1, 1)}, 900, 600);
    Eigen::AlignedBox3d seen;
    for (const Vec3& p : ball) seen.extend(to_screen(projection, frame, p));
    EXPECT_NEAR(seen.sizes().y(), 600 / 1.08, 5);
    EXPECT_NEAR(seen.center().x(), 450, 1);
    EXPECT_NEAR(seen.center().y(), 300, 1);
}

TEST(Camera, FitsTheWholeBoxWhateverTheDirection) {
    const Frame frame = Frame::around(box);
    for (const Direction direction : {Direction::front, Direction::back, Direction::right, Direction::left,
                                      Direction::top, Direction::bottom, Direction::corner})
        for (const auto& [width, height] : {std::pair(1280, 800), std::pair(300, 900)})
            for (const bool perspective : {true, false}) {
                Camera camera;
                camera.perspective = perspective;
                look_from(camera, direction);
                fit(camera, box, static_cast<double>(width) / height);
                const Projection projection = project(camera, frame, box, width, height);
                double largest = 0;
                for (int i = 0; i < 8; ++i) {
                    const Vec3 p =
                        to_screen(projection, frame, box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)));
                    EXPECT_GE(std::min(p.x(), p.y()), 0);
                    EXPECT_LE(p.x(), width);
                    EXPECT_LE(p.y(), height);
                    EXPECT_LE(std::abs(p.z()), 1);
                    largest = std::max({largest, std::abs(2 * p.x() / width - 1), std::abs(2 * p.y() / height - 1)});
                }
                EXPECT_GT(largest, 0.8) << "too small";
            }
}

TEST(Camera, ZoomKeepsWhatIsAtTheCursor) {
    const Frame frame = Frame::around(box);
    Camera camera;
    look_from(camera, Direction::corner);
    fit(camera, box, 1.5);
    // A point of the plane through the target.
    const Vec3 place = camera.target + camera.height * (0.3 * camera.right() - 0.2 * camera.up());
    const Vec3 before = to_screen(project(camera, frame, box, 900, 600), frame, place);
    zoom_at(camera, 0.5, 0.3, -0.2);
    const Vec3 after = to_screen(project(camera, frame, box, 900, 600), frame, place);
    EXPECT_LT((before - after).head<2>().norm(), 1e-3);
}

TEST(Camera, FocusingKeepsThePicture) {
    const Frame frame = Frame::around(box);
    for (const bool perspective : {true, false}) {
        Camera camera;
        camera.perspective = perspective;
        look_from(camera, Direction::corner);
        fit(camera, box, 1.5);
        const Vec3 place = box.min(), other = box.max();
        const Projection before = project(camera, frame, box, 900, 600);
        focus_depth(camera, place);
        EXPECT_NEAR((place - camera.target).dot(camera.back()), 0, 1e-9);
        const Projection after = project(camera, frame, box, 900, 600);
        for (const Vec3& p : {place, other})
            EXPECT_LT((to_screen(before, frame, p) - to_screen(after, frame, p)).head<2>().norm(), 1e-2);
    }
}

TEST(Camera, PanMovesTheTargetPlaneWithTheCursor) {
    const Frame frame = Frame::around(box);
    Camera camera;
    look_from(camera, Direction::front);
    fit(camera, box, 1.5);
    const Vec3 place = camera.target;
    pan(camera, 0.1, 0.05);
    const Vec3 p = to_screen(project(camera, frame, box, 900, 600), frame, place);
    EXPECT_NEAR(p.x(), 450 + 60, 1e-3);
    EXPECT_NEAR(p.y(), 300 + 30, 1e-3);
}

TEST(Camera, OrbitKeepsUpUpAndTheTargetInPlace) {
    Camera camera;
    look_from(camera, Direction::front);
    for (int i = 0; i < 50; ++i) orbit(camera, 0.013 * i, 0.0);
    EXPECT_NEAR(camera.up().z(), 1, 1e-9);
    orbit(camera, 0, 0.25);
    EXPECT_GT(camera.back().z(), 0.5) << "the cursor pulls the body down, so one looks from above";
    EXPECT_EQ(camera.target, Vec3::Zero());
}

TEST(ClipText, NamesAxesNormalsAndNodes) {
    Document document;
    document.box = box;
    const Clip x = clip_from_text("x=0.3", {}, document);
    EXPECT_TRUE(x.on);
    EXPECT_EQ(x.normal, Vec3::UnitX());
    EXPECT_EQ(x.position, 0.3);
    EXPECT_FALSE(x.flipped);
    EXPECT_TRUE(clip_from_text("-z=0.5", {}, document).flipped);
    EXPECT_LT((clip_from_text("1,1,0=0.5", {}, document).normal - Vec3(1, 1, 0).normalized()).norm(), 1e-15);
    TreeRow& row = document.tree.at(root_node);
    row.cut.emplace().strategy = CutStrategy::first_try;
    row.cut->plane = Plane(Vec3(11, 21, 30.5), Vec3(0, 0.6, 0.8));
    const ShownSide side = shown_side(clip_from_text("node=1", {}, document), box);
    EXPECT_NEAR(side.distance(row.plane()->origin), 0, 1e-12);
    EXPECT_LT((side.normal - row.plane()->normal).norm(), 1e-15);
    for (const char* text : {"", "x", "w=1", "x=", "1,2=0.5", "node=x", "0,0,0=1", "node=3", "x=5", "y=-0.1"})
        EXPECT_THROW(clip_from_text(text, {}, document), Error) << text;
}

// Of two blocks along x, whose faces lie at 0, 0.5, 0.6 and 1 of the whole.
TEST(ClipPlane, KeepsOffFacesOfTheBody) {
    NodeSurface blocks;
    for (const Soup& block :
         {test::box({0, 0, 0}, {5, 4, 4}, {2, 2, 2}), test::box({6, 0, 0}, {10, 4, 4}, {2, 2, 2})}) {
        const auto first = static_cast<std::int32_t>(blocks.vertices.size());
        blocks.vertices.insert(blocks.vertices.end(), block.vertices.begin(), block.vertices.end());
        for (const Triangle& t : block.facets) blocks.facets.push_back({first + t[0], first + t[1], first + t[2]});
    }
    const Eigen::AlignedBox3d whole(Vec3(0, 0, 0), Vec3(10, 4, 4));
    const auto moved = [&](double position, const Vec3& normal = Vec3::UnitX()) {
        Clip clip{.normal = normal, .position = position};
        keep_off_faces(clip, blocks, whole);
        return clip.position;
    };
    EXPECT_DOUBLE_EQ(moved(0.502), 0.516) << "in the middle of the gap between face and reach";
    EXPECT_DOUBLE_EQ(moved(0.598), 0.584);
    EXPECT_DOUBLE_EQ(moved(0.5), 0.485) << "of two gaps alike the first";
    for (const double position : {0.0, 0.3, 0.52, 1.0}) EXPECT_EQ(moved(position), position);
    EXPECT_EQ(moved(0.45, Vec3::UnitY()), 0.45) << "no face has this direction there";
    EXPECT_EQ(moved(0.5, Vec3(1, 1, 0).normalized()), 0.5);
}

TEST(ClipPlane, DrawCoordinatesAgreeWithThoseOfTheFile) {
    Clip clip;
    clip.on = true;
    clip.normal = Vec3(1, 2, -2) / 3;
    clip.position = 0.7;
    const Frame frame = Frame::around(box);
    for (const bool flipped : {false, true}) {
        clip.flipped = flipped;
        const ShownSide side = shown_side(clip, box);
        const ClipPlane plane = clip_plane(side, frame);
        for (int i = 0; i < 8; ++i) {
            const Vec3 p = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
            const auto q = frame.draw(p);
            const double value = plane.plane[0] * q[0] + plane.plane[1] * q[1] + plane.plane[2] * q[2] + plane.plane[3];
            EXPECT_NEAR(value, -side.distance(p) * frame.scale, 1e-6);
        }
    }
}

TEST(ViewCommandLine, RefusesNonsenseWithCodeTwo) {
    const auto parse = [](std::vector<const char*> arguments) {
        arguments.insert(arguments.begin(), "kerf");
        return parse_view_command(static_cast<int>(arguments.size()), arguments.data());
    };
    EXPECT_EQ(parse({"screenshot", "a.stl"}).exit_code, 2);
    EXPECT_EQ(parse({"screenshot", "a.stl", "-o", "b.png", "--resolution", "10"}).exit_code, 2);
    EXPECT_EQ(parse({"screenshot", "a.stl", "-o", "b.png", "--resolution", "1x1"}).exit_code, 2);
    EXPECT_EQ(parse({"screenshot", "a.stl", "-o", "b.png", "--stage", "sawing"}).exit_code, 2);
    EXPECT_EQ(parse({"screenshot", "a.stl", "-o", "b.png", "--clip", "q=1"}).exit_code, 2);
    EXPECT_EQ(parse({"screenshot", "a.stl", "-o", "b.png", "--color", "green"}).exit_code, 2);
    EXPECT_EQ(parse({"screenshot", "a.stl", "-o", "b.png", "--camera", "/nowhere.json"}).exit_code, 7);
    EXPECT_EQ(parse({"view", "--wat"}).exit_code, 2);
    for (const char* scale : {"0", "-1", "nan", "mm"})
        EXPECT_EQ(parse({"screenshot", "a.stl", "-o", "b.png", "--scale", scale}).exit_code, 2) << scale;
    EXPECT_EQ(parse({"view", "a.stl", "--scale", "0.001"}).run.input_options.scale, 0.001);
    EXPECT_EQ(parse({"view", "a.stl", "--view", "above"}).exit_code, 2);
    EXPECT_EQ(parse({"view", "a.stl", "--up", "w"}).exit_code, 2);
    EXPECT_EQ(parse({"view", "a.stl", "--view", "top", "--camera", "a.json"}).exit_code, 2);
    EXPECT_FALSE(parse({"view", "a.stl"}).chosen.from);
    const ViewCommand turned = parse({"screenshot", "a.stl", "-o", "b.png", "--view", "left", "--up", "y"});
    EXPECT_EQ(turned.chosen.from, Direction::left) << turned.print;
    EXPECT_EQ(turned.chosen.up, 1);
    EXPECT_EQ(parse({"view", "a.stl", "--up", "x"}).chosen.from, Direction::corner);
    EXPECT_FALSE(parse({"view", "a.stl", "--view", "front"}).chosen.up) << "it is guessed";
    const ViewCommand help = parse({"screenshot", "--help"});
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_NE(help.print.find("--explode"), std::string::npos);
    const ViewCommand good =
        parse({"screenshot", "a.stl", "-o", "b.png", "--node", "5", "--stage", "contour", "--clip", "x=0.3",
               "--explode", "0.4", "--color", "min-dihedral", "--resolution", "1600x1000", "--ui"});
    EXPECT_EQ(good.print, "");
    EXPECT_TRUE(good.screenshot && good.picture.panels);
    EXPECT_EQ(good.picture.width, 1600);
    EXPECT_EQ(good.picture.height, 1000);
    EXPECT_EQ(good.state.node, NodeId(5));
    EXPECT_EQ(name(good.state.step), "contour");
    EXPECT_TRUE(good.state.clip.on);
    EXPECT_EQ(good.state.coloring.by, ColorBy::min_dihedral);
}

// Coordinates of a body that should lie about the origin are off by rounding.
TEST(Clip, IsWhereItIsWithoutTheDigitsOfRounding) {
    Clip clip;
    const Eigen::AlignedBox3d body(Vec3(-2.2201678, -1, -1), Vec3(2.22, 1, 1));
    EXPECT_EQ(position_of(clip, body), 0);
    clip.position = 0.75;
    EXPECT_NEAR(position_of(clip, body), 1.10996, 1e-5);
    keep(clip, {{1.5, 0, 0}}, body);
    EXPECT_GE(position_of(clip, body), 1.5 - 1e-5);
    keep(clip, {{-1, 0, 0}}, body);
    EXPECT_GE(position_of(clip, body), 1.5 - 1e-5) << "it is shown already";
    clip.flipped = true;
    keep(clip, {{-1, 0, 0}}, body);
    EXPECT_LE(position_of(clip, body), -1 + 1e-5);
}

}  // namespace
}  // namespace kerf::view

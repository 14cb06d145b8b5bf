// The state is written as JSON and read by names. Enumerations have an array of names in the order of their values.
// Switches are lists of names and addresses (switches()), by which both directions work; all other fields are named in
// to_json() and in state_from_json(), and a new one needs both. read_fields() refuses a name that is unknown, with the
// list of those that are known, and names the field whose value has a wrong type: files are written by hand, too, and a
// typing error must not be silent. A quaternion of length 1 is not normalised again, so that a camera is read back bit
// for bit. A camera is fitted anew only to a body whose box differs by more than a hundredth of its diagonal: remeshing
// does not move the view.
#include "viewer/model/view_state.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/core/error.h"
#include "files/io/json.h"
#include "files/io/path_text.h"
#include "viewer/model/inside/name_index.h"

namespace kerf::view {

namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr std::array<const char*, 2> shading_names = {"flat", "smooth"};
constexpr std::array<const char*, 3> clip_names = {"cells", "smooth", "layer"};
constexpr std::array<const char*, 3> motion_names = {"still", "swing", "rise"};
constexpr std::array<const char*, 2> theme_names = {"light", "dark"};
constexpr std::array<const char*, 3> pick_names = {"facet", "cell", "vertex"};
constexpr std::array<const char*, 6> selection_names = {"none", "facet", "cell", "vertex", "place", "defect"};

OrderedJson write(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Vec3 vector_from(const OrderedJson& json) {
    const auto numbers = json.get<std::array<double, 3>>();
    return {numbers[0], numbers[1], numbers[2]};
}

OrderedJson write(const ValueRange& range) { return {range.low, range.high}; }

ValueRange range_from(const OrderedJson& json) {
    const auto numbers = json.get<std::array<double, 2>>();
    return {numbers[0], numbers[1]};
}

OrderedJson write_names(const std::vector<std::string>& names) {
    OrderedJson json = OrderedJson::array();
    for (const std::string& name : names) json.push_back(path_text(name));
    return json;
}

void read_names(const OrderedJson& json, std::vector<std::string>& names) {
    for (const OrderedJson& name : json) set_member(names, path_of_text(name.get<std::string>()), true);
}

OrderedJson write(const Camera& camera) {
    return {{"target", write(camera.target)},
            {"turn", {camera.turn.w(), camera.turn.x(), camera.turn.y(), camera.turn.z()}},
            {"height", camera.height},
            {"perspective", camera.perspective}};
}

// Calls the function of each field that is there; a name without one is an error of the user.
using Fields = std::vector<std::pair<const char*, std::function<void(const OrderedJson&)>>>;
void read_fields(const OrderedJson& json, const Fields& fields, const std::string& source) {
    if (!json.is_object()) throw Error(ErrorCode::usage, source + " is no JSON object.");
    for (const auto& [key, value] : json.items()) {
        const auto field =
            std::find_if(fields.begin(), fields.end(), [&name = key](const auto& f) { return name == f.first; });
        if (field == fields.end()) {
            std::vector<const char*> known;
            for (const auto& f : fields) known.push_back(f.first);
            throw Error(ErrorCode::usage, fmt::format("{} has the field '{}', which is none of {}.", source, key,
                                                      fmt::join(known, ", ")));
        }
        try {
            field->second(value);
        } catch (const nlohmann::json::exception&) {
            throw Error(ErrorCode::usage, fmt::format("{}: '{}' cannot be {}.", source, key, json_text(value)));
        }
    }
}

Camera camera_from(const OrderedJson& json, const std::string& source) {
    Camera camera;
    std::optional<Eigen::Quaterniond> turn;
    Vec3 back = Vec3::UnitZ(), up = Vec3::UnitY();
    read_fields(json,
                {{"target", [&](const OrderedJson& j) { camera.target = vector_from(j); }},
                 {"turn",
                  [&](const OrderedJson& j) {
                      const auto q = j.get<std::array<double, 4>>();
                      turn.emplace(q[0], q[1], q[2], q[3]);
                  }},
                 {"back", [&](const OrderedJson& j) { back = vector_from(j); }},
                 {"up", [&](const OrderedJson& j) { up = vector_from(j); }},
                 {"height", [&](const OrderedJson& j) { camera.height = j.get<double>(); }},
                 {"perspective", [&](const OrderedJson& j) { camera.perspective = j.get<bool>(); }}},
                source);
    const auto refuse = [&](const char* what) { throw Error(ErrorCode::usage, fmt::format("{}: {}", source, what)); };
    if (!(camera.height > 0)) refuse("'height' must be positive.");
    if (turn) {
        if (!(turn->norm() > 0)) refuse("'turn' must not be zero.");
        // A camera that was written reads back bit for bit.
        camera.turn = std::abs(turn->norm() - 1) < 1e-12 ? *turn : turn->normalized();
        return camera;
    }
    const Vec3 right = up.cross(back);
    if (!(right.norm() > 1e-9 * up.norm() * back.norm())) refuse("'back' and 'up' must not be parallel or zero.");
    Eigen::Matrix3d columns;
    columns << right.normalized(), back.cross(right).normalized(), back.normalized();
    camera.turn = Eigen::Quaterniond(columns).normalized();
    return camera;
}

OrderedJson write(const Clip& clip) {
    return {{"on", clip.on},
            {"style", name(clip.style)},
            {"normal", write(clip.normal)},
            {"position", clip.position},
            {"flipped", clip.flipped}};
}

Clip clip_from(const OrderedJson& json, const std::string& source) {
    Clip clip;
    read_fields(json,
                {{"on", [&](const OrderedJson& j) { clip.on = j.get<bool>(); }},
                 {"style", [&](const OrderedJson& j) { clip.style = clip_style_from_name(j.get<std::string>()); }},
                 {"normal", [&](const OrderedJson& j) { clip.normal = vector_from(j); }},
                 {"position", [&](const OrderedJson& j) { clip.position = j.get<double>(); }},
                 {"flipped", [&](const OrderedJson& j) { clip.flipped = j.get<bool>(); }}},
                source);
    if (!(clip.normal.norm() > 0))
        throw Error(ErrorCode::usage, source + ": the 'normal' of the clip plane must not be zero.");
    clip.normal.normalize();
    return clip;
}

OrderedJson write(const Selection& selection) {
    return {{"kind", selection_names[static_cast<std::size_t>(selection.kind)]},
            {"owner", selection.owner},
            {"index", selection.index},
            {"place", write(selection.place)}};
}

Selection selection_from(const OrderedJson& json, const std::string& source) {
    Selection s;
    read_fields(json,
                {{"kind",
                  [&](const OrderedJson& j) {
                      s.kind = value_named<Selection::Kind>(selection_names, j.get<std::string>(), "kind of selection");
                  }},
                 {"owner", [&](const OrderedJson& j) { s.owner = j.get<NodeId>(); }},
                 {"index", [&](const OrderedJson& j) { s.index = j.get<std::int32_t>(); }},
                 {"place", [&](const OrderedJson& j) { s.place = vector_from(j); }}},
                source);
    return s;
}

// The switches of a value, by name; writing and reading use the same list.
std::vector<std::pair<const char*, bool*>> switches(ViewState& s) {
    return {{"edges", &s.look.edges},
            {"context", &s.look.context},
            {"plane", &s.look.plane},
            {"contour", &s.look.contour},
            {"surface", &s.look.surface},
            {"interfaces", &s.look.interfaces},
            {"legend", &s.look.legend},
            {"scale_bar", &s.look.scale_bar},
            {"features", &s.look.features},
            {"times", &s.look.times},
            {"beside", &s.look.beside},
            {"isolines", &s.coloring.isolines},
            {"extremes", &s.coloring.extremes},
            {"vectors", &s.deformation.vectors},
            {"neighbours", &s.visibility.neighbours},
            {"numbers", &s.look.numbers},
            {"walls", &s.visibility.walls},
            {"explode_regions", &s.explosion.regions}};
}
std::vector<std::pair<const char*, bool*>> switches(Panels& p) {
    return {{"tree", &p.tree},        {"display", &p.display},       {"timeline", &p.timeline},
            {"keys", &p.keys},        {"parameters", &p.parameters}, {"quality", &p.quality},
            {"problems", &p.problems}};
}

template <class Value>
OrderedJson write_switches(Value value) {
    OrderedJson json = OrderedJson::object();
    for (const auto& [name, place] : switches(value)) json[name] = *place;
    return json;
}

template <class Value>
void add_switches(Value& value, Fields& fields) {
    for (const auto& [name, place] : switches(value))
        fields.emplace_back(name, [place = place](const OrderedJson& j) { *place = j.get<bool>(); });
}

OrderedJson write(const ViewOrigin& origin) {
    OrderedJson json = OrderedJson::object();
    if (!origin.input.empty()) json["input"] = path_text(origin.input);
    for (const OptionText& option : origin.run) json["run"][option.name] = path_text(option.text);
    if (origin.width > 0) json["size"] = {origin.width, origin.height, origin.scale};
    if (!origin.body.isEmpty()) json["body"] = {write(Vec3(origin.body.min())), write(Vec3(origin.body.max()))};
    return json;
}

void add_origin(ViewOrigin& origin, Fields& fields, const std::string& source) {
    fields.emplace_back("input", [&](const OrderedJson& j) { origin.input = path_of_text(j.get<std::string>()); });
    fields.emplace_back("run", [&](const OrderedJson& j) {
        for (const auto& [option, text] : j.items())
            origin.run.push_back({option, path_of_text(text.get<std::string>())});
    });
    fields.emplace_back("size", [&, source](const OrderedJson& j) {
        const auto numbers = j.get<std::array<double, 3>>();
        const auto is_good = [](double pixels) { return pixels >= 16 && pixels <= 16384; };
        if (!is_good(numbers[0]) || !is_good(numbers[1]) || !(numbers[2] > 0 && numbers[2] <= 16))
            throw Error(ErrorCode::usage, fmt::format("{}: 'size' is {}, but it must be width and height in pixels, "
                                                      "16 to 16384, and the scale of fonts, up to 16.",
                                                      source, json_text(j)));
        origin.width = static_cast<int>(numbers[0]);
        origin.height = static_cast<int>(numbers[1]);
        origin.scale = numbers[2];
    });
    fields.emplace_back("body", [&](const OrderedJson& j) {
        origin.body = Eigen::AlignedBox3d(vector_from(j.at(0)));
        origin.body.extend(vector_from(j.at(1)));
    });
}

OrderedJson parse(const std::string& text, const std::string& source) {
    try {
        return parse_ordered_json(text);
    } catch (const nlohmann::json::exception& e) {
        throw Error(ErrorCode::usage, fmt::format("{} is no JSON: {}.", source, e.what()));
    }
}

}  // namespace

const char* name(Motion motion) { return motion_names[static_cast<std::size_t>(motion)]; }
Motion motion_from_name(const std::string& text) { return value_named<Motion>(motion_names, text, "motion"); }
const char* name(ClipStyle style) { return clip_names[static_cast<std::size_t>(style)]; }
ClipStyle clip_style_from_name(const std::string& text) {
    return value_named<ClipStyle>(clip_names, text, "clip style");
}

std::string to_json(const Camera& camera) { return json_text(write(camera), 2) + "\n"; }

Camera camera_from_json(const std::string& text, const std::string& source) {
    return camera_from(parse(text, source), source);
}

bool ViewOrigin::operator==(const ViewOrigin& o) const {
    const auto is_same = [](const OptionText& a, const OptionText& b) { return a.name == b.name && a.text == b.text; };
    return input == o.input && std::equal(run.begin(), run.end(), o.run.begin(), o.run.end(), is_same) &&
           width == o.width && height == o.height && scale == o.scale && body.isEmpty() == o.body.isEmpty() &&
           (body.isEmpty() || (body.min() == o.body.min() && body.max() == o.body.max()));
}

std::string to_json(const ViewState& state, const ViewOrigin& origin) {
    OrderedJson json = write(origin);
    json["node"] = state.node;
    json["stage"] = name(state.step);
    if (state.camera) json["camera"] = write(*state.camera);
    json["shading"] = shading_names[static_cast<std::size_t>(state.look.shading)];
    json.update(write_switches(state));
    if (state.look.axes) json["axes"] = *state.look.axes;
    json["explode"] = state.explosion.amount;
    json["shrink"] = state.explosion.shrink;
    json["clip"] = write(state.clip);
    json["color"] = name(state.coloring.by);
    if (state.coloring.range) json["color_range"] = write(*state.coloring.range);
    if (state.coloring.filter) json["filter"] = write(*state.coloring.filter);
    json["percentile"] = state.coloring.percentile;
    json["load_case"] = state.deformation.load_case;
    json["deform"] = state.deformation.factor;
    json["motion"] = name(state.deformation.motion);
    json["phase"] = state.deformation.phase;
    json["speed"] = state.deformation.speed;
    json["hidden"] = state.visibility.hidden;
    if (state.visibility.isolated) json["isolated"] = *state.visibility.isolated;
    json["hidden_regions"] = write_names(state.visibility.hidden_regions);
    json["hidden_patches"] = write_names(state.visibility.hidden_patches);
    json["glass_regions"] = write_names(state.visibility.glass_regions);
    if (state.visibility.isolated_region) json["isolated_region"] = path_text(*state.visibility.isolated_region);
    json["pick"] = pick_names[static_cast<std::size_t>(state.pick)];
    json["selection"] = write(state.selection);
    json["theme"] = theme_names[static_cast<std::size_t>(state.theme)];
    json["panels"] = write_switches(state.panels);
    return json_text(json, 2) + "\n";
}

ViewState state_from_json(const std::string& text, const std::string& source, ViewOrigin* origin) {
    ViewState s;
    ViewOrigin unused;
    const auto unit = [&](const char* field, const OrderedJson& j) {
        const double value = j.get<double>();
        if (!(value >= 0 && value <= 1))
            throw Error(ErrorCode::usage,
                        fmt::format("{}: '{}' is {}, but it must be in [0, 1].", source, field, value));
        return value;
    };
    Fields fields = {
        {"node", [&](const OrderedJson& j) { s.node = j.get<NodeId>(); }},
        {"stage", [&](const OrderedJson& j) { s.step = step_from_name(j.get<std::string>()); }},
        {"camera", [&](const OrderedJson& j) { s.camera = camera_from(j, source); }},
        {"shading",
         [&](const OrderedJson& j) {
             s.look.shading = value_named<Shading>(shading_names, j.get<std::string>(), "shading");
         }},
        {"axes", [&](const OrderedJson& j) { s.look.axes = j.get<bool>(); }},
        {"explode", [&](const OrderedJson& j) { s.explosion.amount = std::max(0.0, j.get<double>()); }},
        {"shrink", [&](const OrderedJson& j) { s.explosion.shrink = unit("shrink", j); }},
        {"clip", [&](const OrderedJson& j) { s.clip = clip_from(j, source); }},
        {"color", [&](const OrderedJson& j) { s.coloring.by = color_by_from_name(j.get<std::string>()); }},
        {"color_range", [&](const OrderedJson& j) { s.coloring.range = range_from(j); }},
        {"filter", [&](const OrderedJson& j) { s.coloring.filter = range_from(j); }},
        {"percentile",
         [&](const OrderedJson& j) {
             s.coloring.percentile = j.get<double>();
             if (!(s.coloring.percentile >= least_percentile && s.coloring.percentile <= 100))
                 throw Error(ErrorCode::usage, fmt::format("{}: 'percentile' is {}, but it must be in [{}, 100].",
                                                           source, s.coloring.percentile, least_percentile));
         }},
        {"load_case", [&](const OrderedJson& j) { s.deformation.load_case = std::max(0, j.get<int>()); }},
        {"deform", [&](const OrderedJson& j) { s.deformation.factor = j.get<double>(); }},
        {"motion",
         [&](const OrderedJson& j) {
             s.deformation.motion = value_named<Motion>(motion_names, j.get<std::string>(), "motion");
         }},
        {"phase", [&](const OrderedJson& j) { s.deformation.phase = unit("phase", j); }},
        {"speed", [&](const OrderedJson& j) { s.deformation.speed = std::max(0.0, j.get<double>()); }},
        {"hidden",
         [&](const OrderedJson& j) {
             for (const NodeId node : j.get<std::vector<NodeId>>()) s.visibility.set_hidden(node, true);
         }},
        {"isolated", [&](const OrderedJson& j) { s.visibility.isolated = j.get<NodeId>(); }},
        {"hidden_patches", [&](const OrderedJson& j) { read_names(j, s.visibility.hidden_patches); }},
        {"hidden_regions", [&](const OrderedJson& j) { read_names(j, s.visibility.hidden_regions); }},
        {"glass_regions", [&](const OrderedJson& j) { read_names(j, s.visibility.glass_regions); }},
        {"isolated_region",
         [&](const OrderedJson& j) { s.visibility.isolated_region = path_of_text(j.get<std::string>()); }},
        {"pick",
         [&](const OrderedJson& j) { s.pick = value_named<PickMode>(pick_names, j.get<std::string>(), "pick mode"); }},
        {"selection", [&](const OrderedJson& j) { s.selection = selection_from(j, source); }},
        {"theme",
         [&](const OrderedJson& j) { s.theme = value_named<Theme>(theme_names, j.get<std::string>(), "theme"); }},
        {"panels",
         [&](const OrderedJson& j) {
             Fields of_panels;
             add_switches(s.panels, of_panels);
             read_fields(j, of_panels, source);
         }},
    };
    add_switches(s, fields);
    add_origin(origin ? *origin : unused, fields, source);
    read_fields(parse(text, source), fields, source);
    return s;
}

void fit_to_body(ViewState& state, const ViewOrigin& origin, const Eigen::AlignedBox3d& body, double aspect) {
    if (!state.camera || origin.body.isEmpty() || body.isEmpty()) return;
    constexpr double tolerance = 0.01;  // of the diagonal: a surface is remeshed, but the same one
    const double moved = std::max((origin.body.min() - body.min()).norm(), (origin.body.max() - body.max()).norm());
    if (moved > tolerance * body.diagonal().norm()) fit(*state.camera, body, aspect);
}

}  // namespace kerf::view

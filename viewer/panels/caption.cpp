// The caption of a picture, in words for a reader who does not know Kerf: the piece shown and its step, its numbers,
// and its omissions. Clip plane, filter, neighbours of a cell, hidden or isolated nodes and regions, glass, and colours
// that span fewer values add a line each, so that a saved picture says that it does not show all. A new way to hide
// something needs its line in caption_of(). Lines are broken at the width of the scene before they are measured, as the
// ground behind them is drawn first.
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "base/core/number_text.h"
#include "base/core/words.h"
#include "viewer/model/shown_parts.h"
#include "viewer/panels/inside/parts.h"

namespace kerf::view {

namespace {

struct CaptionLine {
    std::string text;
    ImVec4 color;
};

std::string counted(std::int64_t n, const char* noun) {
    return fmt::format("{} {}{}", grouped(n), noun, n == 1 ? "" : "s");
}

std::string beginning_small(std::string text) {
    const bool is_word = text.size() > 1 && std::islower(static_cast<unsigned char>(text[1])) != 0;
    if (is_word) text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
    return text;
}

std::string body_of(const Document& document, NodeId node) {
    if (node == root_node) return "Whole body";
    const TreeRow* row = document.tree.find(node);
    return fmt::format("{} {}", row && row->leaf() ? "Part" : "Piece", node.value());
}

// The parts of a node: their number, those shown, those of these that are filled, and the tetrahedra and facets of
// those shown.
struct Content {
    std::int64_t parts = 0, shown = 0, filled = 0, tets = 0, facets = 0;
};

Content content_of(const Document& document, const ViewState& state) {
    Content content;
    for (const NodeId part : document.tree.parts_below(state.node)) {
        const TreeRow& row = *document.tree.find(part);
        ++content.parts;
        if (!shows_node(state, document, part)) continue;
        ++content.shown;
        content.filled += row.tets > 0 ? 1 : 0;
        content.tets += std::max<std::int64_t>(row.tets, 0);
        content.facets += std::max<std::int64_t>(row.facets, 0);
    }
    return content;
}

// `told`: the number of parts that the caption is about.
std::string in_parts(const std::string& body, const Content& content, std::int64_t told) {
    if (told < content.parts) return fmt::format("{}, {} of {}", body, told, counted(content.parts, "part"));
    return content.parts == 1 ? body : fmt::format("{} in {}", body, counted(content.parts, "part"));
}

std::string heading(const Document& document, const ViewState& state, const Step& step) {
    const std::string body = body_of(document, state.node);
    const Content content = content_of(document, state);
    const TreeRow* row = document.tree.find(state.node);
    if (step.refused_try < 0) switch (step.stage) {
            case Stage::before_repair:
                return body + ": surface of the file, before repairs";
            case Stage::before_remeshing:
                return body + ": surface of the file, before remeshing";
            case Stage::input:
                return body + (row && row->facets > 0 ? ": surface of " + counted(row->facets, "facet") : ": surface");
            case Stage::split:
                return body + ", cut in two";
            case Stage::parts:
                return in_parts(body, content, content.shown) + ": surfaces of " + counted(content.facets, "facet");
            case Stage::tetrahedra:
                return in_parts(body, content, content.filled) + ": " +
                       (content.tets == 1 ? "1 tetrahedron" : grouped(content.tets) + " tetrahedra");
            default:
                break;
        }
    return fmt::format("Cut of {}{}: {}", state.node == root_node ? "the " : "", beginning_small(body),
                       step.refused_try < 0 ? in_words(name(step.stage)) : beginning_small(title(step)));
}

// The repairs that have changed the surface of the file.
std::string repairs_of(const Document& document) {
    const InputOptions& options = document.options.input_options;
    const std::string wraps = options.wraps() ? "wrapped" : "";
    if (options.repairs.plan.empty()) return wraps.empty() ? "by its options" : wraps;
    return options.repairs.plan + (wraps.empty() ? "" : ", " + wraps);
}

// The place of the clip plane, with its coordinate in units of the file if an axis is its normal.
std::string clip_text(const Clip& clip, const Eigen::AlignedBox3d& box) {
    const double place = position_of(clip, box);
    std::string plane = "a plane";
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(std::abs(clip.normal[axis]) - 1) < 1e-9)
            plane = fmt::format("{} = {}", "xyz"[axis], rounded(clip.normal[axis] * place + 0.0));
    return fmt::format("{} {}", clip.style == ClipStyle::layer ? "Only the layer at" : "Cut open at", plane);
}

std::string size_text(const Eigen::AlignedBox3d& box) {
    const Vec3 size = box.sizes();
    return fmt::format("Body: {} x {} x {} in units of the file", rounded(size.x()), rounded(size.y()),
                       rounded(size.z()));
}

// A line for each way in which regions are shown that is not the usual one.
std::vector<std::string> region_lines(const Document& document, const ViewState& state) {
    std::vector<std::string> lines, glass, hidden;
    for (const std::string& region : document.region_names) {
        if (state.visibility.isolated_region == region) lines.push_back("Only region " + region);
        if (is_hidden(state, region)) hidden.push_back(region);
        if (is_glass(state, region)) glass.push_back(region);
    }
    if (state.visibility.walls) lines.emplace_back("Only walls between regions");
    const auto add = [&](const char* what, const std::vector<std::string>& names) {
        constexpr std::size_t most = 6;
        if (names.size() > most)
            lines.push_back(fmt::format("{} {} regions", what, names.size()));
        else if (!names.empty())
            lines.push_back(fmt::format("{} region{} {}", what, names.size() > 1 ? "s" : "", fmt::join(names, ", ")));
    };
    add("Without", hidden);
    add("As glass:", glass);
    return lines;
}

bool shows_neighbours(const UiContext& context) {
    const ViewState& state = context.state;
    const Step& step = context.steps[nearest_step(context.steps, state.step)];
    return state.visibility.neighbours && state.selection.kind == Selection::Kind::cell &&
           step.stage == Stage::tetrahedra;
}

// Which of two runs a picture shows; empty where there is one.
std::string name_of_run(const UiContext& context, bool other) {
    const Session& session = context.session;
    if (!context.facts.beside || !session.other_document()) return "";
    const Document& document = other ? *session.other_document() : session.document();
    return fmt::format("{}: {}", session.shows_before() != other ? "A" : "B", document.title);
}

// The lines of the caption, for a scene that has room for lines of this width.
std::vector<CaptionLine> caption_of(const UiContext& context, float room) {
    const Document& document = context.session.document();
    const ViewState& state = context.state;
    const Palette& colors = palette(state.theme);
    std::vector<CaptionLine> lines;
    const auto add = [&](const std::string& text, const ImVec4& color) {
        lines.push_back({broken(text, room), color});
    };
    if (const std::string run = name_of_run(context, false); !run.empty()) {
        add(run, colors.accent);
        add(outcome_of(document, false), colors.text);
    }
    if (has_tree(document)) {
        const Step& step = context.steps[nearest_step(context.steps, state.step)];
        add(heading(document, state, step), colors.text);
        if (step.refused_try >= 0) add(describe_step(document, state.node, step), colors.bad);
    } else {
        add(document.title, colors.text);
        if (document.unrepaired)
            add(state.step.stage == Stage::before_repair ? "Surface of the file, before repairs"
                                                         : "Repaired: " + repairs_of(document),
                colors.text);
    }
    if (!document.box.isEmpty()) {
        if (width_of(size_text(document.box)) <= room) add(size_text(document.box), colors.dim);
        if (state.clip.on) add(clip_text(state.clip, document.box), colors.dim);
    }
    if (state.coloring.filter && is_measure(state.coloring.by))
        add(fmt::format("Only cells with {} of {} to {}", beginning_small(title(state.coloring.by)),
                        rounded(state.coloring.filter->low), rounded(state.coloring.filter->high)),
            colors.dim);
    if (is_of_solution(state.coloring.by) && document.solution)
        add(fmt::format("{} in units of the case", title(state.coloring.by)), colors.dim);
    if (context.facts.legend.percentile < 100)
        add(fmt::format("Colours span {:g} % of the values drawn", context.facts.legend.percentile), colors.dim);
    if (state.visibility.isolated)
        add("Only " + beginning_small(body_of(document, *state.visibility.isolated)), colors.dim);
    if (shows_neighbours(context)) add("Only the selected cell and its neighbours", colors.dim);
    std::vector<std::string> hidden;
    for (const NodeId node : state.visibility.hidden) hidden.push_back(beginning_small(body_of(document, node)));
    if (!hidden.empty()) add(fmt::format("Without {}", fmt::join(hidden, ", ")), colors.dim);
    if (!hidden_patches(state, document).empty())
        add(fmt::format("Without patches {}", fmt::join(state.visibility.hidden_patches, ", ")), colors.dim);
    if (document.region_names.size() > 1 && shows_parts(state.step.stage))
        for (const std::string& line : region_lines(document, state)) add(line, colors.dim);
    return lines;
}

void draw_lines(const std::vector<CaptionLine>& lines, const Rectangle& scene, Theme theme) {
    const float e = em();
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    ImVec2 from = {scene.x + 1.2f * e, scene.y + e}, size = {0, 0};
    for (const CaptionLine& line : lines) {
        const ImVec2 extent = ImGui::CalcTextSize(line.text.c_str());
        size = {std::max(size.x, extent.x), size.y + extent.y};
    }
    draw_backdrop(list, theme, from, {from.x + size.x, from.y + size.y});
    for (const CaptionLine& line : lines) {
        list.AddText(from, packed(line.color), line.text.c_str());
        from.y += ImGui::CalcTextSize(line.text.c_str()).y;
    }
}

float room_for_lines(const Rectangle& scene) { return std::max(scene.width - 9 * em(), 8 * em()); }

}  // namespace

void draw_caption(UiContext& context, const Rectangle& scene) {
    draw_lines(caption_of(context, room_for_lines(scene)), scene, context.state.theme);
}

void draw_caption_beside(UiContext& context, const RunBeside& other) {
    const Palette& colors = palette(context.state.theme);
    const float room = room_for_lines(other.area);
    std::vector<CaptionLine> lines = {{broken(name_of_run(context, true), room), colors.accent}};
    if (!other.error.empty())
        lines.push_back({broken(other.error, room), colors.bad});
    else if (const Document* document = context.session.other_document())
        lines.push_back({broken(outcome_of(*document, false), room), colors.text});
    draw_lines(lines, other.area, context.state.theme);
    const bool is_right = context.session.shows_before();
    const float border = other.area.x + (is_right ? 0 : other.area.width);
    ImGui::GetBackgroundDrawList()->AddLine({border, other.area.y}, {border, other.area.y + other.area.height},
                                            packed(colors.dim));
}

}  // namespace kerf::view

#include "viewer/model/stage.h"

#include <charconv>

#include <fmt/format.h>

#include "core/error.h"

namespace kerf::view {

namespace {

struct StageText {
    const char* name;
    const char* title;
};
constexpr std::array<StageText, stage_count> texts = {{
    {"input", "Input"},
    {"plane", "Cutting plane"},
    {"crossed-edges", "Crossed edges"},
    {"hanging-removed", "Hanging edges removed"},
    {"closed-loops", "Closed loops"},
    {"paths-removed", "Multiple paths removed"},
    {"contour", "Smoothed contour"},
    {"projected", "Projected contour"},
    {"triangulation", "2D triangulation"},
    {"interface", "Mapped to the surface"},
    {"split", "Split halves"},
    {"tetrahedra", "Tetrahedra"},
}};
constexpr std::string_view try_prefix = "try:";

}  // namespace

const char* name(Stage stage) { return texts[static_cast<std::size_t>(stage)].name; }
const char* title(Stage stage) { return texts[static_cast<std::size_t>(stage)].title; }

std::string name(const Step& step) {
    return step.refused_try < 0 ? name(step.stage) : fmt::format("{}{}", try_prefix, step.refused_try);
}

Step step_from_name(const std::string& text) {
    for (int i = 0; i < stage_count; ++i)
        if (text == texts[static_cast<std::size_t>(i)].name) return {static_cast<Stage>(i), -1};
    if (text.starts_with(try_prefix)) {
        Step step{Stage::plane, -1};
        const char* end = text.data() + text.size();
        const auto [stop, error] = std::from_chars(text.data() + try_prefix.size(), end, step.refused_try);
        if (error == std::errc() && stop == end && step.refused_try >= 0) return step;
    }
    std::string all;
    for (const StageText& stage : texts) all += fmt::format("{}, ", stage.name);
    throw Error(ErrorCode::usage, fmt::format("'{}' is no stage. There are {}and try:0, try:1, ... for tries that were "
                                              "refused.",
                                              text, all));
}

}  // namespace kerf::view

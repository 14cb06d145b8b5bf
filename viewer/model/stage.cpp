#include "viewer/model/stage.h"

#include <cctype>
#include <charconv>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/words.h"

namespace kerf::view {

namespace {

constexpr std::array<const char*, stage_count> stage_names = {
    "before-repair",   "before-remeshing", "input",         "plane",   "crossed-edges",
    "hanging-removed", "closed-loops",     "paths-removed", "contour", "projected",
    "triangulation",   "interface",        "split",         "parts",   "tetrahedra",
};
constexpr std::string_view try_prefix = "try:";

}  // namespace

const char* name(Stage stage) { return stage_names[static_cast<std::size_t>(stage)]; }

std::string title(Stage stage) {
    std::string words = in_words(name(stage));
    words.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(words.front())));
    return words;
}

std::string name(const Step& step) {
    return step.refused_try < 0 ? name(step.stage) : fmt::format("{}{}", try_prefix, step.refused_try);
}

std::string title(const Step& step) {
    return step.refused_try < 0 ? title(step.stage) : fmt::format("Try {}", step.refused_try + 1);
}

std::string names_of_stages() { return fmt::format("{}", fmt::join(stage_names, ", ")); }

Step step_from_name(const std::string& text) {
    for (int i = 0; i < stage_count; ++i) {
        const auto stage = static_cast<Stage>(i);
        if (text == name(stage)) return {stage, -1};
    }
    if (text.starts_with(try_prefix)) {
        Step step{Stage::plane, -1};
        const char* end = text.data() + text.size();
        const auto [stop, error] = std::from_chars(text.data() + try_prefix.size(), end, step.refused_try);
        if (error == std::errc() && stop == end && step.refused_try >= 0) return step;
    }
    throw Error(ErrorCode::usage, fmt::format("'{}' is no stage. There are {}, and try:0, try:1, ... for tries that "
                                              "were refused.",
                                              text, names_of_stages()));
}

}  // namespace kerf::view

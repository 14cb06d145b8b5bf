// Options are found in a text as the names that follow "--" and are in the table of options; other names belong to
// other programs, or are parts of paths, and are passed over. The type of an option says how its value is read: a
// switch has none, a choice only one of its names, a number may end a sentence, and a list of repairs goes on as long
// as a word follows its comma at once. Nothing marks an advice in a message, so that every new message which names an
// option has its button without a change here; in turn a text must not name options that it does not advise.
#include "viewer/model/advice.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "base/core/error.h"
#include "base/geometry/box.h"
#include "run/request/run_choices.h"
#include "surface/repair/repair_plan.h"

namespace kerf::view {

namespace {

// Letters, digits and dashes from a place on.
std::string word_at(const std::string& text, std::size_t begin) {
    std::size_t end = begin;
    while (end < text.size() && (std::isalnum(static_cast<unsigned char>(text[end])) || text[end] == '-')) ++end;
    return text.substr(begin, end - begin);
}

// The value that a text has for an option right behind its name; empty: none, or no such value.
std::string value_behind(const OptionField& field, const std::string& text, std::size_t end_of_name) {
    if (std::holds_alternative<bool*>(field.value)) return "true";
    if (end_of_name >= text.size() || text[end_of_name] != ' ') return "";
    if (field.name == "repair") {  // steps with commas between, but no comma that ends a part of the sentence
        std::size_t end = end_of_name;
        do end += 1 + word_at(text, end + 1).size();
        while (end + 1 < text.size() && text[end] == ',' && text[end + 1] != ' ');
        return text.substr(end_of_name + 1, end - end_of_name - 1);
    }
    if (const auto* choice = std::get_if<OptionField::Choice>(&field.value)) {
        const std::string value = word_at(text, end_of_name + 1);
        return std::find(choice->names.begin(), choice->names.end(), value) == choice->names.end() ? "" : value;
    }
    // A number, which may end a sentence.
    const std::size_t end = text.find_first_not_of("0123456789.e-", end_of_name + 1);
    std::string value = text.substr(end_of_name + 1, end == text.npos ? end : end - end_of_name - 1);
    if (value.ends_with('.')) value.pop_back();
    return !value.empty() && std::isdigit(static_cast<unsigned char>(value.front())) ? value : "";
}

// 3.7e-5 as 1e-5: nobody takes it for more exact than it is.
std::string power_of_ten_below(double value) {
    return fmt::format("{:g}", std::pow(10, std::floor(std::log10(value))));
}

std::string twice(const std::string& number) {
    char* end = nullptr;
    const double value = std::strtod(number.c_str(), &end);
    return end == number.c_str() || *end != 0 || !(value > 0) ? "" : fmt::format("{:.12g}", 2 * value);
}

double diagonal_of_soup(const Soup& soup) {
    const Box box = box_around_finite(soup.vertices);
    return box.isEmpty() ? 0 : box.diagonal().norm();
}

}  // namespace

std::vector<OptionText> advised_options(const std::string& text) {
    std::vector<OptionText> advice;
    RunRequest options;
    const std::vector<OptionField> fields = option_fields(options);
    for (std::size_t at = text.find("--"); at != text.npos; at = text.find("--", at + 2)) {
        const std::string option = word_at(text, at + 2);
        const auto field =
            std::find_if(fields.begin(), fields.end(), [&](const OptionField& f) { return f.name == option; });
        if (field == fields.end()) continue;  // of another program, or a path
        const std::string value = value_behind(*field, text, at + 2 + option.size());
        const auto known = std::find_if(advice.begin(), advice.end(), [&](const OptionText& a) {
            return a.name == option && (a.text == value || a.text.empty() || value.empty());
        });
        if (known == advice.end())
            advice.push_back({option, value});
        else if (known->text.empty())
            known->text = value;
    }
    return advice;
}

std::optional<OptionText> advised_option(const std::string& text) {
    const std::vector<OptionText> all = advised_options(text);
    if (all.size() != 1 || all.front().text.empty()) return std::nullopt;
    RunRequest options;
    for (const OptionField& field : option_fields(options)) {
        const bool is_choice = std::holds_alternative<OptionField::Choice>(field.value);
        if (field.name == all.front().name && !is_choice && !std::holds_alternative<bool*>(field.value))
            return std::nullopt;
    }
    return all.front();
}

bool is_set(const RunRequest& options, const OptionText& option) {
    for (const OptionText& own : option_texts(options, false))
        if (own.name == option.name) return own.text == option.text;
    return false;
}

std::optional<RunRequest> options_with(RunRequest options, const OptionText& option) {
    try {
        set_options(options, {option}, "The advice");
        choices_of(options);
    } catch (const Error&) {
        return std::nullopt;
    }
    return options;
}

std::string with_repairs(const std::string& plan, const std::string& more) {
    const auto kinds_of = [](const std::string& text) {
        std::vector<RepairKind> kinds;
        for (const RepairStep& step : parse_repair_plan("repair", text).steps) kinds.push_back(step.kind);
        return kinds;
    };
    std::string all = plan;
    for (std::size_t begin = 0; begin < more.size();) {
        const std::size_t end = std::min(more.find(',', begin), more.size());
        const std::string longer = all + (all.empty() ? "" : ",") + more.substr(begin, end - begin);
        if (kinds_of(longer) != kinds_of(all)) all = longer;
        begin = end + 1;
    }
    return all;
}

std::string words_of(const OptionText& advice, const char* verb) {
    if (advice.name == "surface" && advice.text == "remesh") return "Remesh the surface";
    if (advice.text == "true") return fmt::format("{} with --{}", verb, advice.name);
    return fmt::format("{} with --{}{}{}", verb, advice.name, advice.text.empty() ? "" : " ", advice.text);
}

bool is_input_option(const std::string& option) {
    InputOptions options;
    const std::vector<OptionField> fields = input_option_fields(options);
    return std::any_of(fields.begin(), fields.end(), [&](const OptionField& field) { return field.name == option; });
}

std::string usual_value(const std::string& option, const RunRequest& options, const CheckedSoup* checked) {
    if (option == "fill-holes" && checked) {
        std::size_t edges = 0;
        for (const Defect& defect : checked->diagnosis.defects)
            if (defect.kind == DefectKind::open_edge) edges = std::max(edges, defect.facets.size());
        return edges > 0 ? fmt::format("{}", edges) : "";
    }
    if (option == "weld" && checked) {
        double distance = 0;  // a little more than is between bodies
        for (const Defect& defect : checked->diagnosis.defects)
            if (is_between_bodies(defect)) distance = std::max(distance, defect.measure);
        if (distance > 0) return fmt::format("{:.2g}", 1.2 * distance);
        const double diagonal = diagonal_of_soup(checked->soup);
        return diagonal > 0 ? power_of_ten_below(1e-5 * diagonal) : "";
    }
    for (const OptionText& own : option_texts(options, false))
        if (own.name == option) return twice(own.text);
    return "";
}

}  // namespace kerf::view

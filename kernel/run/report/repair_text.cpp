// The texts of `kerf repair` and of remedies. The lines of to_text(RepairedFile) have the form of those of steps, a
// label and a text, and one whose text is empty is left out, so that each function returns "" where it has nothing to
// say. Distances are told as bounds only where they were proven. command_of() leaves out options that are the default
// of the command, so that the line is as short as a user would write it.
#include "run/report/repair_text.h"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "base/core/number_text.h"
#include "base/core/shell_word.h"
#include "run/report/file_diagnosis.h"
#include "run/report/report.h"

namespace kerf {

namespace {

// A line in the form of those of steps in to_text(RepairReport); none if the text is empty.
std::string line(const char* label, const std::string& text) {
    return text.empty() ? "" : fmt::format("  {:<14}{}\n", label, text);
}

std::string facets_text(std::int64_t count) { return fmt::format("{} facet{}", grouped(count), count == 1 ? "" : "s"); }

// "1 -> 1.01", or "1, as before".
std::string change_text(double before, double after) {
    const std::string text = fmt::format("{:.9g}", before), now = fmt::format("{:.9g}", after);
    return text == now ? now + ", as before" : fmt::format("{} -> {}", text, now);
}

std::string moves_text(const RepairReport& ladder) {
    if (ladder.largest_move() == 0) return "";
    return fmt::format("no vertex by more than {:.3g}; {:.3g} is allowed", ladder.largest_move(), ladder.bound);
}

std::string distance_text(double distance) {
    return std::isfinite(distance) ? fmt::format("at most {:.3g} from the input, which is proven", distance)
                                   : "at a distance that could not be proven";
}

std::string facets_lost_text(std::int64_t lost) { return lost == 0 ? "" : facets_text(lost) + " of the input"; }

std::string facets_at_text(std::int64_t count, double distance) {
    return count == 0 ? "" : fmt::format("{}, {}", facets_text(count), distance_text(distance));
}

std::string volume_text(const SoupMeasures& before, const SoupMeasures& after) {
    if (!after.volume) return "";
    return before.volume ? change_text(*before.volume, *after.volume)
                         : fmt::format("{:.9g}; before, it was not closed", *after.volume);
}

std::string caps_text(std::int64_t caps) {
    return fmt::format("{} large opening{} closed by {}", caps, caps == 1 ? " is" : "s are",
                       caps == 1 ? "a patch of its own, cap_1" : "patches of their own, cap_1, cap_2, ...");
}

std::string remedy_line(const Remedy& remedy) {
    if (remedy.options.wrap)
        return remedy.wrap_distance > 0
                   ? fmt::format(
                         "No repair makes it fit. A surface wrapped around it does, some {:.2g} from it at most:",
                         remedy.wrap_distance)
                   : std::string("No repair makes it fit. A surface wrapped around it may:");
    const std::string caps = remedy.caps > 0 ? "; " + caps_text(remedy.caps) : "";
    if (!remedy.was_tried)
        return fmt::format("Repairs that fit its defects may make it fit, which was not tried{}:", caps);
    std::string text = remedy.options.voids == Voids::parity ? "With shells inside of others as voids, it can be"
                                                             : "Repaired, it can be";
    if (!remedy.losses.empty()) text += fmt::format(", without what may be wanted: {}", fmt::join(remedy.losses, "; "));
    text += remedy.largest_move > 0 ? fmt::format("; no vertex moves by more than {:.3g}", remedy.largest_move)
                                    : std::string("; no vertex moves");
    return text + caps + ":";
}

}  // namespace

std::string command_of(const Remedy& remedy, const std::string& path) {
    InputOptions options = remedy.options;
    const bool is_wrap = options.wrap;
    const std::string output =
        std::filesystem::path(path).stem().string() + (is_wrap ? "_wrapped.obj" : "_repaired.obj");
    std::vector<std::string> words = {"kerf", is_wrap ? "wrap" : "repair", path};
    if (!is_wrap) {  // kerf wrap has one INPUT, and others by --with
        words.insert(words.end(), options.more_files.begin(), options.more_files.end());
        options.more_files.clear();
        if (options.repairs.plan == name(RepairLevel::full)) options.repairs.plan.clear();  // its default
    }
    words.insert(words.end(), {"-o", output});
    for (std::string& word : command_words(std::move(options))) words.push_back(std::move(word));
    std::string command;
    for (const std::string& word : words) command += (command.empty() ? "" : " ") + shell_word(word);
    return command;
}

std::string to_text(const Remedy& remedy, const std::string& path) {
    return fmt::format("{}\n  {}\n", remedy_line(remedy), command_of(remedy, path));
}

std::string to_text(const RepairedFile& repaired) {
    const RepairMeasures& measures = repaired.measures;
    std::string text = fmt::format("{}: {}{}\n", repaired.input, facets_text(measures.before.facets),
                                   measures.before.volume ? "" : ", not closed");
    text += to_text(repaired.checked.ladder);
    if (repaired.is_unchanged) {
        text += line("unchanged", repaired.is_copy ? "nothing to repair: the output is a copy, byte for byte"
                                                   : "nothing to repair: the output has the same facets");
    } else {
        text += line("mended", repairs_text(repaired.checked.tidied, repaired.checked.ladder, repaired.turned));
        text += line("moved", moves_text(repaired.checked.ladder));
        text += line("changed", facets_at_text(measures.changed_facets, measures.distance_of_changed));
        text += line("added", facets_at_text(measures.added_facets, measures.distance_of_added));
        text += line("gone", facets_lost_text(measures.lost_facets));
        text += line("volume", volume_text(measures.before, measures.after));
        text += line("area", change_text(measures.before.area, measures.after.area));
    }
    const std::string output = fmt::format("{}: {}. ", repaired.output, facets_text(measures.after.facets));
    if (repaired.can_be_meshed) return text + output + "It can be meshed.\n";
    text += output + "It cannot be meshed yet:\n" + defects_text(repaired.checked, true);
    return repaired.remedy ? text + to_text(*repaired.remedy, repaired.input) : text;
}

}  // namespace kerf

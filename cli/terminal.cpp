#include "cli/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

#include "files/io/standard_streams.h"

namespace kerf {

namespace {

constexpr const char *bold = "\033[1m", *red = "\033[1;31m", *green = "\033[32m", *plain = "\033[0m";

std::string variable(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

// A line of a report in colours: a label of eleven columns, and a value.
std::string coloured_line(std::string_view line) {
    constexpr std::size_t value_place = 12;
    if (line.size() <= value_place || line.front() == ' ' || line[value_place - 1] != ' ') return std::string(line);
    const std::string_view label = line.substr(0, value_place), value = line.substr(value_place);
    const bool is_verdict = label.starts_with("verified");
    const char* colour = !is_verdict ? "" : value.starts_with("yes") ? green : red;
    return fmt::format("{}{}{}{}{}{}", bold, label, plain, colour, value, is_verdict ? plain : "");
}

}  // namespace

bool shows_colours() {
    return ::isatty(STDERR_FILENO) == 1 && variable("NO_COLOR").empty() && variable("TERM") != "dumb";
}

int terminal_columns() {
    winsize size{};
    return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

void tell_error(std::string_view message) {
    const bool colours = shows_colours();
    tell(fmt::format("{}kerf:{} {}\n", colours ? red : "", colours ? plain : "", message));
}

void tell_report(std::string_view text) {
    if (!shows_colours()) return tell(text);
    std::string coloured;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        coloured += coloured_line(text.substr(0, end));
        if (end < text.size()) coloured += '\n';
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    tell(coloured);
}

}  // namespace kerf

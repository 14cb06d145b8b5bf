// Colours and widths on a terminal, which logs and pipes do not get.
#pragma once

#include <string>
#include <string_view>

namespace kerf {

/// Returns whether standard error is a terminal that shows colours: NO_COLOR is empty or not set, and TERM is not
/// "dumb".
bool shows_colours();

/// Returns the columns of the terminal that standard error is; 80 where it tells none.
int terminal_columns();

/// Tells an error as "kerf: " and the message.
void tell_error(std::string_view message);

/// Tells lines of a report, "label       value", with labels set off and the verdict in its colour if shows_colours().
void tell_report(std::string_view text);

}  // namespace kerf

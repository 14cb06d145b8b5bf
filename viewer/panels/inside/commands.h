// The table of all commands, each with its name, keys and menu. Menus, the window of keys, the search box and the
// keyboard all read it, so that a command is described once.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "viewer/panels/inside/parts.h"

namespace kerf::view {

struct Command {
    const char* name;     ///< "Fit everything"; no two are alike
    const char* keys;     ///< the keys that run it, any of "Ctrl+Shift+Z, Ctrl+Y"; empty: none
    const char* heading;  ///< the heading under which it is listed
    const char* menu;     ///< the menu that has it, "View"; empty: none
    void (*run)(UiContext& context, Dialogs& dialogs);
    bool (*is_on)(const UiContext& context) = nullptr;       ///< the state of a switch; null: the command is no switch
    bool (*is_enabled)(const UiContext& context) = nullptr;  ///< whether it can be run now; null: always
    bool repeats = false;                                    ///< it is run again and again while its key is held
    bool ends_section = false;                               ///< a separating line follows it in the menu
};

/// Returns the table, in the order of menus and lists.
const std::vector<Command>& commands();

bool is_enabled(const Command& command, const UiContext& context);
/// Returns the command of a key as it is pressed, "Ctrl+Shift+Z", or nullptr if there is none. A key with Shift that
/// has no command of its own stands for the key without Shift.
const Command* command_of_key(const std::string& key);
/// Returns the commands whose name, heading and keys together have all typed words, in any case: first those whose name
/// begins with the text, then those whose name contains it, then the rest, each in the order of the table.
std::vector<const Command*> find_commands(std::string_view typed);

}  // namespace kerf::view

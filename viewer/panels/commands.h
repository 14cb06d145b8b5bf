// What can be asked for by a word or a key, once: menus, the window of keys, the search box and the keyboard all read
// this table.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "viewer/panels/parts.h"

namespace kerf::view {

struct Command {
    const char* name;     ///< "Fit everything"; no two are alike
    const char* keys;     ///< "Ctrl+Shift+Z, Ctrl+Y": any of them; empty: none
    const char* heading;  ///< under which it is listed
    const char* menu;     ///< "View"; empty: in no menu
    void (*run)(UiContext& context, Dialogs& dialogs);
    bool (*is_on)(const UiContext& context) = nullptr;       ///< of a switch
    bool (*is_enabled)(const UiContext& context) = nullptr;  ///< null: always
    bool repeats = false;                                    ///< while its key is held
    bool ends_section = false;                               ///< a line follows in the menu
};

/// In the order of menus and lists.
const std::vector<Command>& commands();

bool is_enabled(const Command& command, const UiContext& context);
/// The command of a key as it is pressed, "Ctrl+Shift+Z". With Shift it is that without, where it has none of its own.
/// nullptr: there is none.
const Command* command_of_key(const std::string& key);
/// Those whose name, heading and keys have all words that were typed, in any case: first those whose name begins with
/// the text, then those whose names have it, then the rest, each in the order of the table.
std::vector<const Command*> find_commands(std::string_view typed);

}  // namespace kerf::view

// What the viewer remembers for its user, as JSON in the config folder.
#pragma once

#include <string>

#include "viewer/panels/panels.h"

namespace kerf::view {

/// $XDG_CONFIG_HOME/kerf, or ~/.config/kerf; empty if neither variable is set.
std::string user_config_folder();

/// Defaults for what is missing or damaged: settings are never worth an error. An empty folder has none.
Settings load_settings(const std::string& folder);
/// Does nothing if the folder is empty or cannot be written.
void save_settings(const std::string& folder, const Settings& settings);

/// What the start page will say of what is open: the file on top of the recent ones.
void keep_sizes(Settings& settings, const Document& document);
/// "26 Nov 2026", by the local time.
std::string today();
/// Puts a file on top of the recent ones.
void remember(Settings& settings, const std::string& path, const std::string& day);

}  // namespace kerf::view

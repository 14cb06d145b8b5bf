// The settings that the viewer remembers for its user, as JSON in the config folder.
#pragma once

#include <string>

#include "viewer/panels/panels.h"

namespace kerf::view {

/// Returns $XDG_CONFIG_HOME/kerf, or ~/.config/kerf; empty if neither variable is set.
std::string user_config_folder();

/// Reads the settings, with defaults for all that is missing or damaged: settings are never worth an error. An empty
/// folder has none.
Settings load_settings(const std::string& folder);
/// Writes the settings; does nothing if the folder is empty or cannot be written.
void save_settings(const std::string& folder, const Settings& settings);

/// Notes the sizes of the open document in the first of the recent files, for the start page.
void keep_sizes(Settings& settings, const Document& document);
/// Returns "26 Nov 2026", by the local time.
std::string today();
/// Puts a file on top of the recent ones.
void remember(Settings& settings, const std::string& path, const std::string& day);

}  // namespace kerf::view

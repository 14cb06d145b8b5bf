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

/// Puts a file on top of the recent ones.
void remember(Settings& settings, const std::string& path);

}  // namespace kerf::view

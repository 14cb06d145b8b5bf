// The settings as viewer.json in the config folder. Reading takes a default for all that is missing or out of range,
// and for a damaged file as a whole; writing goes to a file .partial that is renamed when it is complete, and fails in
// silence, as settings are never worth an error. Files of older versions are read: their recent files are paths alone.
// The list of recent files has ten entries, absolute paths, each once, the last opened first.
#include "viewer/app/settings.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>

#include <nlohmann/json.hpp>

#include "files/io/json.h"

namespace kerf::view {

namespace {

constexpr std::size_t most_recent = 10;

constexpr double smallest_side = 100, largest_side = 16384;  // limits of a window's sides, in pixels at scale 1

// The size of the window, or the default if no window can have it.
WindowSize window_from(const nlohmann::json& settings) {
    const nlohmann::json window = settings.value("window", nlohmann::json::object());
    const auto number = [&](const char* name) {
        return window.contains(name) && window[name].is_number() ? window[name].get<double>() : 0;
    };
    if (!window.is_object()) return {};
    const double width = number("width"), height = number("height"), scale = number("scale");
    if (!(scale >= 0.5 && scale <= 8)) return {};
    for (const double side : {width / scale, height / scale})
        if (!(side >= smallest_side && side <= largest_side)) return {};
    return {static_cast<int>(width), static_cast<int>(height), scale};
}

// The recent files. Paths alone, as older versions have written them, are fine.
std::vector<RecentFile> recent_from(const nlohmann::json& settings) {
    std::vector<RecentFile> recent;
    for (const nlohmann::json& file : settings.value("recent", nlohmann::json::array()))
        if (file.is_string())
            recent.push_back({file.get<std::string>(), "", ""});
        else
            recent.push_back({file.at("path").get<std::string>(), file.value("day", ""), file.value("sizes", "")});
    return recent;
}

std::string settings_file(const std::string& folder) { return folder + "/viewer.json"; }

}  // namespace

std::string user_config_folder() {
    if (const char* config = std::getenv("XDG_CONFIG_HOME"); config && *config) return std::string(config) + "/kerf";
    if (const char* home = std::getenv("HOME"); home && *home) return std::string(home) + "/.config/kerf";
    return "";
}

Settings load_settings(const std::string& folder) {
    Settings settings;
    if (folder.empty()) return settings;
    std::ifstream file(settings_file(folder), std::ios::binary);
    const auto json = parse_json_or_null(std::string(std::istreambuf_iterator<char>(file), {}));
    if (!json.is_object()) return settings;
    try {
        settings.theme = json.value("theme", "light") == "dark" ? Theme::dark : Theme::light;
        settings.recent = recent_from(json);
        settings.browser_folder = json.value("browser_folder", "");
        const auto panels = json.value("panels", nlohmann::json::object());
        const auto size = [&](const char* name) {
            const float ems = panels.value(name, 0.f);
            return ems > 0 && ems < 1000 ? ems : 0;
        };
        settings.panels = {size("left"), size("right"), size("timeline")};
        settings.window = window_from(json);
    } catch (const nlohmann::json::exception&) {
        return {};
    }
    return settings;
}

void save_settings(const std::string& folder, const Settings& settings) {
    if (folder.empty()) return;
    std::error_code ignored;
    std::filesystem::create_directories(folder, ignored);
    nlohmann::ordered_json json = {{"theme", settings.theme == Theme::dark ? "dark" : "light"},
                                   {"recent", nlohmann::ordered_json::array()},
                                   {"browser_folder", settings.browser_folder}};
    for (const RecentFile& file : settings.recent)
        json["recent"].push_back({{"path", file.path}, {"day", file.day}, {"sizes", file.sizes}});
    const PanelSizes& panels = settings.panels;
    json["panels"] = {{"left", panels.left}, {"right", panels.right}, {"timeline", panels.timeline}};
    const WindowSize& window = settings.window;
    json["window"] = {{"width", window.width}, {"height", window.height}, {"scale", window.scale}};
    const std::string path = settings_file(folder), partial = path + ".partial";
    {
        std::ofstream file(partial);
        file << json_text(json, 2) << "\n";
        if (!file.flush()) return;
    }
    std::filesystem::rename(partial, path, ignored);
}

void keep_sizes(Settings& settings, const Document& document) {
    if (document.kind != Document::Kind::none && !settings.recent.empty())
        settings.recent.front().sizes = sizes_of(document);
}

std::string today() {
    const std::time_t now = std::time(nullptr);
    std::tm day = {};
    std::array<char, 32> text = {};
    if (localtime_r(&now, &day) == nullptr) return "";
    return {text.data(), std::strftime(text.data(), text.size(), "%d %b %Y", &day)};
}

void remember(Settings& settings, const std::string& path, const std::string& day) {
    std::error_code error;
    const std::string absolute = std::filesystem::absolute(path, error).lexically_normal().string();
    const std::string full = error ? path : absolute;
    std::erase_if(settings.recent, [&](const RecentFile& file) { return file.path == full; });
    settings.recent.insert(settings.recent.begin(), {full, day, ""});
    if (settings.recent.size() > most_recent) settings.recent.resize(most_recent);
}

}  // namespace kerf::view

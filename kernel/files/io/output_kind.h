// The beginnings of the files that Kerf writes. A file that lies where an output is to be written is replaced only if
// it begins as outputs of that kind do: anything else is somebody's, and a name was mistyped.
#pragma once

#include <string_view>

namespace kerf {

struct OutputKind {
    const char* name;  ///< word for messages, as in "is no trace of Kerf"
    /// Tells by the first 1,024 bytes of a file, or all of a shorter one, whether it is of the kind.
    bool (*is)(std::string_view beginning);
};

namespace output_kind {

inline constexpr OutputKind trace = {"trace", [](std::string_view text) { return text.starts_with("kerftrac"); }};
inline constexpr OutputKind report = {
    "report", [](std::string_view text) { return text.starts_with("{\n  \"schema\": 1,\n  \"kerf\": \""); }};
inline constexpr OutputKind events = {"log of events",
                                      [](std::string_view text) { return text.starts_with("{\"event\":\"run\","); }};
inline constexpr OutputKind page = {"page", [](std::string_view text) {
                                        return text.starts_with("<!doctype html>") &&
                                               text.find("name=\"generator\" content=\"Kerf\"") != text.npos;
                                    }};
inline constexpr OutputKind histograms = {"picture", [](std::string_view text) {
                                              return text.starts_with("<?xml version='1.0' encoding='UTF-8'?>\n<svg") &&
                                                     text.find("DejaVu Sans, Verdana") != text.npos;
                                          }};
inline constexpr OutputKind picture = {"picture", [](std::string_view text) {
                                           using namespace std::string_view_literals;
                                           return text.starts_with("\x89PNG\r\n\x1a\n"sv) &&
                                                  text.find("tEXtSoftware\0Kerf"sv) != text.npos;
                                       }};
inline constexpr OutputKind surface = {"surface", [](std::string_view text) {
                                           return text.starts_with("Binary STL of Kerf") ||
                                                  text.substr(0, 100).find("Surface of Kerf") != text.npos;
                                       }};
inline constexpr OutputKind vtu = {"VTU file", [](std::string_view text) {
                                       return text.starts_with(
                                           "<?xml version=\"1.0\"?>\n<VTKFile type=\"Unstructured"
                                           "Grid\" version=\"1.0\"");
                                   }};

}  // namespace output_kind

}  // namespace kerf

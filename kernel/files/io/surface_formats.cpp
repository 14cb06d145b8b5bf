#include "files/io/surface_formats.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>

namespace kerf {

namespace {

constexpr std::array rows_of_formats = {
    SurfaceFormat{"STL", ".stl"},
    SurfaceFormat{"OBJ", ".obj"},
    SurfaceFormat{"PLY", ".ply"},
    SurfaceFormat{"OFF", ".off"},
    SurfaceFormat{"Gmsh's .msh", ".msh"},
    SurfaceFormat{"MEDIT's .mesh as text", ".mesh"},
    SurfaceFormat{"VTK's .vtp, .vtu or .vtk", ".vtp .vtu .vtk"},
    SurfaceFormat{"TetGen's .smesh or .poly", ".smesh .poly"},
    SurfaceFormat{"STEP", ".step .stp", true},
    SurfaceFormat{"IGES", ".iges .igs", true},
    SurfaceFormat{"BREP", ".brep", true},
    SurfaceFormat{"3MF", ".3mf", true},
};

bool has_word(std::string_view words, std::string_view word) {
    for (std::size_t at = words.find(word); at != words.npos; at = words.find(word, at + 1))
        if (at + word.size() == words.size() || words[at + word.size()] == ' ') return true;
    return false;
}

}  // namespace

std::span<const SurfaceFormat> surface_formats() { return rows_of_formats; }

bool has_surface_ending(std::string_view name) {
    std::string lower;
    std::transform(name.begin(), name.end(), std::back_inserter(lower),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    for (const std::string_view packed : {".gz", ".zst"})
        if (lower.ends_with(packed)) lower.resize(lower.size() - packed.size());
    const std::size_t dot = lower.rfind('.');
    if (dot == lower.npos || dot + 1 == lower.size()) return false;
    return std::any_of(rows_of_formats.begin(), rows_of_formats.end(),
                       [&](const SurfaceFormat& format) { return has_word(format.endings, lower.substr(dot)); });
}

std::string words_of_surface_formats() {
    std::string text;
    for (const SurfaceFormat& format : rows_of_formats)
        text += std::string(text.empty() ? "" : &format == &rows_of_formats.back() ? " or " : ", ") + format.words;
    return text;
}

}  // namespace kerf

#include <algorithm>
#include <array>
#include <cctype>

#include <fmt/format.h>

#include "base/core/error.h"
#include "files/export/format.h"
#include "fill/mesh/adjacency.h"

// A line for each file of this folder that defines `extern const Format NAME_format`.
#define KERF_FORMATS(format)                                                                                       \
    format(vtu) format(msh) format(openfoam) format(mfem) format(hdf5) format(medit) format(tetgen) format(abaqus) \
        format(su2) format(vtk) format(unv) format(med) format(cgns) format(feb) format(vtp)

namespace kerf {

#define KERF_DECLARE(name) extern const Format name##_format;
KERF_FORMATS(KERF_DECLARE)

namespace {
#define KERF_ADDRESS(name) &name##_format,
constexpr std::array table = {KERF_FORMATS(KERF_ADDRESS)};

bool is_in_any_case(std::string_view word, std::string_view text) {
    const auto are_equal = [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); };
    return std::search(text.begin(), text.end(), word.begin(), word.end(), are_equal) != text.end();
}
}  // namespace

std::span<const Format* const> formats() { return table; }

const Format& find_format(std::string_view name) {
    std::string names, reader;
    for (const Format* format : table) {
        if (format->name == name) return *format;
        names += fmt::format("{}{}", names.empty() ? "" : ", ", format->name);
        if (name.size() > 2 && reader.empty() && is_in_any_case(name, format->help)) reader = format->name;
    }
    throw Error(ErrorCode::usage, fmt::format("'{}' is no format. There are {}.{}", name, names,
                                              reader.empty() ? "" : fmt::format(" Did you mean {}?", reader)));
}

std::vector<const Format*> parse_formats(std::string_view list) {
    std::vector<const Format*> chosen;
    while (true) {
        const std::size_t comma = list.find(',');
        chosen.push_back(&find_format(list.substr(0, comma)));
        if (comma == list.npos) break;
        list.remove_prefix(comma + 1);
    }
    std::vector<const Format*> ordered;
    for (const Format* format : table)
        if (std::find(chosen.begin(), chosen.end(), format) != chosen.end()) ordered.push_back(format);
    return ordered;
}

void require_order(const Format& format, int order) {
    constexpr int highest = 2;
    if (order < 0 || order > highest)
        throw Error(ErrorCode::usage, fmt::format("There are no cells of order {}. Choose 1 or 2.", order));
    if (order <= format.highest_order) return;
    std::string others;
    for (const Format* other : table)
        if (other->highest_order >= order) others += fmt::format("{}{}", others.empty() ? "" : ", ", other->name);
    throw Error(ErrorCode::usage,
                fmt::format("{} has no cells of order {}. Choose --order {}, or a format that has: {}.", format.name,
                            order, format.highest_order, others));
}

std::string tell_values_left_out(const Format& format, const MeshOutline& outline) {
    if (outline.values.empty() || format.has_values) return "";
    std::vector<std::string> names;
    for (const PartValues& values : outline.values)  // at nodes and in cells by the same names
        if (std::find(names.begin(), names.end(), values.name) == names.end()) names.push_back(values.name);
    std::string others;
    for (const Format* other : table)
        if (other->has_values) others += fmt::format("{}{}", others.empty() ? "" : ", ", other->name);
    return fmt::format("{} has the mesh alone, without {}. {} have these, too.", format.name, fmt::join(names, ", "),
                       others);
}

void write_format(const Format& format, const PartSource& parts, ExportFiles& files) {
    require_order(format, parts.outline().order);
    if (format.is_merged_only()) return format.write_merged(parts, {}, files, "mesh");
    if (format.write_whole) format.write_whole(parts, files);
    if (!format.write_part) return;
    for (const PartIndex index : parts.outline().parts.ids()) {
        Part part = parts.load(index);
        if (format.needs_face_neighbours) connect_tets(part.mesh);
        format.write_part(parts, index, part, files);
    }
}

}  // namespace kerf

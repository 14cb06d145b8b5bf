#include "files/export/inside/msh_writer.h"

#include <fmt/format.h>

namespace kerf::msh {

namespace {

// $NodeData and $ElementData are alike in all versions. Tags have 32 bits.
class ValueSection {
 public:
    ValueSection(Writer& writer, const PartValues& values, std::int64_t count)
        : writer_(writer), name_(values.of == PartValues::Of::points ? "NodeData" : "ElementData") {
        const int components = values.components == 6 ? 9 : values.components;  // Gmsh knows whole tensors
        writer.file().write(fmt::format("${}\n1\n\"{}\"\n1\n0.0\n3\n0\n{}\n{}\n", name_,
                                        readable(values.name, longest_name), components, count));
    }
    ~ValueSection() = default;
    ValueSection(const ValueSection&) = delete;
    ValueSection& operator=(const ValueSection&) = delete;

    void row(std::int64_t number, const PartValues& values, std::size_t i) {
        writer_.number(tag_of(number));
        const auto at = [&](std::size_t c) { return values.number(values.components * i + c); };
        if (values.components == 6)
            for (const std::size_t c : {0, 3, 5, 3, 1, 4, 5, 4, 2}) writer_.real(at(c));  // of XX YY ZZ XY YZ XZ
        else
            for (int c = 0; c < values.components; ++c) writer_.real(at(c));
        writer_.end_row();
    }
    void end() { writer_.end(name_); }

 private:
    Writer& writer_;
    const char* name_;
};

// Writes the values of a part, at the nodes for which wanted(n) holds, and in its tetrahedra.
template <class Wanted>
void write_rows_of_part(ValueSection& section, const Part& part, std::size_t k, std::int64_t first_tet,
                        const Wanted& wanted) {
    const PartValues& values = part.values[k];
    if (values.of == PartValues::Of::tets) {
        for (std::size_t t = 0; t < part.mesh.tets.size(); ++t) section.row(first_tet + t, values, t);
        return;
    }
    for (std::int64_t n = 0; n < part.node_count(); ++n)
        if (wanted(n)) section.row(part.node_id(n), values, n);
}

}  // namespace

void write_names(ExportFile& file, const Tags& tags, const MeshOutline& outline) {
    // Programs look for groups by name, of whatever dimension: no region is called as a patch is.
    std::vector<std::string> names = outline.patch_names;
    names.insert(names.end(), outline.region_names.begin(), outline.region_names.end());
    names = readable_names(names);
    const std::int32_t patches = std::ssize(outline.patch_names);
    file.write(fmt::format("$PhysicalNames\n{}\n", patches + tags.materials()));
    for (std::int32_t patch = 0; patch < patches; ++patch)
        file.write(fmt::format("2 {} \"{}\"\n", Tags::physical_patch(patch), names[patch]));
    for (std::int32_t material = 0; material < tags.materials(); ++material) {
        const std::string name = !outline.region_names.empty() ? names[patches + material]
                                 : tags.materials() == 1       ? "volume"
                                                               : fmt::format("body_{}", material + 1);
        file.write(fmt::format("3 {} \"{}\"\n", tags.physical_material(material), name));
    }
    file.write("$EndPhysicalNames\n");
}

void require_tags_fit(const MeshOutline& outline) {
    if (!outline.values.empty()) require_numbers_fit(outline, "values in MSH", most_int32 - 1);
}

void write_part_values(const MeshOutline& outline, PartIndex index, const Part& part, Writer& writer) {
    for (std::size_t k = 0; k < part.values.size(); ++k) {
        const bool of_points = part.values[k].of == PartValues::Of::points;
        ValueSection section(writer, part.values[k], of_points ? part.node_count() : part.tet_count());
        write_rows_of_part(section, part, k, outline.first_tet(index), [](std::size_t) { return true; });
        section.end();
    }
}

void write_merged_values(const PartSource& parts, Writer& writer) {
    const MeshOutline& outline = parts.outline();
    for (std::size_t k = 0; k < outline.values.size(); ++k) {
        const bool of_points = outline.values[k].of == PartValues::Of::points;
        ValueSection section(writer, outline.values[k], of_points ? outline.nodes() : outline.tets());
        for_each_part(parts, PartContent::all, [&](PartIndex index, const Part& part) {
            const std::vector<bool> is_own = own_nodes(part);
            write_rows_of_part(section, part, k, outline.first_tet(index), [&](std::size_t n) { return is_own[n]; });
        });
        section.end();
    }
}

}  // namespace kerf::msh

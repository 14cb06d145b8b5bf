// VTK XML: a file a part (files/part/vtu_writer.h) and one that joins them; or, merged, all as one grid.
#include <filesystem>

#include "files/export/format.h"
#include "files/export/inside/whole_grid.h"
#include "files/io/run_folder.h"
#include "files/part/vtu_writer.h"

namespace kerf {

namespace vtu {

std::string file_of_part(NodeId id) { return "parts/" + part_file_name(id); }

void write_joining_file(const PartSource& parts, ExportFiles& files) {
    std::vector<std::string> pieces;
    for (const PartExtent& part : parts.outline().parts) pieces.push_back(file_of_part(part.id));
    ExportFile file = files.create("mesh.pvtu");
    file.write(pvtu_text(pieces, layout_for(parts.outline(), files.options().fields), parts.outline().values));
    file.close();
}

void write_piece(const PartSource& parts, PartIndex, const Part& part, ExportFiles& files) {
    const std::string name = file_of_part(part.id), path = files.path_of(name);
    const FileHash hash = write_part(path, part, layout_for(parts.outline(), files.options().fields), part.values);
    files.add({name, static_cast<std::int64_t>(std::filesystem::file_size(path)), hash_text(hash)});
}

void write_merged(const PartSource& parts, const MergeOptions&, ExportFiles& files, const std::string& stem) {
    ExportFile file = files.create(stem + ".vtu");
    ValueFile values(file);
    whole_grid(parts).write(values);
    file.close();
}

}  // namespace vtu

extern const Format vtu_format = {.name = "vtu",
                                  .help = "VTK XML: ParaView, meshio, pyvista",
                                  .ending = ".vtu",
                                  .kind = output_kind::vtu,
                                  .asks_for_one_part = true,
                                  .has_values = true,
                                  .write_whole = vtu::write_joining_file,
                                  .write_part = vtu::write_piece,
                                  .write_merged = vtu::write_merged};

}  // namespace kerf

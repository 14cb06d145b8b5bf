// VTK XML: a file a part and one that joins them.
#include <filesystem>

#include "export/format.h"
#include "io/run_folder.h"
#include "part/vtu_writer.h"

namespace kerf {

namespace {

std::string vtu_file_of(NodeId id) { return "parts/" + part_file_name(id); }

void write_joining_file(const PartSource& parts, ExportFiles& files) {
    std::vector<std::string> pieces;
    for (const PartExtent& part : parts.outline().parts) pieces.push_back(vtu_file_of(part.id));
    ExportFile file = files.create("mesh.pvtu");
    file.text(pvtu_text(pieces));
    file.close();
}

void write_piece(const PartSource&, std::int32_t, const Part& part, ExportFiles& files) {
    const std::string name = vtu_file_of(part.id), path = files.path_of(name);
    const FileHash hash = write_part(path, part);
    files.add({name, static_cast<std::int64_t>(std::filesystem::file_size(path)), hash_text(hash)});
}

}  // namespace

extern const Format vtu_format = {.name = "vtu",
                                  .help = "VTK XML: ParaView, meshio, pyvista",
                                  .ending = nullptr,
                                  .write_whole = write_joining_file,
                                  .write_part = write_piece};

}  // namespace kerf

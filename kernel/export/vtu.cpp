// VTK XML: a file a part and one that joins them.
#include "export/format.h"
#include "io/run_folder.h"
#include "part/vtu_writer.h"

namespace kerf {

namespace {

void write_joining_file(const PartSource& parts, ExportFiles& files) {
    std::vector<std::string> pieces;
    for (const PartExtent& part : parts.outline().parts) pieces.push_back("parts/" + part_file_name(part.id));
    ExportFile file = files.create("mesh.pvtu");
    file.text(pvtu_text(pieces));
    file.close();
}

}  // namespace

extern const Format vtu_format = {
    .name = "vtu", .help = "VTK XML: ParaView, meshio, pyvista", .ending = nullptr, .write_whole = write_joining_file};

}  // namespace kerf

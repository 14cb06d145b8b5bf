#include "cli/verify.h"

#include <fmt/format.h>

#include "core/error.h"
#include "run/verify_folder.h"

namespace kerf {

int verify_run(const std::string& folder) {
    const FolderVerification found = verify_folder(folder);
    const RunVerification& laws = found.laws;
    fmt::print("{}: {} parts, {} tetrahedra, {} vertices, volume error {:.1e}\n", folder, found.parts, found.tets,
               found.vertices, laws.volume_rel_error);
    const auto line = [](std::int64_t count, const char* what) {
        if (count) fmt::print("  {} {}\n", count, what);
    };
    line(laws.input_faces_missing, "facets of the input missing");
    line(laws.extra_boundary_faces, "boundary faces that are neither input nor interface");
    line(laws.unmatched_interface_faces, "interface triangles without a partner of opposite orientation");
    line(found.wrong_neighbours, "interface triangles that name the wrong neighbour");
    line(laws.inverted_tets, "tetrahedra that are not positively oriented");
    line(laws.tets_zero_parts, "parts without tetrahedra");
    line(found.moved_vertices, "vertices whose coordinates differ between parts or from the input");
    line(found.misnumbered, "wrong global vertex numbers");
    for (const std::string& note : found.notes) fmt::print("  note: {}\n", note);
    fmt::print("{}\n", laws.passed ? "Every law holds." : "The mesh is NOT valid. Run kerf mesh again.");
    return laws.passed ? 0 : static_cast<int>(ErrorCode::verification);
}

}  // namespace kerf

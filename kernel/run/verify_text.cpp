// What kerf verify found, for people.
#include <fmt/format.h>

#include "core/error.h"
#include "run/verify_folder.h"

namespace kerf {

int FolderVerification::exit_code() const {
    if (!laws.passed) return static_cast<int>(ErrorCode::verification);
    return not_compared.empty() ? 0 : static_cast<int>(ErrorCode::io);
}

std::string to_text(const FolderVerification& found, const std::string& folder, const VerifyOptions& options) {
    const RunVerification& laws = found.laws;
    std::string text = fmt::format("{}: {} parts, {} tetrahedra, {} vertices, volume error {:.1e}\n", folder,
                                   found.parts, found.tets, found.vertices, laws.volume_rel_error);
    const auto line = [&](std::int64_t count, const char* what) {
        if (count) text += fmt::format("  {} {}\n", count, what);
    };
    if (!(laws.volume_rel_error <= laws.volume_rel_bound))
        text += fmt::format("  volume error above {:.1e}, which rounding explains\n", laws.volume_rel_bound);
    line(laws.input_faces_missing, "facets of the input missing");
    line(laws.extra_boundary_faces, "boundary faces that are neither input nor interface");
    line(laws.unmatched_interface_faces, "interface triangles without a partner of opposite orientation");
    line(found.wrong_neighbours, "interface triangles that name the wrong neighbour");
    line(laws.inverted_tets, "tetrahedra that are not positively oriented");
    line(laws.tets_zero_parts, "parts without tetrahedra");
    line(found.moved_vertices, "vertices whose coordinates differ between parts or from the input");
    line(found.misnumbered, "wrong global vertex numbers");
    for (const std::string& difference : found.differences) text += fmt::format("  {}\n", difference);
    if (!laws.passed)
        text += "The mesh is NOT valid. Run kerf mesh again.\n";
    else if (options.without_input)
        text += "The laws of the mesh hold. It was not compared with the input.\n";
    else if (found.not_compared.empty())
        text += "Every law holds.\n";
    else
        text += fmt::format(
            "The laws of the mesh hold, but it was not compared with the input: {}\n"
            "If it lies elsewhere now, name it: --input FILE. --without-input does without.\n",
            found.not_compared);
    return text;
}

}  // namespace kerf

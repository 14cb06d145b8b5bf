// VTK's PolyData (.vtp): the surface of the mesh without its inside, that is the triangles on patches, each once, in
// the order of the tree, over those vertices that they have. Of several regions, a triangle knows both that it is
// between: what lists it knows the one behind it, the part on the other side of a wall the one in front. The file is
// that of files/io/surface_writers.h, so that Kerf reads it as a surface with patches and regions. The surface is held
// in memory; PolyData have no cells of second order.
#include <algorithm>
#include <functional>
#include <vector>

#include "files/export/format.h"
#include "files/export/whole_mesh.h"
#include "files/io/surface_writers.h"
#include "files/part/region_walls.h"
#include "surface/soup/soup.h"

namespace kerf {

namespace vtp {

void for_each_facet(const PartSource& parts, const std::function<void(const Part& part, std::size_t f)>& take) {
    for_each_part(parts, PartContent::surface, [&](PartIndex, const Part& part) {
        for_each_listed_facet(part, [&](std::size_t f) { take(part, f); });
    });
}

// The global numbers of the vertices on patches, ascending.
std::vector<std::int64_t> vertices_on_patches(const PartSource& parts) {
    std::vector<std::int64_t> ids;
    for_each_facet(parts, [&](const Part& part, std::size_t f) {
        for (const std::int64_t id : global_corners(part, part.facets[f])) ids.push_back(id);
    });
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
}

// Regions of a triangle; of the other side of a wall the source knows it.
FacetSides sides_of(const PartSource& parts, const Part& part, std::size_t f) {
    return {part.is_wall(f) ? parts.walls().beyond(part, f) : RegionIndex::none(), region_behind(part, f)};
}

Soup surface_of(const PartSource& parts) {
    const std::vector<std::int64_t> ids = vertices_on_patches(parts);
    Soup soup;
    soup.patch_names = parts.outline().patch_names;
    soup.region_names = parts.outline().region_names;
    soup.vertices.resize(ids.size());
    for_each_facet(parts, [&](const Part& part, std::size_t f) {
        Triangle facet;
        for (std::size_t i = 0; i < facet.size(); ++i) {
            const std::int32_t v = part.facets[f][i];
            facet[i] = std::lower_bound(ids.begin(), ids.end(), part.global_id[v]) - ids.begin();
            soup.vertices[facet[i]] = part.mesh.vertices[v];
        }
        soup.facets.push_back(facet);
        soup.patch.push_back(part.patch[f]);
        if (!soup.region_names.empty()) soup.sides.push_back(sides_of(parts, part, f));
    });
    return soup;
}

void write_merged(const PartSource& parts, const MergeOptions&, ExportFiles& files, const std::string& stem) {
    require_numbers_fit(parts.outline(), "vtp", most_of_32_bits);
    ExportFile file = files.create(stem + ".vtp");
    file.write(vtp_text(surface_of(parts)));
    file.close();
}

}  // namespace vtp

extern const Format vtp_format = {.name = "vtp",
                                  .help = "the surface alone, as VTK's PolyData: ParaView, 3D Slicer",
                                  .ending = ".vtp",
                                  .kind = output_kind::surface,
                                  .highest_order = 1,
                                  .write_merged = vtp::write_merged};

}  // namespace kerf

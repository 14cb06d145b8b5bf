#include "export/patch_pieces.h"

#include <algorithm>

namespace kerf {

namespace {

std::vector<PatchPiece> facets_by_patch(const Part& part) {
    std::vector<PatchPiece> pieces(part.patch_names.size());
    std::int32_t place = 0;
    for (std::size_t f = 0; f < part.facets.size(); ++f) {
        if (part.patch[f] < 0) continue;
        PatchPiece& piece = pieces[part.patch[f]];
        piece.patch = part.patch[f];
        piece.facets.push_back(f);
        piece.places.push_back(place++);
    }
    std::erase_if(pieces, [](const PatchPiece& piece) { return piece.facets.empty(); });
    return pieces;
}

// `is_wanted`: of each vertex.
PatchPieces pieces_with(const Part& part, const std::vector<bool>& is_wanted) {
    PatchPieces pieces{facets_by_patch(part), {}, {}};
    std::vector<bool> is_left = is_wanted;
    for (PatchPiece& piece : pieces.on_patches)
        for (const std::int32_t f : piece.facets)
            for (const std::int32_t v : part.facets[f]) {
                piece.box.extend(part.mesh.vertices[v]);
                if (is_left[v]) piece.vertices.push_back(v);
                is_left[v] = false;
            }
    for (std::size_t v = 0; v < is_left.size(); ++v) {
        pieces.box.extend(part.mesh.vertices[v]);
        if (is_left[v]) pieces.inside.push_back(v);
    }
    return pieces;
}

}  // namespace

PatchPieces patch_pieces(const Part& part) {
    return pieces_with(part, std::vector<bool>(part.mesh.vertices.size(), true));
}

PatchPieces owned_patch_pieces(const Part& part) {
    const std::vector<NodeId> owner = owners_of_vertices(part);
    std::vector<bool> is_owned(owner.size());
    for (std::size_t v = 0; v < owner.size(); ++v) is_owned[v] = owner[v] == part.id;
    return pieces_with(part, is_owned);
}

}  // namespace kerf

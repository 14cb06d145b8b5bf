// The mesh of a region in a processor is cut out of the part: its cells, their vertices, and as boundary all triangles
// that have one of these cells behind them. Walls to another region come from two sources: between parts they are
// facets of the part, within a part they are faces between cells, which are found by the neighbours. Both get the patch
// REGION_to_OTHER, of the type mappedWall, which samples OTHER_to_REGION there. Its place is that of the other region
// among the neighbours of the region, in the whole mesh, so that all processors agree on patches of which they have no
// face. "Whole" is the part with all regions, "local" are numbers within the region.
#include "files/export/inside/openfoam_regions.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/core/check.h"
#include "base/core/ids.h"

namespace kerf::openfoam {

namespace {
namespace regions {

// Words of regions must not be the names of files and folders that lie where theirs do, nor that of a mesh without
// regions.
WordRules rules() {
    WordRules rules = word_rules("region");
    for (const char* taken :
         {"polyMesh", "region0", "regionProperties", "controlDict", "decomposeParDict", "fvSchemes", "fvSolution"})
        rules.taken.emplace_back(taken);
    return rules;
}

std::int32_t position_in(const std::vector<RegionIndex>& ascending, RegionIndex region) {
    return std::lower_bound(ascending.begin(), ascending.end(), region) - ascending.begin();
}

Patch mapped_patch(const std::string& word, const std::string& other_region, const std::string& other_patch) {
    Patch patch;
    patch.name = word;
    patch.type = "mappedWall";
    patch.entries = fmt::format(
        "        sampleMode      nearestPatchFace;\n        sampleRegion    {};\n        samplePatch     {};\n"
        "        offsetMode      uniform;\n        offset          (0 0 0);\n",
        other_region, other_patch);
    return patch;
}

// The cells of one region with numbers of their own.
class Extract {
 public:
    Extract(const Part& whole, RegionIndex region, Part& piece) : whole_(whole), piece_(piece) {
        local_tet_.assign(whole.mesh.tets.size(), CellId::none());
        local_vertex_.assign(whole.mesh.vertices.size(), -1);
        for (std::size_t run = 0; run < whole.regions.size(); ++run) {
            if (whole.regions[run].region != region) continue;
            const bool is_last = run + 1 == whole.regions.size();
            const std::int32_t end = is_last ? whole.tet_count() : whole.regions[run + 1].first_tet;
            for (std::int32_t t = whole.regions[run].first_tet; t < end; ++t) tets_.emplace_back(t);
        }
        for (std::size_t i = 0; i < tets_.size(); ++i) {
            local_tet_[tets_[i]] = CellId(i);
            for (const std::int32_t v : whole.mesh.tets[tets_[i]]) local_vertex_[v] = 0;
        }
        for (std::size_t v = 0; v < local_vertex_.size(); ++v) {
            if (local_vertex_[v] < 0) continue;
            local_vertex_[v] = count_of(piece.mesh.vertices);
            piece.mesh.vertices.push_back(whole.mesh.vertices[v]);
            piece.global_id.push_back(whole.global_id[v]);
        }
        for (const CellId t : tets_) {
            piece.mesh.tets.push_back(local(whole.mesh.tets[t]));
            auto& across = piece.mesh.neighbours.emplace_back(whole.mesh.neighbours[t]);
            for (CellId& neighbour : across) neighbour = neighbour.is_valid() ? local_tet_[neighbour] : CellId::none();
        }
    }
    bool has(CellId tet) const { return local_tet_[tet].is_valid(); }
    // Adds a triangle with this cell behind it, both numbered as in the whole.
    void add(const Triangle& corners, CellId tet, std::int32_t patch, NodeId neighbour) {
        piece_.facets.push_back(local(corners));
        piece_.patch.push_back(patch);
        piece_.neighbour.push_back(neighbour);
        piece_.tet_at_facet.push_back(local_tet_[tet].value());
    }
    // Calls take(corners, tet, beyond) for each face with a cell of another region beyond it.
    template <class Take>
    void for_each_inner_wall(const Take& take) const {
        for (const CellId t : tets_)
            for (std::size_t i = 0; i < 4; ++i)
                if (const CellId beyond = whole_.mesh.neighbours[t][i]; beyond.is_valid() && !has(beyond))
                    take(face_of_cell(whole_.mesh, t, i), t, beyond);
    }

 private:
    template <std::size_t n>
    std::array<std::int32_t, n> local(std::array<std::int32_t, n> corners) const {
        for (std::int32_t& v : corners) v = local_vertex_[v];
        return corners;
    }

    const Part& whole_;
    Part& piece_;
    std::vector<CellId> tets_;
    Array<CellId, CellId> local_tet_;
    std::vector<std::int32_t> local_vertex_;
};

}  // namespace regions
}  // namespace

RegionMeshes::RegionMeshes(const PartSource& parts, std::span<const PatchType> types)
    : outline_(parts.outline()), walls_(parts.walls()), of_surface_(patches_of_surface(outline_.patch_names, types)) {
    for (const std::string& word : word_names(outline_.region_names, regions::rules())) words_.push_back(word);
    for (const RegionIndex region : words_.ids()) {
        WordRules rules = word_rules();
        for (const std::int32_t patch : walls_.outer_patches(region)) rules.taken.push_back(of_surface_[patch].name);
        std::vector<std::string> names;
        for (const RegionIndex other : walls_.neighbours(region))
            names.push_back(fmt::format("{}_to_{}", words_[region], words_[other]));
        wall_words_.push_back(word_names(names, rules));
    }
}

// Returns the place of the patch towards another region: behind the patches of the surface.
std::int32_t RegionMeshes::wall_patch(RegionIndex region, RegionIndex other) const {
    return count_of(walls_.outer_patches(region)) + regions::position_in(walls_.neighbours(region), other);
}

std::vector<Patch> RegionMeshes::patches(RegionIndex region) const {
    std::vector<Patch> patches;
    for (const std::int32_t patch : walls_.outer_patches(region)) patches.push_back(of_surface_[patch]);
    const std::vector<RegionIndex>& others = walls_.neighbours(region);
    for (std::size_t i = 0; i < others.size(); ++i) {
        const std::int32_t back = regions::position_in(walls_.neighbours(others[i]), region);
        patches.push_back(
            regions::mapped_patch(wall_words_[region][i], words_[others[i]], wall_words_[others[i]][back]));
    }
    return patches;
}

Part RegionMeshes::part_of(const Part& part, RegionIndex region) const {
    KERF_CHECK(part.mesh.neighbours.size() == part.mesh.tets.size());
    Part piece;
    piece.id = part.id;
    regions::Extract extract(part, region, piece);
    const std::vector<std::int32_t>& outer = walls_.outer_patches(region);
    for (std::size_t f = 0; f < part.facets.size(); ++f) {
        const CellId tet(part.tet_at_facet[f]);
        if (!extract.has(tet)) continue;
        if (part.is_wall(f))
            extract.add(part.facets[f], tet, wall_patch(region, walls_.beyond(part, f)), NodeId::none());
        else if (part.is_interface(f))
            extract.add(part.facets[f], tet, -1, part.neighbour[f]);
        else
            extract.add(part.facets[f], tet,
                        std::lower_bound(outer.begin(), outer.end(), part.patch[f]) - outer.begin(), NodeId::none());
    }
    extract.for_each_inner_wall([&](const Triangle& corners, CellId tet, CellId beyond) {
        extract.add(corners, tet, wall_patch(region, part.region_of(beyond.value())), NodeId::none());
    });
    return piece;
}

}  // namespace kerf::openfoam

// Meshers: from a closed surface to the tetrahedra inside.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "base/core/user_number.h"
#include "fill/improve/improve.h"
#include "fill/mesh/tet_mesh.h"
#include "fill/shell/facet_recovery_counts.h"
#include "surface/complex/surface.h"
#include "surface/size/size_field.h"

namespace kerf {

inline constexpr NumberRange radius_edge_range = {"0 (no refinement) or above 1", 1,
                                                  std::numeric_limits<double>::infinity(), true, true};

/// The options of TetGen alone.
struct TetgenOptions {
    std::string switches;  ///< switches of an expert, which replace the bounds of MesherOptions; a volume is in units
                           ///< of the input cubed
    double tolerance = 0;  ///< relative tolerance for points that count as coplanar; 0: TetGen's own
    std::uint32_t shuffle = 0;  ///< seed of a fixed shuffle of vertices and facets, the usual cure when TetGen fails;
                                ///< 0: they are handed over as they are

    template <class Archive>
    void archive(Archive& a) {
        a(switches, tolerance, shuffle);
    }
};

/// The choices that hold for all bodies of a run.
struct MesherChoices {
    std::string name = "auto";  ///< name of the mesher, see meshers()
    double radius_edge = 1.4;   ///< upper bound of circumradius over shortest edge; > 1, 0: no refinement
    /// Whether the cells are improved, within their size, see improve(); never those of TetGen's own switches, but for
    /// cells without volume.
    bool improve = true;
    TetgenOptions tetgen = {};  ///< options of TetGen, also for meshers that ask it where they fail
};

/// The options for one body.
struct MesherOptions : MesherChoices {
    MesherOptions() = default;
    explicit MesherOptions(MesherChoices choices, SizeField size_of_body = {})
        : MesherChoices(std::move(choices)), size(std::move(size_of_body)) {}

    SizeField size;  ///< size of tetrahedra. TetGen leaves a few larger ones: next to coarse facets, and where it
                     ///< improved the shape afterwards

    template <class Archive>
    void archive(Archive& a) {
        a(name, size, radius_edge, improve, tetgen);
    }
};

/// Filling::strategy of Kerf's own meshers where TetGen has filled the surface for them.
inline constexpr std::string_view way_by_tetgen = "TetGen: the shell has failed";

/// The result of a mesher.
struct Filling {
    TetMesh mesh;             ///< mesh, with neighbours only if the mesher knows them anyway
    std::string strategy;     ///< the way that the mesher went, in a few words for the report; empty if it has only one
    std::string reason = {};  ///< reason why it did not go its first way, in a sentence; empty if it did
    std::int64_t core_tets = 0;         ///< number of the first cells that were stamped; the others are of the shell
    FacetRecoveryCounts recovery = {};  ///< counts of the shell's facets; empty where TetGen has filled the surface
    Improvement improvement = {};       ///< improvement of the cells; empty if there was none
    double improve_seconds = 0;         ///< wall clock of the improvement
};

/// Checks the options of a mesher. Throws Error(usage), naming the option, for values out of range, for names of no
/// mesher, and for options that the mesher refuses.
void check_mesher_options(const MesherChoices& options);

/// Fills the closed surface, which must be well-formed, with tetrahedra; every facet of it is kept and none is added.
/// It may touch itself at vertices and along edges, which are there once then (joined_by_key(),
/// surface/complex/touching.h): no two vertices lie at the same place.
///
/// Cells have a volume also as doubles have it, wherever the surface has room for such: where the mesher leaves others
/// they are replaced, with new vertices inside if it takes them (MeshLaws::tets_without_volume counts the cells that
/// are left).
///
/// The result's boundary vertices are those of the surface, bit for bit and in its order. Throws Error(subdomain) with
/// the mesher's reason, Error(memory) if the reason is memory, Error(usage) for options out of range. A mesher may also
/// abort, hang or exhaust memory, so call it in a process of its own, and it need not be thread-safe. Deterministic.
Filling mesh_volume(const SurfaceArrays& surface, const MesherOptions& options);

/// Returns one point inside every void shell (a shell that encloses negative volume) of a closed surface, which may
/// touch itself like that of mesh_volume(). Each point is proven to lie in its void by ray parity. Throws
/// Error(subdomain) where none is found.
std::vector<Vec3> hole_points(const SurfaceArrays& surface);

}  // namespace kerf

// What is open: plain data that the session replaces as it learns more. Panels and scene only read it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "core/error.h"
#include "prepare/input.h"
#include "request/options.h"
#include "run/trace.h"
#include "viewer/model/region_places.h"
#include "viewer/model/solution.h"
#include "viewer/model/tree.h"

namespace kerf::view {

/// The nodes on the edges of cells of second order.
struct EdgePoints {
    std::vector<Vec3> places;                       ///< #E
    std::vector<std::array<std::int32_t, 2>> ends;  ///< #E; vertices
    std::vector<std::int32_t> node;                 ///< #E; number among the nodes of the part: vertices, then edges

    bool empty() const { return places.empty(); }
};

/// A surface whose facets may be cut by earlier interfaces: of a node, or of a part.
struct NodeSurface {
    std::vector<Vec3> vertices;
    std::vector<Triangle> facets;
    std::vector<std::int32_t> patch;         ///< #F; of the input, -1 on interfaces
    std::vector<NodeId> interface_of;        ///< #F; the node whose cut made it, 0: the input's surface, -1: not known
    std::vector<std::int32_t> neighbour;     ///< #F; of a part: the part behind an interface or wall, else -1. Or empty
    std::vector<std::int32_t> facet_number;  ///< #F; of the facet in the input, -1 on interfaces
    std::vector<std::int64_t> vertex_number;  ///< #V; global number (parts) or number in the input; -1: interior of an
                                              ///< interface
    EdgePoints edges = {};                    ///< of a part of second order
    std::vector<std::array<std::int32_t, 3>> edges_of_facet = {};  ///< #F; numbers in `edges`, of 01, 12, 02. Or empty

    bool is_interface(std::int32_t facet) const {
        return !interface_of.empty() && interface_of[static_cast<std::size_t>(facet)] != 0;
    }
};

/// Values on a surface: of its facets or its vertices.
struct SurfaceValues {
    std::shared_ptr<const NodeSurface> surface;
    std::vector<float> values;  ///< #F or #V; NaN: none there
};

/// How a cell came to be.
enum class CellOrigin {
    core,   ///< stamped from a lattice
    shell,  ///< of the same mesher, between core and surface
    other,  ///< of a mesher that stamps nothing
};
/// Of a cell of a part by its number there.
constexpr CellOrigin origin_of(std::int64_t tet, std::int64_t core_tets) {
    return core_tets == 0 ? CellOrigin::other : tet < core_tets ? CellOrigin::core : CellOrigin::shell;
}

/// What stands for a node where surfaces are asked for that were there before the one that was cut: as it was before
/// remeshing, and before repairs.
inline constexpr NodeId not_remeshed = 0, not_repaired = -1;

/// The tetrahedra of one part.
struct PartCells {
    NodeId part = 1;
    std::vector<Vec3> vertices;  ///< the boundary's come first and are those of the part's surface
    std::int32_t boundary_vertex_count = 0;
    std::vector<std::array<std::int32_t, 4>> tets;
    std::vector<std::array<std::int32_t, 4>> neighbours;         ///< across the face opposite to corner i, or -1
    std::vector<std::int32_t> tet_at_facet;                      ///< per facet of the part's surface
    std::vector<std::int64_t> vertex_number;                     ///< global
    std::vector<char> at_interface;                              ///< per tet: it has a vertex on an interface
    std::int64_t core_tets = 0;                                  ///< Filling::core_tets
    EdgePoints edges = {};                                       ///< of second order
    std::vector<std::array<std::int32_t, 6>> edges_of_tet = {};  ///< #T; numbers in `edges`, of 01 12 02 03 13 23
};

/// A histogram over all cells of a run; the bins are those of report.json.
struct MeasureHistogram {
    std::vector<double> edges;                           ///< n + 1
    std::vector<std::int64_t> all, interface, interior;  ///< n
    double min = 0, max = 0, median = 0;
    double p1 = -1;  ///< 1 % of the cells are below; negative: not known
};

/// One of the worst cells.
struct WorstCell {
    NodeId part = 0;
    std::int32_t cell = -1;
    double value = 0;
    Vec3 center = Vec3::Zero();
};

struct Progress {
    bool running = false;  ///< a run is under way: ours or another's; or a repair, which is ours
    bool ours = false;     ///< it can be cancelled
    std::string stage;     ///< "repair" of a surface; of a run "read", "remesh", "decompose", "prepare", "volume",
                           ///< "reference", "write", "hash"
    std::int64_t parts_done = 0, parts = 0;
    double load_done = 0;  ///< in [0, 1]
    double seconds = 0;    ///< since its start
    std::string message;   ///< how it ended, if not well
    int exit_code = 0;     ///< of a run that has ended
};

struct Document {
    enum class Kind { none, surface, trace, run };
    Kind kind = Kind::none;
    std::string path;                      ///< as it was opened
    std::string title;                     ///< the file's or folder's name
    ErrorCode error_code = ErrorCode::io;  ///< of `error`
    std::string error;                 ///< why it could not be opened: nothing else is there then but perhaps `checked`
    std::shared_ptr<const Soup> soup;  ///< of a surface file: as it was read, or as repairs have left it
    std::shared_ptr<const CheckedSoup> checked;     ///< and what is wrong with it, once that is known
    std::shared_ptr<const CheckedSoup> unrepaired;  ///< as the file has it, where repairs have changed it; else null
    std::shared_ptr<const Trace> trace;             ///< with all stages, if there is one
    Tree tree;
    std::string folder;                          ///< of the parts; empty: none
    std::string surface_saved_as;                ///< where Repairs::save() has written `checked`
    std::string saved_as;                        ///< where RunPair::save() has put a copy of it; empty: nowhere
    double cut_seconds = -1, mesh_seconds = -1;  ///< of the whole run, wall clock; negative: not known
    std::optional<Solution> solution;            ///< that was opened, and stands on these parts
    RunOptions options;                          ///< of the run, or those of the next one
    bool remeshed = false;  ///< the surface that was cut is not that of the file, which is there to compare with
    std::vector<std::string> region_names;   ///< of several
    std::vector<RegionPlace> region_places;  ///< of these; empty: not known (yet)
    std::vector<std::string> patch_names;
    std::vector<std::array<std::uint8_t, 4>> patch_colours;  ///< as Soup has them; empty: none
    Eigen::AlignedBox3d box;                                 ///< of the body
    std::int64_t input_facets = 0, input_vertices = 0;
    double volume = 0;
    std::array<std::optional<MeasureHistogram>, 8> histograms;  ///< in the order of quality_measures
    std::vector<std::string> notes;
    Progress progress;

    bool is_opening() const;          ///< nothing of it is there yet
    bool has_surfaces_alone() const;  ///< the folder is one of kerf decompose: its parts have no cells
    bool has_problems() const;        ///< the surface cannot be meshed as it is, or could not be read
};

}  // namespace kerf::view

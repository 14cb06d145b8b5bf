// The open document: plain data that the session replaces as it learns more. Panels and scene only read it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "base/core/error.h"
#include "fill/mesh/tet_mesh.h"
#include "run/prepare/input.h"
#include "run/request/run_request.h"
#include "run/run/trace.h"
#include "viewer/model/inside/region_places.h"
#include "viewer/model/inside/solution.h"
#include "viewer/model/tree.h"

namespace kerf::view {

/// The nodes on the edges of cells of second order.
struct EdgePoints {
    std::vector<Vec3> places;                       ///< #E
    std::vector<std::array<std::int32_t, 2>> ends;  ///< #E; the vertices at both ends
    std::vector<std::int32_t> node;                 ///< #E; number among the nodes of the part: vertices, then edges

    bool empty() const { return places.empty(); }
};

/// The surface of a node or of a part; earlier cuts may have divided its facets and added interfaces.
struct NodeSurface {
    std::vector<Vec3> vertices;
    std::vector<Triangle> facets;
    std::vector<std::int32_t> patch;   ///< #F; patch of the input, -1 on interfaces
    std::vector<NodeId> interface_of;  ///< #F; the node whose cut made the facet, no_node: none, none(): not known
    std::vector<NodeId> neighbour;     ///< #F or empty; of a part, the part behind an interface or wall, else none
    std::vector<std::int32_t> facet_number;   ///< #F; number of the facet in the input, -1 on interfaces
    std::vector<std::int64_t> vertex_number;  ///< #V; global number (parts) or number in the input; -1: interior of an
                                              ///< interface
    EdgePoints edges = {};                    ///< nodes on the edges of a part of second order
    std::vector<std::array<std::int32_t, 3>> edges_of_facet = {};  ///< #F or empty; indices in `edges`, of 01, 12, 02

    bool is_interface(std::size_t facet) const { return !interface_of.empty() && interface_of[facet] != no_node; }
};

/// Values of the facets or of the vertices of a surface.
struct SurfaceValues {
    std::shared_ptr<const NodeSurface> surface;
    std::vector<float> values;  ///< #F or #V; NaN: there is none
};

/// The way in which a cell was made.
enum class CellOrigin {
    core,   ///< stamped from a lattice
    shell,  ///< made by the same mesher between core and surface
    other,  ///< made by a mesher that stamps nothing
};
/// Returns the origin of a cell by its number in the part, whose first `core_tets` cells are its core.
constexpr CellOrigin origin_of(std::int64_t tet, std::int64_t core_tets) {
    return core_tets == 0 ? CellOrigin::other : tet < core_tets ? CellOrigin::core : CellOrigin::shell;
}

/// Numbers that stand for a node where a surface is asked for that was there before the one that was cut: the surface
/// before remeshing, and the one before repairs.
inline constexpr NodeId not_remeshed(0), not_repaired(-1);

/// The tetrahedra of one part.
struct PartCells {
    NodeId part = root_node;
    std::vector<Vec3> vertices;  ///< the boundary's come first and are those of the part's surface
    std::int32_t boundary_vertex_count = 0;
    std::vector<std::array<std::int32_t, 4>> tets;
    TetNeighbours neighbours;
    std::vector<std::int32_t> tet_at_facet;   ///< the cell behind each facet of the part's surface, or -1
    std::vector<std::int64_t> vertex_number;  ///< global numbers; -1: not known
    std::vector<char> at_interface;           ///< per tet: 1 if it has a vertex on an interface, else 0
    std::int64_t core_tets = 0;               ///< Filling::core_tets
    EdgePoints edges = {};                    ///< nodes on the edges of cells of second order
    std::vector<std::array<std::int32_t, 6>> edges_of_tet = {};  ///< #T; indices in `edges`, of 01 12 02 03 13 23
};

/// A histogram of a measure over all cells of a run; the bins are those of report.json.
struct MeasureHistogram {
    std::vector<double> edges;                           ///< n + 1 ends of the n bins
    std::vector<std::int64_t> all, interface, interior;  ///< n; counts of cells: all, at an interface, others
    double min = 0, max = 0, median = 0;
    double p1 = -1;  ///< the value that 1 % of the cells are below; negative: not known
};

/// One of the worst cells of a run by a measure, with its value.
struct WorstCell {
    NodeId part = no_node;
    std::int32_t cell = -1;
    double value = 0;
    Vec3 center = Vec3::Zero();
};

/// The progress of a run or of a repair.
struct Progress {
    bool running = false;  ///< a run of ours or of another process is under way, or a repair, which is ours
    bool ours = false;     ///< it was started by this session and can be cancelled
    std::string stage;     ///< "repair" for a repair; for a run "read", "remesh", "decompose", "prepare", "volume",
                           ///< "reference", "write", "hash"
    std::int64_t parts_done = 0, parts = 0;
    double load_done = 0;  ///< share of the load that is done, in [0, 1]
    double seconds = 0;    ///< seconds since the start
    std::string message;   ///< reason of an end without success; else empty
    int exit_code = 0;     ///< exit code of a run that has ended
};

/// The open surface, trace or run, with all that is known of it.
struct Document {
    enum class Kind { none, surface, trace, run };
    Kind kind = Kind::none;
    std::string path;                      ///< the path as it was given
    std::string title;                     ///< name of the file or folder
    ErrorCode error_code = ErrorCode::io;  ///< code of `error`
    std::string error;  ///< reason why it could not be opened; nothing else is there then but perhaps `checked`
    std::shared_ptr<const Soup> soup;               ///< content of a surface file, as read or as repairs have left it
    std::shared_ptr<const CheckedSoup> checked;     ///< the soup and its defects, once these are known
    std::shared_ptr<const CheckedSoup> unrepaired;  ///< the file's soup, where repairs have changed it; else null
    std::shared_ptr<const Trace> trace;             ///< trace with all stages of its cuts, if there is one
    Tree tree;
    std::string folder;                          ///< folder of the parts; empty: none
    std::string surface_saved_as;                ///< file to which Repairs::save() has written the surface; empty: none
    std::string saved_as;                        ///< place to which RunPair::save() has copied `folder`; empty: none
    double cut_seconds = -1, mesh_seconds = -1;  ///< wall clock of the whole run; negative: not known
    std::optional<bool> verified;                ///< whether all laws hold for the mesh of a run; none: not known
    std::optional<Solution> solution;            ///< the solution that was opened and stands on these parts
    RunRequest options;                          ///< options of the run, or of the next one
    bool remeshed = false;  ///< the surface that was cut is not that of the file, which is there to compare with
    std::vector<std::string> region_names;          ///< names of the regions, where there are several
    Array<RegionIndex, RegionPlace> region_places;  ///< places of these regions; empty: not known (yet)
    std::vector<std::string> patch_names;
    std::vector<std::array<std::uint8_t, 4>> patch_colours;  ///< RGBA, as Soup has them; empty: none
    Eigen::AlignedBox3d box;                                 ///< bounding box of the body
    std::int64_t input_facets = 0, input_vertices = 0;
    double volume = 0;
    std::array<std::optional<MeasureHistogram>, 8> histograms;  ///< in the order of quality_measures
    std::vector<std::string> notes;
    Progress progress;

    bool is_opening() const;          ///< whether nothing of it is there yet
    bool has_surfaces_alone() const;  ///< whether the folder is one of kerf decompose, whose parts have no cells
    bool has_problems() const;        ///< whether the surface cannot be meshed as it is, or could not be read
};

}  // namespace kerf::view

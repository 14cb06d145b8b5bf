// Measures the quality of a whole mesh: of a run, or of a file of any program.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "files/io/tet_mesh_reader.h"
#include "files/part/run_parts.h"
#include "fill/mesh/quality.h"

namespace kerf {

/// The fractions of the percentiles that reports have of a distribution, from the least value to the largest.
inline constexpr std::array<double, 7> quality_fractions = {0, 0.001, 0.01, 0.05, 0.5, 0.95, 1};
using Percentiles = std::array<double, quality_fractions.size()>;
Percentiles percentiles_of(const Distribution& distribution);

/// The quality of the cells of one of several regions.
struct RegionQuality {
    std::string name;
    std::int64_t tets = 0;
    double volume = 0;
    std::array<Percentiles, quality_measures.size()> measures{};  ///< in the order of quality_measures
};

/// Cells of a run of order 2 that have an edge whose node is not in its middle.
struct CurvedCells {
    std::int64_t count = 0;
    double worst_scaled_jacobian = 1;  ///< see fill/mesh/curved_tet.h; 1 without such cells
};

struct MeshQuality {
    std::string name;  ///< name for people
    std::int64_t parts = 1;
    std::int64_t vertices = 0;  ///< distinct vertices
    PartQuality cells;
    TriangleDistributions boundary;           ///< angles of the triangles on the user's surface; may be empty
    std::int64_t turned_tets = 0;             ///< tetrahedra of negative orientation in their file
    std::vector<std::string> notes = {};      ///< other content of the file that was passed over
    std::vector<RegionQuality> regions = {};  ///< in the order of their numbers; empty if there is one region
    std::optional<CurvedCells> curved = {};   ///< for runs of order 2 only

    std::int64_t tets() const { return cells.all.measures.front().count(); }
};

/// A mesh that is known to be readable, but not measured yet. Memory: of a run one part at a time and 92 kB for each of
/// several regions, of a file the whole.
class MeasurableMesh {
 public:
    /// Takes the folder of a finished run, or a file as read_tet_file() reads them. Throws Error(io) or Error(input).
    explicit MeasurableMesh(const std::string& path);
    /// Takes parts of any origin, with the diagonal of all of them; `name` is for people.
    MeasurableMesh(std::unique_ptr<const PartSource> parts, std::string name, double diagonal);

    /// Returns the diagonal of the bounding box. Distributions that are to be compared need one length scale: the
    /// larger diagonal.
    double diagonal() const { return diagonal_; }

    /// Measures the mesh. A file without triangles has as its boundary the faces that only one tetrahedron has.
    MeshQuality measure(double length_scale) const;

 private:
    void add(const Part& part, double length_scale, MeshQuality& quality) const;
    void measure_run(double length_scale, MeshQuality& quality) const;
    std::vector<RegionQuality> regions_of_file(double length_scale) const;
    void open_run();
    void open_file();

    std::string path_;
    std::unique_ptr<const PartSource> run_;
    TetFile file_;  // if there is no run
    double diagonal_ = 0;
};

}  // namespace kerf

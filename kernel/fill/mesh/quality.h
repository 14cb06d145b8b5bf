// Shape measures of tetrahedra and their distributions, which can be added over parts.
#pragma once

#include <array>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "fill/mesh/inside/forced_cells.h"
#include "fill/mesh/tet_mesh.h"

namespace kerf {

/// Measures of one tetrahedron.
struct TetQuality {
    double min_dihedral_deg;  ///< smallest of the six dihedral angles
    double max_dihedral_deg;  ///< largest of the six dihedral angles
    double radius_edge;       ///< circumradius over shortest edge; 0.612 for the regular tetrahedron
    double aspect;            ///< longest edge over 2 sqrt(6) inradii; 1 for the regular tetrahedron
    double shape;             ///< 6 sqrt(2) V / mean of the six cubed edges; 1 for the regular tetrahedron, else below
    double volume;            ///< signed, positive for the orientation of TetMesh
    double min_edge;
    double max_edge;
};

/// Computes the measures of one tetrahedron. Angles, radius_edge and aspect are those of the unoriented tetrahedron;
/// volume and shape carry the sign. A flat tetrahedron has angles 0 and 180, infinite radius_edge and aspect, shape 0.
/// About 60 ns.
TetQuality tet_quality(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
/// Computes the measures of many cells over the points, equal to the last bit: quality[i] is that of cells[i]. 30 ns
/// each.
void measure_cells(const std::vector<Vec3>& points, std::span<const Tetrahedron> cells, std::span<TetQuality> quality);
/// Computes TetQuality::min_dihedral_deg alone, equal to the last bit. 15 ns each.
void measure_min_dihedrals(const std::vector<Vec3>& points, std::span<const Tetrahedron> cells,
                           std::span<double> degrees);

/// The angles of one triangle; 0 and 180 of one without area.
struct TriangleAngles {
    double min_deg, max_deg;
};
TriangleAngles triangle_angles(const Vec3& a, const Vec3& b, const Vec3& c);

/// The distribution of one measure over many cells. Counts lie in fixed fine bins, so that the sum over parts is exact
/// and independent of order. Percentiles are interpolated in the bins; minimum and maximum are exact.
class Distribution {
 public:
    enum class Scale { linear, logarithmic };
    Distribution() = default;
    static constexpr int bin_count = 1440;
    /// The bins cover [low, high], low < high; values beyond are counted in the first or last bin. 0 < low for a
    /// logarithmic scale.
    Distribution(Scale scale, double low, double high);

    void add(double value, std::int64_t times = 1);  ///< value must not be NaN; about 4 ns
    void add(const Distribution& other);             ///< requires the same scale and range, else throws Error(internal)

    Scale scale() const { return scale_; }
    bool has_range_of(const Distribution& other) const;
    std::int64_t count() const { return count_; }
    double min() const { return count_ ? min_ : 0; }
    double max() const { return count_ ? max_ : 0; }
    /// Returns the value below which the given fraction in [0, 1] of the cells lies: min() at 0, max() at 1, between
    /// them exact to the width of a bin. 0 for an empty distribution.
    double percentile(double fraction) const;

    struct Histogram {
        std::vector<double> edges;         ///< n + 1 values, ascending
        std::vector<std::int64_t> counts;  ///< n counts between them
    };
    /// Returns the counts gathered into `bins` equal (linear) or equal-ratio (logarithmic) intervals; `bins` must
    /// divide 1440, else throws Error(internal).
    Histogram histogram(int bins) const;
    /// Returns the histogram of a range: `groups` intervals of `group` bins each, from the bin `first` on. All must be
    /// bins.
    Histogram histogram(int first, int group, int groups) const;
    /// Returns the bin that counts this value, which must not be NaN.
    int bin_of(double value) const;

    template <class Archive>
    void archive(Archive& a) {
        a(scale_, low_, high_, log2_low_, bins_per_unit_, count_, min_, max_, bins_);
    }

 private:
    double position(double value) const;
    int logarithmic_bin(double value) const;
    double value_at(double position) const;

    Scale scale_ = Scale::linear;
    double low_ = 0, high_ = 1;
    double log2_low_ = 0;               // log2 of low_, of a logarithmic scale
    double bins_per_unit_ = bin_count;  // the unit is that of the measure, or a factor of two on a logarithmic scale
    std::int64_t count_ = 0;
    double min_ = std::numeric_limits<double>::infinity(), max_ = -min_;
    std::vector<std::int64_t> bins_;
};

/// The quantity that a distribution counts.
struct Measure {
    const char* name;   ///< name in reports
    const char* title;  ///< name for people
    const char* unit;   ///< unit; empty: a pure number
    bool small_is_bad;  ///< whether small values are bad; else large ones are
};

/// The measures of TetQuality, in the order of QualityDistributions::measures.
inline constexpr std::array<Measure, 8> quality_measures = {
    {{"min_dihedral_deg", "smallest dihedral angle", "deg", true},
     {"max_dihedral_deg", "largest dihedral angle", "deg", false},
     {"radius_edge", "radius-edge ratio", "", false},
     {"aspect", "aspect ratio", "", false},
     {"shape", "shape", "", true},
     {"volume", "volume", "length^3", true},
     {"min_edge", "shortest edge", "length", true},
     {"max_edge", "longest edge", "length", false}}};
struct QualityDistributions {
    std::vector<Distribution> measures;

    QualityDistributions() = default;
    /// `length_scale` > 0: bounding-box diagonal of the whole input, to which the bins of volume and edges are
    /// relative.
    explicit QualityDistributions(double length_scale);
    void add(const TetQuality& quality);
    void add(const QualityDistributions& other);

    template <class Archive>
    void archive(Archive& a) {
        a(measures);
    }
};

/// The measures of TriangleAngles, in the order of TriangleDistributions::measures.
inline constexpr std::array<Measure, 2> triangle_measures = {
    {{"min_angle_deg", "smallest angle of boundary triangles", "deg", true},
     {"max_angle_deg", "largest angle of boundary triangles", "deg", false}}};
struct TriangleDistributions {
    std::vector<Distribution> measures;

    TriangleDistributions();
    void add(const TriangleAngles& angles);
    void add(const TriangleDistributions& other);
};

/// The measures of ForcedDistributions: TetQuality::min_dihedral_deg of cells that the surface forces to be sharp
/// (fill/mesh/inside/forced_cells.h), and of the others.
inline constexpr Measure forced_measure = {"forced_dihedral_deg", "smallest dihedral angle forced", "deg", true},
                         unforced_measure = {"unforced_dihedral_deg", "smallest dihedral angle not forced", "deg",
                                             true};
struct ForcedDistributions {
    Distribution forced, unforced;

    ForcedDistributions();
    void add(const ForcedDistributions& other);

    template <class Archive>
    void archive(Archive& a) {
        a(forced, unforced);
    }
};

/// The three distributions of the report: all cells, cells with a vertex on an interface, the others. Beside them, the
/// small angles, split into those that the surface forces and those that it does not.
struct PartQuality {
    QualityDistributions all, interface, interior;
    ForcedDistributions angles;

    PartQuality() = default;
    explicit PartQuality(double length_scale) : all(length_scale), interface(length_scale), interior(length_scale) {}
    void add(const PartQuality& other);

    template <class Archive>
    void archive(Archive& a) {
        a(all, interface, interior, angles);
    }
};

/// Computes the distributions of a mesh. Without boundary triangles it has no interface, and no cell is forced. About
/// 75 ns a cell, beside the time that ForcedCells takes for bad cells at the boundary.
PartQuality measure_quality(const TetMesh& mesh, const BoundaryTriangles& boundary, double length_scale);

}  // namespace kerf

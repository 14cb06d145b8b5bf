// The options of sizes, and the field that follows from them.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/core/ids.h"
#include "base/core/user_number.h"
#include "surface/complex/surface.h"
#include "surface/size/size_field.h"

namespace kerf {

/// The ranges of the options.
namespace size_range {
inline constexpr NumberRange length = {"a positive length in units of the input, or with % of its diagonal", 0};
inline constexpr NumberRange max_volume = {"a positive volume, or 0 for no bound", 0};
inline constexpr NumberRange cells = {"a number of tetrahedra such as 50000, 50k or 1M, at most 1e12, or 0 for none", 1,
                                      1e12, true};
inline constexpr NumberRange growth = {"0.01 to 10, or 0 for the usual one", 0.01, 10, true};
inline constexpr NumberRange segments_per_turn = {"3 to 10000, or 0 for none", 3, 1e4, true};
inline constexpr NumberRange cells_across = {"0.1 to 10000, or 0 for none", 0.1, 1e4, true};
}  // namespace size_range

/// The size of facets and cells where no size is given.
enum class Fineness { coarse, medium, fine };

/// The meaning of lengths in options: the mean edge, or a bound of edges, which all but one in a hundred obey.
enum class SizeMeaning { mean, bound };

/// Lengths are in units of the input or, before resolve_lengths(), in percent of its diagonal; 0, or an empty text,
/// means "not given". H and D in texts are such lengths.
struct SizeOptions {
    Length size;                           ///< wanted edge length everywhere
    double max_volume = 0;                 ///< largest volume of a tetrahedron everywhere, instead of `size`
    std::int64_t cells = 0;                ///< number of tetrahedra of the whole mesh, from which `size` follows
                                           ///< (run/prepare/cells.h)
    Fineness fineness = Fineness::medium;  ///< ignored if one of the former three is given
    SizeMeaning meaning = SizeMeaning::mean;
    std::vector<std::string> inside;     ///< box:x0,y0,z0,x1,y1,z1=H, sphere:x,y,z,r=H, cylinder:x0,y0,z0,x1,y1,z1,r=H
    std::vector<std::string> on;         ///< NAME=H: on a patch
    std::vector<std::string> near;       ///< NAME=H:D: up to the distance D from a patch
    std::vector<std::string> in_region;  ///< NAME=H: in regions, in place of `size`; '*' stands for any characters
    double growth = 0;  ///< increase of sizes per distance; if given, the surface's edges ask for their lengths, too
    std::string field_file;  ///< a mesh of tetrahedra with a size at every node
    Length chord_error;      ///< see CurvatureSizes
    double segments_per_turn = 0;
    double cells_across = 0;                           ///< see sizes_of_thickness()
    std::shared_ptr<const SizedMesh> background = {};  ///< in place of a field_file, for programs; no option sets it

    /// The share of a bound that mean edges have. 99.9 % of the edges of cells are shorter than 1.52 to 1.66 times the
    /// mean, measured on assets and surfaces of others with several sizes; up to 0.7 % are longer where facets that are
    /// coarse are divided. The inverse is a border of bins of RatioCounts.
    static constexpr double mean_below_bound = 0.62723;
    /// The growth if none is given.
    static constexpr double usual_growth = 0.3;

    /// Throws Error(usage) naming option, value and range or form.
    void check() const;
    /// Replaces percentages by lengths, and sets `max_volume` where it follows from `size`. Throws Error(usage) as
    /// check(), and for a chord error longer than the diagonal, which no chord has.
    void resolve_lengths(double diagonal);
    /// Returns the mean edge of cells over the length that is given for them: 1, or the share with which all but one
    /// edge in a hundred are shorter than the length.
    double mean_over_size() const { return meaning == SizeMeaning::mean ? 1 : mean_below_bound; }
    /// Returns `max_volume`, or the volume that follows from `size`, a resolved length; 0: none.
    double constant_max_volume() const;
    /// Returns the options with this edge length everywhere in place of `size`, `cells` and `fineness`; 0: none.
    SizeOptions with_edge(double edge) const;
    /// Returns the growth for cells beside facets that are kept. Where nobody gives a size, and the fineness is fine,
    /// they grow from the edges of the surface by usual_growth, if no growth is given.
    double growth_beside_kept_facets() const;
    /// Returns the largest volume of a tetrahedron in each of these regions, from `in_region` with resolved lengths,
    /// the smallest of several, 0 for regions that it does not name; empty if `in_region` is. Throws Error(usage) for a
    /// name that is none of the regions', or that comes twice.
    Array<RegionIndex, double> max_volumes_of_regions(std::span<const std::string> regions) const;
    /// Whether any option but a constant is given, so that the field follows from the surface and files.
    bool depends_on_place() const {
        return !inside.empty() || !on.empty() || !near.empty() || growth > 0 || !field_file.empty() || background ||
               chord_error.number() > 0 || segments_per_turn > 0 || cells_across > 0;
    }
    /// Whether no size is given that would hold everywhere, so that `fineness` decides.
    bool follow_fineness() const { return size.number() == 0 && max_volume == 0 && cells == 0; }
    bool is_coarse() const { return follow_fineness() && fineness == Fineness::coarse; }
    double growth_or_usual() const { return growth > 0 ? growth : usual_growth; }
};

/// Returns the field that the options ask for over a surface: the minimum of all sources, each growing with the
/// distance. The options must pass check() and have resolved lengths. Sizes that follow from curvature and thickness
/// are at least 1e-4 of the diagonal. `background` is the content of `field_file`, or SizeOptions::background. Throws
/// Error(usage) for a patch that the surface does not have, naming those that it has. Deterministic. O(#F log #F).
SizeField make_size_field(const SizeOptions& options, const SurfaceArrays& surface,
                          const std::vector<std::string>& patch_names, std::optional<SizedMesh> background = {});

}  // namespace kerf

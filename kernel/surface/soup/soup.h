// The content of a surface file, with nothing repaired.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/core/types.h"
#include "surface/soup/facet_sides.h"

namespace kerf {

/// An edge of the facets that lies on a curve of the CAD model behind them: a border of patches, or a crease.
struct ModelEdge {
    UndirectedEdge vertices;
    std::int32_t sharp;  ///< 1; or 0 if the faces of the model are tangent there, so that the edge only divides patches
};

/// A point in a region, with the name of the region, from a file or from the user.
struct RegionSeed {
    std::string name;
    Vec3 point;               ///< units of the file
    double largest_cell = 0;  ///< largest volume of a cell of the region; 0: no bound

    template <class Archive>
    void archive(Archive& a) {
        a(name, point, largest_cell);
    }
};

/// Triangles with shared vertices and a patch per triangle. No promise about closedness, orientation or manifoldness.
struct Soup {
    std::vector<Vec3> vertices;            ///< #V; units of the file
    std::vector<Triangle> facets;          ///< #F; indices into `vertices`
    std::vector<std::int32_t> patch;       ///< #F; index into `patch_names`
    std::vector<std::string> patch_names;  ///< never empty once a reader has returned
    /// #F; number of the face of the file, counted from 0, that the facet was cut from. Empty if every face is a
    /// triangle, so that facets and faces have the same numbers.
    std::vector<std::int32_t> polygon = {};
    /// Faces of the file, ascending, that their facets do not represent: the face is not planar, or no fan covers it.
    std::vector<std::int32_t> unfit_polygons = {};
    /// #V; number of the vertex in the file, counted from 0. Empty if the numbers agree.
    std::vector<std::int32_t> vertex_number = {};
    std::vector<Vec3> holes = {};         ///< points in voids that the file names; units of the file
    std::vector<std::string> notes = {};  ///< things that the reader passed over: "12 tetrahedra were ignored."
    bool is_of_model = false;  ///< the facets stand for curved faces: a CAD file, whose triangles nobody chose
    /// Edges of the model, each once; the same vertices as the facets. Empty if the file has no model.
    std::vector<ModelEdge> model_edges = {};
    /// #patches; sRGB and 255, or four zeros if the file gives the patch no colour. Empty if it gives no colours at
    /// all.
    std::vector<std::array<std::uint8_t, 4>> patch_colours = {};
    /// #F, and then each facet occurs once; the regions on its sides, as indices into `region_names`. Empty if the
    /// facets bound one body, or if the regions are yet to be found.
    std::vector<FacetSides> sides = {};
    std::vector<std::string> region_names = {};  ///< empty if `sides` is empty
    std::vector<RegionSeed> seeds = {};          ///< points that tell which cells of the facets are regions
    /// Whether facets may end within a region, as those of .poly and .smesh may; otherwise such a wall has a hole.
    bool may_end_inside = false;

    template <class Archive>
    void archive(Archive& a) {
        a(vertices, facets, patch, patch_names, polygon, unfit_polygons, vertex_number, holes, notes, is_of_model,
          model_edges, patch_colours, sides, region_names, seeds, may_end_inside);
    }

    /// Returns the numbers that the file gives to facets or vertices; successive facets of one face count once.
    std::vector<std::int32_t> file_facets(const std::vector<std::int32_t>& own) const;
    std::vector<std::int32_t> file_vertices(const std::vector<std::int32_t>& own) const;
};

/// Merges vertices with exactly equal coordinates (-0 equals 0). The first of equals stays, the order is kept.
/// NaN equals nothing. Returns the number of vertices removed. O(#V), deterministic.
std::int64_t weld_exactly(Soup& soup);

/// Merges vertices that lie within `tolerance` > 0 of the first of their group, in the order of the vertices; facets
/// may become degenerate. Changes the geometry. Returns the number of vertices removed. Expected O(#V), deterministic.
std::int64_t weld_within(Soup& soup, double tolerance);

/// Appends facets, vertices and patches, and all else that a soup has; numbers in the file go on behind the last of
/// `all`. Requires soups without sides. O(#V + #F).
void append(Soup& all, const Soup& more);

/// Multiplies all coordinates.
void scale(Soup& soup, double factor);

/// Removes facets; the others keep their order and their numbers in the file. `drop`: #F.
void drop_facets(Soup& soup, const std::vector<char>& drop);

/// Removes vertices that no facet uses; the order of the others is kept. Returns the number removed. O(#V + #F).
std::int64_t drop_unused_vertices(Soup& soup);

}  // namespace kerf

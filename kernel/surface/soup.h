// What a surface file said, with nothing repaired.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/types.h"
#include "surface/facet_sides.h"

namespace kerf {

/// An edge of the facets on a curve of the model behind them, as CAD files have: a bound of patches, or a crease.
struct ModelEdge {
    UndirectedEdge vertices;
    std::int32_t sharp;  ///< 0: the faces of the model are tangent there, so that only patches end; else 1
};

/// A point of a region that a file, or its user, names.
struct RegionSeed {
    std::string name;
    Vec3 point;               ///< units of the file
    double largest_cell = 0;  ///< volume that its cells may have at most; 0: no bound

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
    /// Faces of the file, ascending, whose facets are not the face: it is not planar, or no fan covers it.
    std::vector<std::int32_t> unfit_polygons = {};
    /// #V; number of the vertex in the file, counted from 0. Empty if the numbers agree.
    std::vector<std::int32_t> vertex_number = {};
    std::vector<Vec3> holes = {};         ///< points in voids that the file names; units of the file
    std::vector<std::string> notes = {};  ///< what the reader passed over: "12 tetrahedra were ignored."
    bool is_of_model = false;  ///< the facets stand for curved faces: a CAD file, whose triangles nobody chose
    /// Edges of the model, each once; the same vertices as the facets. Empty if the file has no model.
    std::vector<ModelEdge> model_edges = {};
    /// sRGB and 255 for each patch; four zeros where the file gives no colour. Empty if it gives none at all.
    std::vector<std::array<std::uint8_t, 4>> patch_colours = {};
    /// #F, each facet once: what lies on its sides, by numbers of `region_names`. Empty: the facets bound one body, or
    /// what they bound is yet to be found.
    std::vector<FacetSides> sides = {};
    std::vector<std::string> region_names = {};  ///< of the numbers in `sides`; empty if these are
    std::vector<RegionSeed> seeds = {};          ///< which cells of the facets are regions, where the file tells that
    /// Facets may end within a region, as those of .poly and .smesh may; else a wall that does so has a hole.
    bool may_end_inside = false;

    template <class Archive>
    void archive(Archive& a) {
        a(vertices, facets, patch, patch_names, polygon, unfit_polygons, vertex_number, holes, notes, is_of_model,
          model_edges, patch_colours, sides, region_names, seeds, may_end_inside);
    }

    /// The numbers that the file gives to facets and vertices; facets of one face that follow each other count once.
    std::vector<std::int32_t> file_facets(const std::vector<std::int32_t>& own) const;
    std::vector<std::int32_t> file_vertices(const std::vector<std::int32_t>& own) const;
};

/// Merges vertices with exactly equal coordinates (-0 equals 0). The first of equals stays, the order is kept.
/// NaN equals nothing. Returns the number of vertices removed. O(#V), deterministic.
std::int64_t weld_exactly(Soup& soup);

/// Merges vertices that lie within `tolerance` > 0 of the first of their group, in the order of the vertices; facets
/// may become degenerate. Changes the geometry. Returns the number of vertices removed. Expected O(#V), deterministic.
std::int64_t weld_within(Soup& soup, double tolerance);

/// Multiplies all coordinates.
void scale(Soup& soup, double factor);

/// Removes facets; the others keep their order and their numbers in the file. `drop`: #F.
void drop_facets(Soup& soup, const std::vector<char>& drop);

/// Removes vertices that no facet uses; the order of the others is kept. Returns the number removed. O(#V + #F).
std::int64_t drop_unused_vertices(Soup& soup);

}  // namespace kerf

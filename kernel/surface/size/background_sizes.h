// Sizes at the vertices of a background mesh of tetrahedra.
#pragma once

#include <memory>
#include <vector>

#include "base/geometry/box_tree.h"
#include "surface/size/inside/sized_triangles.h"

namespace kerf {

/// The content of a size file: a size at each vertex of tetrahedra.
struct SizedMesh {
    std::vector<Vec3> vertices;
    std::vector<Tetrahedron> tets;  ///< of any orientation, conforming or not
    std::vector<double> size;       ///< #V, > 0
};

/// The size field of such a mesh: linear in its cells, and growing away from them outside. Where cells overlap, the
/// smaller size counts. Cells without volume do not count.
class BackgroundSizes {
 public:
    BackgroundSizes() = default;
    /// Takes a mesh and first lowers sizes that grow faster than `growth` from one vertex to another. Inside of a cell
    /// the slope may still be steeper than `growth`, by a factor of up to the square root of 3 in a right-angled
    /// corner. O(n log n).
    BackgroundSizes(SizedMesh mesh, double growth);

    double smallest() const { return border_.smallest(); }
    /// Returns the lesser of the field at p and `bound`. O(log n).
    double size_at(const Vec3& p, double growth, double bound) const;

    template <class Archive>
    void archive(Archive& a) {
        a(mesh_.vertices, mesh_.tets, mesh_.size);
        if constexpr (std::is_same_v<Archive, ByteReader>) index();
    }

 private:
    void index();

    SizedMesh mesh_;
    std::shared_ptr<const BoxTree> cells_;  // of the boxes of mesh_.tets
    SizedTriangles border_;                 // of the faces that belong to one cell only
};

}  // namespace kerf

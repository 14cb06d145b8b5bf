// All facets of a decomposition, each once, so that a straight cut can split the facets of its neighbours, too.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "base/core/check.h"
#include "cut/cut/straight.h"
#include "cut/decompose/decomposition.h"

namespace kerf {

/// A facet and the parts that it bounds.
struct ComplexFace {
    Triangle corners;                  ///< counter-clockwise seen from outside of owner[0]
    std::array<NodeId, 2> owner = {};  ///< the parts on its sides; owner[1] is no_node for facets of the input
    Key key = 0;                       ///< as in SurfaceArrays
    std::int32_t patch = -1;
    NodeId cap = no_node;  ///< the straight cut in whose plane it lies, with owner[0] below, or no_node
    bool divided = false;  ///< it is a piece of a split facet
    std::array<char, 2> untested = {0, 0};  ///< per owner: it may intersect other faces of the owner

    bool bounds(NodeId part) const { return owner[0] == part || owner[1] == part; }
};

/// The faces of a decomposition. Vertices and faces keep their numbers when parts are divided; new ones follow.
class FaceComplex {
 public:
    /// Joins the closed surfaces of all parts by the keys of vertices and facets, which joins copies of a vertex, too.
    /// O(n log n).
    explicit FaceComplex(const std::vector<Leaf>& leaves);

    /// The closed surface of one part, with the numbers of its vertices and facets in the complex. Where it touches
    /// itself it is taken apart as by separate_touching(), so that several of its vertices have the same number there.
    struct Part {
        SurfaceArrays arrays;
        Array<Vertex, std::int32_t> vertex;
        Array<Facet, std::int32_t> face;
        Array<Facet, char> untested;  ///< per facet, as ComplexFace::untested
    };
    /// Returns the surface of part `id`, which must exist. One call at a time. O(n) for n faces of the part, if no part
    /// touches itself.
    Part part(NodeId id) const;

    /// Replaces part `id` by its two children. `whole` is the result of part(id), `cut` a straight cut of its surface.
    /// Pieces of a split facet have the owners of the facet; faces of other parts with a crossed edge are split, too.
    /// O(n log n) for n faces of the part and at the crossed edges.
    void divide(NodeId id, const Part& whole, const StraightCut& cut);

    const Vec3& point(std::int32_t vertex) const {
        KERF_CHECK(vertex >= 0 && vertex < vertex_count());
        return points_[vertex];
    }
    std::int32_t vertex_count() const { return count_of(points_); }
    const std::vector<ComplexFace>& faces() const { return faces_; }
    /// Returns the plane of a straight cut that was made.
    const Plane& plane(NodeId cut) const;
    const std::vector<DividedFacet>& divided_facets() const { return divided_facets_; }

    /// Adds a vertex made by a straight cut and returns its number.
    std::int32_t add_point(const Vec3& point, NodeId cut);
    /// Replaces all faces that lie in the planes of straight cuts. O(#faces).
    void replace_caps(const std::vector<ComplexFace>& caps);

    /// Gives the caps and the vertices of straight cuts dense keys in the order of their numbers; vertices without
    /// faces get none. Returns the number of vertices that each straight cut made, ascending by cut.
    std::vector<std::pair<NodeId, std::int32_t>> assign_keys();
    /// Returns the vertices and edges at which parts touch without a common face, by the keys of assign_keys().
    /// O(#faces).
    Contacts find_contacts() const;

 private:
    void index_faces();
    void list_face(std::int32_t face);
    void add_face(const ComplexFace& face);
    void replace_face(std::int32_t at, const ComplexFace& face);
    std::vector<std::int32_t> faces_at(std::vector<std::int32_t> vertices) const;
    void split_others(NodeId id, std::vector<SplitEdge> edges);
    void note_division(const ComplexFace& face);

    std::vector<Vec3> points_;
    std::vector<Key> vertex_key_;
    std::vector<char> is_new_;  // per vertex: made by a straight cut
    std::vector<ComplexFace> faces_;
    std::map<NodeId, std::vector<std::int32_t>> faces_of_;  // per part, ascending
    struct AtVertex {
        std::int32_t face;
        std::int32_t earlier;  // of the same vertex in at_vertex_, or -1
    };
    std::vector<AtVertex> at_vertex_;  // also faces that were at a vertex before they were split
    std::vector<std::int32_t> last_at_vertex_;
    mutable std::vector<std::int32_t> number_in_part_;  // per vertex, while a part is read; -1 otherwise
    std::vector<std::pair<NodeId, Plane>> planes_;      // in the order of the cuts
    std::vector<DividedFacet> divided_facets_;
    bool touches_ = false;  // whether a part touches itself; cuts do not make others do so
};

}  // namespace kerf

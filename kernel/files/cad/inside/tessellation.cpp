// BRepMesh cuts every edge of the model once and then fills each face by itself, with nodes of its own. Node k of an
// edge in one face is node k of the same edge in the other: that joins the faces, where comparing coordinates would
// leave cracks of 1e-14. An edge that a face has on both sides (the seam of a cylinder) is visited twice by the
// explorer, forward and reversed, and has a list of nodes for each side. All nodes of a degenerate edge (the tip of a
// cone) are its vertex.
//
// Triangles with a repeated vertex are left out then, and so are pairs of opposite triangles on the same vertices, into
// which slivers of faces collapse; between regions one of such a pair stays, if it still separates two.
#include "files/cad/inside/tessellation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

#include <BRepAdaptor_Surface.hxx>
#include <BRepLib.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Eigen/Geometry>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <gp_Pln.hxx>
#include <gp_Trsf.hxx>
#include <gp_Vec.hxx>
#include <gp_XY.hxx>

#include "base/core/drop_items.h"
#include "base/core/ids.h"
#include "base/geometry/triangle.h"

namespace kerf::cad {

namespace {

constexpr double smooth_angle = 0.0175;  // radians, a degree

Vec3 to_vec3(const gp_Pnt& p) { return {p.X(), p.Y(), p.Z()}; }
Vec3 to_vec3(const gp_Vec& p) { return {p.X(), p.Y(), p.Z()}; }

TopoDS_Edge forward(const TopoDS_Edge& edge) { return TopoDS::Edge(edge.Oriented(TopAbs_FORWARD)); }

// The surface of a face, for the heights over its facets.
class FaceHeights {
 public:
    FaceHeights(const TopoDS_Face& face, const Handle(Poly_Triangulation) & triangles)
        : surface_(face), triangles_(triangles) {}

    /// Normal of a planar face, else 0.
    Vec3 plane() const {
        if (surface_.GetType() != GeomAbs_Plane) return Vec3::Zero();
        return to_vec3(gp_Vec(surface_.Plane().Axis().Direction()));
    }

    /// Mean height of the face over a triangle of these nodes, at these corners. The mean over the middles of its edges
    /// is that of the triangle where the face is of second order.
    double mean_over(const std::array<int, 3>& nodes, const std::array<Vec3, 3>& corners) const {
        if (surface_.GetType() == GeomAbs_Plane || !triangles_->HasUVNodes()) return 0;
        const Vec3 cross = doubled_area_vector(corners);
        double longest = 0, sum = 0;
        for (std::size_t i = 0; i < 3; ++i) longest = std::max(longest, (corners[(i + 1) % 3] - corners[i]).norm());
        if (!(cross.norm() > least_height * longest * longest)) return 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3;
            const gp_XY middle = (triangles_->UVNode(nodes[i]).XY() + triangles_->UVNode(nodes[j]).XY()) / 2;
            sum += height_at(middle, (corners[i] + corners[j]) / 2, cross.normalized());
        }
        return std::abs(sum / 3) < longest ? sum / 3 : 0;
    }

 private:
    static constexpr double least_height = 1e-6;  // of a facet over its longest edge, below which its normal is noise

    // Returns the height of the face over the point p of a facet. The face at `uv` is over p but for the stretch of the
    // parameters, which a step of Newton's corrects.
    double height_at(const gp_XY& uv, const Vec3& p, const Vec3& normal) const {
        gp_Pnt point;
        gp_Vec along_u, along_v;
        surface_.D1(uv.X(), uv.Y(), point, along_u, along_v);
        const Vec3 u = to_vec3(along_u), v = to_vec3(along_v), off = p - to_vec3(point);
        const double turned = u.cross(v).dot(normal);
        const double height = -off.dot(normal);
        if (!(std::abs(turned) > least_height * u.norm() * v.norm())) return height;
        // du u + dv v + h normal = off
        const double du = off.cross(v).dot(normal) / turned, dv = u.cross(off).dot(normal) / turned;
        surface_.D0(uv.X() + du, uv.Y() + dv, point);
        return (to_vec3(point) - p).dot(normal);
    }

    BRepAdaptor_Surface surface_;
    Handle(Poly_Triangulation) triangles_;
};

class Welder {
 public:
    Welder(const Body& body, const std::vector<FacetSides>& sides) : body_(body), sides_(sides) {
        TopExp::MapShapes(body.shape, TopAbs_VERTEX, corners_);
        TopExp::MapShapesAndUniqueAncestors(body.shape, TopAbs_EDGE, TopAbs_FACE, faces_of_edge_);
        nodes_of_edge_.resize(faces_of_edge_.Extent() + 1);
        for (int i = 1; i <= corners_.Extent(); ++i)
            result_.vertices.push_back(to_vec3(BRep_Tool::Pnt(TopoDS::Vertex(corners_(i)))));
    }

    Tessellation run() {
        for (TopExp_Explorer faces(body_.shape, TopAbs_FACE); faces.More(); faces.Next()) {
            const TopoDS_Face face = TopoDS::Face(faces.Current());
            if (face.Orientation() == TopAbs_FORWARD || face.Orientation() == TopAbs_REVERSED) add_face(face);
        }
        if (!sides_.empty())
            for (const std::int32_t patch : result_.patch) result_.sides.push_back(sides_[patch]);
        leave_out_collapsed();
        leave_out_twins();
        add_edges();
        return std::move(result_);
    }

 private:
    void add_face(const TopoDS_Face& face) {
        const std::int32_t patch = body_.patch_of.Find(face);
        TopLoc_Location place;
        const Handle(Poly_Triangulation) triangles = BRep_Tool::Triangulation(face, place);
        if (triangles.IsNull() || triangles->NbTriangles() == 0) {
            result_.failed_faces.push_back(patch);
            return;
        }
        const gp_Trsf& trsf = place.Transformation();
        const auto point = [&](int node) { return to_vec3(triangles->Node(node).Transformed(trsf)); };
        number_.assign(triangles->NbNodes() + 1, -1);
        for (TopExp_Explorer edges(face.Oriented(TopAbs_FORWARD), TopAbs_EDGE); edges.More(); edges.Next())
            number_edge(TopoDS::Edge(edges.Current()), triangles, place, point);
        if (!sides_.empty()) number_inner_vertices(face, *triangles, point);
        for (int node = 1; node <= triangles->NbNodes(); ++node)
            if (number_[node] < 0) number_[node] = add_vertex(point(node));
        const bool is_turned = (face.Orientation() == TopAbs_REVERSED) != trsf.IsNegative();
        const FaceHeights heights(face, triangles);
        const Vec3 plane = heights.plane();
        for (int i = 1; i <= triangles->NbTriangles(); ++i) {
            int a = 0, b = 0, c = 0;
            triangles->Triangle(i).Get(a, b, c);
            if (is_turned) std::swap(b, c);
            result_.facets.push_back({number_[a], number_[b], number_[c]});
            result_.patch.push_back(patch);
            result_.plane.push_back(plane);
            result_.rise.push_back(heights.mean_over({a, b, c}, {point(a), point(b), point(c)}));
        }
    }

    // Gives the node at the place of a vertex of another body that lies in the face the number of that vertex.
    template <class Point>
    void number_inner_vertices(const TopoDS_Face& face, const Poly_Triangulation& triangles, const Point& point) {
        for (TopExp_Explorer inner(face, TopAbs_VERTEX, TopAbs_EDGE); inner.More(); inner.Next()) {
            const TopoDS_Vertex vertex = TopoDS::Vertex(inner.Current());
            const Vec3 place = to_vec3(BRep_Tool::Pnt(vertex));
            int nearest = 0;
            double least = BRep_Tool::Tolerance(vertex);
            for (int node = 1; node <= triangles.NbNodes(); ++node) {
                if (number_[node] >= 0) continue;
                const double distance = (point(node) - place).norm();
                if (distance > least) continue;
                nearest = node;
                least = distance;
            }
            if (nearest > 0)
                number_[nearest] = corner(vertex);
            else
                result_.pierced_patches.push_back(body_.patch_of.Find(face));
        }
    }

    template <class Point>
    void number_edge(const TopoDS_Edge& edge, const Handle(Poly_Triangulation) & triangles,
                     const TopLoc_Location& place, const Point& point) {
        const Handle(Poly_PolygonOnTriangulation) polygon = BRep_Tool::PolygonOnTriangulation(edge, triangles, place);
        if (polygon.IsNull()) return;
        const int n = polygon->NbNodes();
        const TopoDS_Vertex first = TopExp::FirstVertex(forward(edge)), last = TopExp::LastVertex(forward(edge));
        const bool is_point = BRep_Tool::Degenerated(edge);
        std::vector<std::int32_t>& shared = nodes_of_edge_[faces_of_edge_.FindIndex(edge)];
        if (shared.empty() && !is_point)
            for (int k = 1; k <= n; ++k)
                shared.push_back(k == 1 && !first.IsNull()  ? corner(first)
                                 : k == n && !last.IsNull() ? corner(last)
                                                            : add_vertex(point(polygon->Node(k))));
        for (int k = 1; k <= n; ++k)
            if (is_point)
                number_[polygon->Node(k)] = corner(first);
            else if (k <= std::ssize(shared))
                number_[polygon->Node(k)] = shared[k - 1];
    }

    std::int32_t corner(const TopoDS_Vertex& vertex) const { return corners_.FindIndex(vertex) - 1; }

    std::int32_t add_vertex(const Vec3& p) {
        result_.vertices.push_back(p);
        return count_of(result_.vertices) - 1;
    }

    void keep_facets(const std::vector<char>& drop) {
        drop_items(result_.facets, drop);
        drop_items(result_.patch, drop);
        drop_items(result_.plane, drop);
        drop_items(result_.rise, drop);
        if (!result_.sides.empty()) drop_items(result_.sides, drop);
    }

    void leave_out_collapsed() {
        std::vector<char> drop(result_.facets.size());
        for (std::size_t f = 0; f < drop.size(); ++f) {
            const auto& [a, b, c] = result_.facets[f];
            drop[f] = a == b || b == c || c == a;
        }
        keep_facets(drop);
    }

    void leave_out_twins() {
        struct Sorted {
            Triangle vertices;
            std::int32_t facet;
            bool is_even;  // an even number of swaps sorts the vertices
        };
        std::vector<Sorted> sorted(result_.facets.size());
        for (std::int32_t f = 0; f < count_of(sorted); ++f) {
            Triangle t = result_.facets[f];
            const bool is_even = ((t[0] > t[1]) + (t[0] > t[2]) + (t[1] > t[2])) % 2 == 0;
            std::sort(t.begin(), t.end());
            sorted[f] = {t, f, is_even};
        }
        std::sort(sorted.begin(), sorted.end(), [](const Sorted& a, const Sorted& b) {
            return std::tie(a.vertices, a.facet) < std::tie(b.vertices, b.facet);
        });
        std::vector<char> drop(sorted.size());
        for (std::size_t i = 1; i < sorted.size(); ++i) {
            const Sorted &one = sorted[i - 1], &other = sorted[i];
            if (one.vertices != other.vertices || one.is_even == other.is_even || drop[one.facet]) continue;
            drop[other.facet] = 1;
            drop[one.facet] = result_.sides.empty() || !join(result_.sides[one.facet], result_.sides[other.facet]);
        }
        keep_facets(drop);
    }

    // Gives a facet the region behind its twin, where one region has collapsed between them. Returns false if nothing
    // separates two regions any more.
    static bool join(FacetSides& sides, const FacetSides& twin) {
        if (sides.front == twin.front)
            sides.front = twin.back;
        else
            sides.back = twin.front;
        return sides.front != sides.back;
    }

    // Adds the edges that bound patches, and creases inside of one.
    void add_edges() {
        for (int i = 1; i <= faces_of_edge_.Extent(); ++i) {
            const std::vector<std::int32_t>& nodes = nodes_of_edge_[i];
            const TopTools_ListOfShape& faces = faces_of_edge_(i);
            if (nodes.empty() || faces.IsEmpty()) continue;
            const TopoDS_Edge edge = TopoDS::Edge(faces_of_edge_.FindKey(i));
            const TopoDS_Face a = TopoDS::Face(faces.First()), b = TopoDS::Face(faces.Last());
            const bool is_sharp = faces.Extent() > 2 || BRep_Tool::Continuity(edge, a, b) == GeomAbs_C0;
            if (!is_sharp && body_.patch_of.Find(a) == body_.patch_of.Find(b)) continue;
            for (std::size_t k = 1; k < nodes.size(); ++k)
                if (nodes[k - 1] != nodes[k]) result_.edges.push_back({undirected(nodes[k - 1], nodes[k]), is_sharp});
        }
    }

    const Body& body_;
    const std::vector<FacetSides>& sides_;  // of patches; empty: one body
    Tessellation result_;
    TopTools_IndexedMapOfShape corners_;  // vertex i of the result is corner i + 1
    TopTools_IndexedDataMapOfShapeListOfShape faces_of_edge_;
    std::vector<std::vector<std::int32_t>> nodes_of_edge_;  // vertices of the result along each edge
    std::vector<std::int32_t> number_;                      // of the nodes of a face, counted from 1
};

struct DirectedEdge {
    std::int32_t from, to, facet;
};

std::vector<DirectedEdge> sorted_edges(const std::vector<Triangle>& facets) {
    std::vector<DirectedEdge> edges;
    edges.reserve(3 * facets.size());
    for (std::int32_t f = 0; f < count_of(facets); ++f)
        for (std::size_t i = 0; i < 3; ++i) edges.push_back({facets[f][i], facets[f][(i + 1) % 3], f});
    std::sort(edges.begin(), edges.end(), [](const DirectedEdge& a, const DirectedEdge& b) {
        return std::tie(a.from, a.to, a.facet) < std::tie(b.from, b.to, b.facet);
    });
    return edges;
}

std::ptrdiff_t count(const std::vector<DirectedEdge>& edges, std::int32_t from, std::int32_t to) {
    const auto [first, last] = std::equal_range(
        edges.begin(), edges.end(), DirectedEdge{from, to, 0},
        [](const DirectedEdge& a, const DirectedEdge& b) { return std::tie(a.from, a.to) < std::tie(b.from, b.to); });
    return last - first;
}

std::vector<std::int32_t> find_open_patches(const Tessellation& mesh, const std::vector<DirectedEdge>& edges) {
    std::vector<std::int32_t> patches;
    for (const DirectedEdge& e : edges)
        if (count(edges, e.from, e.to) != 1 || count(edges, e.to, e.from) != 1) patches.push_back(mesh.patch[e.facet]);
    std::sort(patches.begin(), patches.end());
    patches.erase(std::unique(patches.begin(), patches.end()), patches.end());
    return patches;
}

}  // namespace

Tessellation tessellate(const Body& body, const TessellationSettings& settings, const std::vector<FacetSides>& sides) {
    BRepTools::Clean(body.shape);
    IMeshTools_Parameters parameters;
    parameters.Deflection = settings.deflection;
    parameters.Angle = settings.angle;
    const BRepMesh_IncrementalMesh mesher(body.shape, parameters);
    Tessellation mesh = Welder(body, sides).run();
    const std::vector<DirectedEdge> edges = sorted_edges(mesh.facets);
    if (sides.empty()) mesh.open_patches = find_open_patches(mesh, edges);
    std::erase_if(mesh.edges, [&](const ModelEdge& e) {
        return count(edges, e.vertices[0], e.vertices[1]) + count(edges, e.vertices[1], e.vertices[0]) == 0;
    });
    if (sides.empty()) mesh.volume = enclosed_volume(mesh);
    return mesh;
}

// Sums up the tetrahedra between the facets and a vertex, so that a body far from the origin loses no digits.
double enclosed_volume(const Tessellation& mesh) {
    if (mesh.vertices.empty()) return 0;
    const Vec3& apex = mesh.vertices.front();
    return std::accumulate(mesh.facets.begin(), mesh.facets.end(), 0.0, [&](double sum, const Triangle& t) {
        const Vec3 a = mesh.vertices[t[0]] - apex, b = mesh.vertices[t[1]] - apex, c = mesh.vertices[t[2]] - apex;
        return sum + a.dot(b.cross(c)) / 6;
    });
}

std::int32_t most_facets_of_patch(const Tessellation& mesh) {
    std::vector<std::int32_t> counts(std::ranges::max(mesh.patch) + 1);
    for (const std::int32_t patch : mesh.patch) ++counts[patch];
    return std::ranges::max(counts);
}

void find_smooth_edges(const Body& body) { BRepLib::EncodeRegularity(body.shape, smooth_angle); }

}  // namespace kerf::cad

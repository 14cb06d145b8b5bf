// After the surface of a CAD file has been remeshed, its vertices and the middles of its edges are put back on the
// faces: the file is imported again with the same options, and its facets lead to its faces. A place of points is a set
// of patches, as faces or as the curve between them. For each place a target is made once: the facets of its faces in a
// tree, with the parameters of the face at their corners, or its curves as straight pieces. A point goes to the nearest
// facet of the target; barycentric weights there give the parameters from which the exact nearest point is found
// (nearest_point.h). So the face is chosen by facets, and the point by the face. Curves are edges of the model between
// different patches, and creases inside of one. Middles are projected last, from the middle of the two ends that have
// been moved already.
#include "files/cad/inside/projection.h"

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include <BRep_Tool.hxx>
#include <Poly_Triangulation.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <gp_Trsf.hxx>

#include "base/core/ids.h"
#include "base/geometry/closest_point.h"
#include "files/cad/inside/nearest_point.h"
#include "surface/soup/triangle_tree.h"

namespace kerf::cad {

namespace {

constexpr int pieces_of_curve = 64;  // straight pieces, to find the start on the curve

// Some faces with their facets, in a tree.
class FaceGroup {
 public:
    explicit FaceGroup(const std::vector<TopoDS_Face>& faces) {
        std::vector<Vec3> vertices;
        std::vector<Triangle> facets;
        for (const TopoDS_Face& face : faces) add_face(face, vertices, facets);
        if (!facets.empty()) tree_.emplace(vertices, facets);
    }
    bool empty() const { return !tree_; }

    Vec3 nearest(const Vec3& p) const {
        const TriangleTree::Closest closest = tree_->closest(p);
        const Facet& facet = facets_[closest.facet];
        const auto& [a, b, c] = tree_->corners(closest.facet);
        const Vec3 weights = closest_barycentric(p, a, b, c);
        Vec2 start = Vec2::Zero();
        for (std::size_t i = 0; i < 3; ++i) start += weights[i] * facet.parameters[i];
        return faces_[facet.face].find(p, start.x(), start.y());
    }

 private:
    struct Facet {
        std::int32_t face;
        std::array<Vec2, 3> parameters;
    };

    void add_face(const TopoDS_Face& face, std::vector<Vec3>& vertices, std::vector<Triangle>& facets) {
        TopLoc_Location place;
        const Handle(Poly_Triangulation) triangles = BRep_Tool::Triangulation(face, place);
        if (triangles.IsNull() || !triangles->HasUVNodes()) return;
        const auto first = count_of(vertices);
        for (int node = 1; node <= triangles->NbNodes(); ++node) {
            const gp_Pnt p = triangles->Node(node).Transformed(place.Transformation());
            vertices.emplace_back(p.X(), p.Y(), p.Z());
        }
        for (int i = 1; i <= triangles->NbTriangles(); ++i) {
            std::array<int, 3> nodes = {};
            triangles->Triangle(i).Get(nodes[0], nodes[1], nodes[2]);
            Facet facet{count_of(faces_), {}};
            Triangle corners;
            for (std::size_t k = 0; k < 3; ++k) {
                corners[k] = first + nodes[k] - 1;
                facet.parameters[k] = {triangles->UVNode(nodes[k]).X(), triangles->UVNode(nodes[k]).Y()};
            }
            const Vec3 &a = vertices[corners[0]], &b = vertices[corners[1]], &c = vertices[corners[2]];
            if (a == b || b == c || c == a) continue;  // at a pole
            facets.push_back(corners);
            facets_.push_back(facet);
        }
        faces_.emplace_back(face);
    }

    std::vector<NearestOnFace> faces_;
    std::vector<Facet> facets_;
    std::optional<TriangleTree> tree_;
};

// Some curves, cut into straight pieces.
class CurveGroup {
 public:
    explicit CurveGroup(const std::vector<TopoDS_Edge>& edges) {
        for (const TopoDS_Edge& edge : edges) {
            Curve& curve = curves_.emplace_back(Curve{NearestOnEdge(edge), {}, {}, {}});
            for (int i = 0; i <= pieces_of_curve; ++i) {
                const double share = static_cast<double>(i) / pieces_of_curve;
                curve.parameters.push_back((1 - share) * curve.edge.first() + share * curve.edge.last());
                curve.points.push_back(curve.edge.at(curve.parameters.back()));
                curve.box.extend(curve.points.back());
            }
        }
    }
    bool empty() const { return curves_.empty(); }

    Vec3 nearest(const Vec3& p) const {
        double least = std::numeric_limits<double>::infinity(), start = 0;
        const Curve* found = nullptr;
        for (const Curve& curve : curves_) {
            if (curve.box.squaredExteriorDistance(p) >= least) continue;
            for (std::size_t i = 0; i < pieces_of_curve; ++i) {
                const Vec3 &a = curve.points[i], along = curve.points[i + 1] - a;
                const double length_sq = along.squaredNorm();
                const double t = length_sq > 0 ? std::clamp(along.dot(p - a) / length_sq, 0.0, 1.0) : 0;
                const double distance = (a + t * along - p).squaredNorm();
                if (distance >= least) continue;
                least = distance;
                start = (1 - t) * curve.parameters[i] + t * curve.parameters[i + 1];
                found = &curve;
            }
        }
        return found->edge.find(p, start);
    }

 private:
    struct Curve {
        NearestOnEdge edge;
        std::vector<double> parameters;
        std::vector<Vec3> points;
        Box box;
    };
    std::vector<Curve> curves_;
};

// All faces and curves, by the names of patches.
class Projector {
 public:
    Projector(const std::vector<Body>& shapes, const std::vector<Patch>& patches, const CadPoints& points) {
        for (std::size_t p = 0; p < points.patch_names.size(); ++p) numbers_.try_emplace(points.patch_names[p], p);
        for (const Body& body : shapes) add_body(body, patches);
        for (const CadPlace& place : points.places) targets_.push_back(target_of(place));
    }

    Vec3 nearest(const Vec3& p, std::int32_t place) const {
        if (place < 0) return p;
        const Target& target = targets_[place];
        if (!target.curves.empty()) return target.curves.nearest(p);
        return target.faces->empty() ? p : target.faces->nearest(p);
    }

 private:
    struct Target {
        CurveGroup curves;
        std::shared_ptr<const FaceGroup> faces;
    };
    struct ModelCurve {
        TopoDS_Edge edge;
        std::vector<std::int32_t> patches;  // ascending
    };

    void add_body(const Body& body, const std::vector<Patch>& patches) {
        const auto number_of = [&](const TopoDS_Shape& face) {
            const auto found = numbers_.find(patches[body.patch_of.Find(face)].name);
            return found == numbers_.end() ? -1 : found->second;
        };
        TopTools_IndexedMapOfShape faces;
        TopExp::MapShapes(body.shape, TopAbs_FACE, faces);
        for (int i = 1; i <= faces.Extent(); ++i) {
            all_faces_.push_back(TopoDS::Face(faces(i)));
            faces_of_[number_of(faces(i))].push_back(TopoDS::Face(faces(i)));
        }
        TopTools_IndexedDataMapOfShapeListOfShape edges;
        TopExp::MapShapesAndUniqueAncestors(body.shape, TopAbs_EDGE, TopAbs_FACE, edges);
        for (int i = 1; i <= edges.Extent(); ++i) {
            const TopoDS_Edge edge = TopoDS::Edge(edges.FindKey(i));
            const TopTools_ListOfShape& around = edges(i);
            if (BRep_Tool::Degenerated(edge) || around.IsEmpty()) continue;
            const TopoDS_Face a = TopoDS::Face(around.First()), b = TopoDS::Face(around.Last());
            ModelCurve curve{edge, {}};
            for (const TopoDS_Shape& face : around) curve.patches.push_back(number_of(face));
            std::sort(curve.patches.begin(), curve.patches.end());
            curve.patches.erase(std::unique(curve.patches.begin(), curve.patches.end()), curve.patches.end());
            const bool is_sharp = around.Extent() > 2 || BRep_Tool::Continuity(edge, a, b) == GeomAbs_C0;
            if (is_sharp || curve.patches.size() > 1) curves_.push_back(std::move(curve));
        }
    }

    Target target_of(const CadPlace& place) {
        std::vector<TopoDS_Edge> shared;
        if (place.is_curve != 0)
            for (const ModelCurve& curve : curves_)
                if (std::includes(curve.patches.begin(), curve.patches.end(), place.patches.begin(),
                                  place.patches.end()))
                    shared.push_back(curve.edge);
        return {CurveGroup(shared), faces_of(place.patches)};
    }

    // Returns the faces of patches. A patch that the model does not know stands for all faces.
    std::shared_ptr<const FaceGroup> faces_of(const std::vector<std::int32_t>& patches) {
        std::vector<TopoDS_Face> faces;
        bool is_known = !patches.empty();
        for (const std::int32_t patch : patches) {
            const auto found = faces_of_.find(patch);
            is_known = is_known && found != faces_of_.end();
            if (is_known) faces.insert(faces.end(), found->second.begin(), found->second.end());
        }
        std::shared_ptr<const FaceGroup>& group = groups_[is_known ? patches : std::vector<std::int32_t>()];
        if (!group) group = std::make_shared<const FaceGroup>(is_known ? faces : all_faces_);
        return group;
    }

    std::map<std::string, std::int32_t> numbers_;  // of patches
    std::vector<TopoDS_Face> all_faces_;
    std::map<std::int32_t, std::vector<TopoDS_Face>> faces_of_;
    std::vector<ModelCurve> curves_;
    std::map<std::vector<std::int32_t>, std::shared_ptr<const FaceGroup>> groups_;
    std::vector<Target> targets_;
};

}  // namespace

ProjectedPoints project_points(const std::vector<Body>& shapes, const std::vector<Patch>& patches,
                               const CadPoints& points, double millimetres) {
    const Projector projector(shapes, patches, points);
    ProjectedPoints result;
    for (std::size_t i = 0; i < points.points.size(); ++i) {
        const Vec3& p = points.points[i];
        result.points.push_back(
            points.place[i] < 0 ? p : Vec3(projector.nearest(p * millimetres, points.place[i]) / millimetres));
    }
    for (std::size_t i = 0; i < points.ends.size(); ++i) {
        const Vec3 &a = result.points[points.ends[i][0]], &b = result.points[points.ends[i][1]];
        result.middles.push_back(projector.nearest(0.5 * (a + b) * millimetres, points.place_of_middle[i]) /
                                 millimetres);
    }
    return result;
}

}  // namespace kerf::cad

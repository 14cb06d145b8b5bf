// Each step is an algorithm of OpenCASCADE on the shape of a body, followed by follow_faces() (face_history.h), which
// gives the new faces the patches of the old ones; a result in which a face has lost its patch is refused, and the body
// stays as it was. Sewing tries tolerances from small to large, because a large one may sew faces that belong apart,
// and takes the first that leaves no free edge: an edge of one face only that is neither degenerate, nor a seam, nor
// internal.
#include "files/cad/inside/healing.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepLib.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <ShapeBuild_ReShape.hxx>
#include <ShapeFix_Solid.hxx>
#include <ShapeUpgrade_ShapeDivideClosed.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <TopoDS_Vertex.hxx>

#include "files/cad/inside/face_history.h"

namespace kerf::cad {

namespace {

// Returns the shells as solids that are turned outwards.
TopoDS_Compound solids_of_shells(const TopoDS_Shape& sewn) {
    TopoDS_Compound solids;
    BRep_Builder builder;
    builder.MakeCompound(solids);
    TopTools_IndexedMapOfShape shells;
    TopExp::MapShapes(sewn, TopAbs_SHELL, shells);
    for (int i = 1; i <= shells.Extent(); ++i) {
        TopoDS_Solid solid = ShapeFix_Solid().SolidFromShell(TopoDS::Shell(shells(i)));
        BRepLib::OrientClosedSolid(solid);
        builder.Add(solids, solid);
    }
    return solids;
}

std::optional<Body> sewn_within(const Body& body, double tolerance) {
    BRepBuilderAPI_Sewing sewing(tolerance);
    for (TopExp_Explorer faces(body.shape, TopAbs_FACE); faces.More(); faces.Next()) sewing.Add(faces.Current());
    sewing.Perform();
    Body sewn{body.name, solids_of_shells(sewing.SewedShape()), {}};
    follow_faces(
        body, [&](const TopoDS_Shape& face) { return std::array<TopoDS_Shape, 1>{sewing.ModifiedSubShape(face)}; },
        sewn.patch_of);
    sewn.own_name = body.own_name;
    TopTools_IndexedMapOfShape faces;
    TopExp::MapShapes(sewn.shape, TopAbs_FACE, faces);
    if (faces.IsEmpty() || !knows_all_faces(sewn.shape, sewn.patch_of)) return {};
    return sewn;
}

}  // namespace

FreeEdges find_free_edges(const Body& body) {
    TopTools_IndexedDataMapOfShapeListOfShape faces_of;
    TopExp::MapShapesAndUniqueAncestors(body.shape, TopAbs_EDGE, TopAbs_FACE, faces_of);
    FreeEdges free;
    for (int i = 1; i <= faces_of.Extent(); ++i) {
        const TopoDS_Edge edge = TopoDS::Edge(faces_of.FindKey(i));
        const TopTools_ListOfShape& faces = faces_of(i);
        if (faces.Extent() != 1 || BRep_Tool::Degenerated(edge)) continue;
        const TopoDS_Face face = TopoDS::Face(faces.First());
        if (BRep_Tool::IsClosed(edge, face) || edge.Orientation() == TopAbs_INTERNAL) continue;
        if (free.count++ == 0)
            if (const TopoDS_Vertex end = TopExp::FirstVertex(edge); !end.IsNull()) {
                const gp_Pnt p = BRep_Tool::Pnt(end);
                free.where = Vec3(p.X(), p.Y(), p.Z());
            }
        free.patches.push_back(body.patch_of.Find(face));
    }
    std::sort(free.patches.begin(), free.patches.end());
    free.patches.erase(std::unique(free.patches.begin(), free.patches.end()), free.patches.end());
    return free;
}

std::optional<double> sew(Body& body, FreeEdges& free) {
    const double diagonal = diagonal_of(body.shape);
    for (const double share : {1e-6, 1e-5, 1e-4, 3e-4})
        if (std::optional<Body> sewn = sewn_within(body, share * diagonal)) {
            FreeEdges left = find_free_edges(*sewn);
            if (left.count < free.count) free = std::move(left);
            if (free.count > 0) continue;
            body = *std::move(sewn);
            return share;
        }
    return {};
}

bool divide_closed_faces(Body& body) {
    ShapeUpgrade_ShapeDivideClosed tool(body.shape);
    tool.Perform();
    if (tool.Result().IsNull() || tool.Result().IsSame(body.shape)) return false;
    Body divided{body.name, tool.Result(), {}};
    const Handle(ShapeBuild_ReShape) context = tool.GetContext();
    follow_faces(
        body, [&](const TopoDS_Shape& face) { return std::array<TopoDS_Shape, 1>{context->Apply(face)}; },
        divided.patch_of);
    divided.own_name = body.own_name;
    if (!knows_all_faces(divided.shape, divided.patch_of)) return false;
    body = std::move(divided);
    return true;
}

std::optional<Body> unite(const std::vector<Body>& bodies) {
    TopTools_ListOfShape first, others;
    for (const Body& body : bodies) (first.IsEmpty() ? first : others).Append(body.shape);
    BRepAlgoAPI_Fuse fuse;
    fuse.SetArguments(first);
    fuse.SetTools(others);
    fuse.Build();
    if (!fuse.IsDone() || fuse.HasErrors()) return {};
    Body united{"united", fuse.Shape(), {}};
    const auto images = [&](const TopoDS_Shape& face) {
        TopTools_ListOfShape pieces = fuse.Modified(face);
        if (pieces.IsEmpty()) pieces.Append(face);
        return pieces;
    };
    for (const Body& body : bodies) follow_faces(body, images, united.patch_of);
    if (!knows_all_faces(united.shape, united.patch_of)) return {};
    return united;
}

double diagonal_of(const TopoDS_Shape& shape) {
    Bnd_Box box;
    BRepBndLib::AddOptimal(shape, box, false, false);
    return box.IsVoid() ? 0 : std::sqrt(box.SquareExtent());
}

}  // namespace kerf::cad

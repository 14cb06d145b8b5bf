#include "cad/cad_files.h"

#include <stdexcept>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_Copy.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>

namespace kerf::test {

struct CadShape::Data {
    TopoDS_Shape shape;
};

namespace {

CadShape cad_shape(const TopoDS_Shape& shape) {
    return CadShape(std::make_shared<const CadShape::Data>(CadShape::Data{shape}));
}

void require_written(bool good, const std::string& path) {
    if (!good) throw std::runtime_error("OpenCASCADE cannot write " + path);
}

void silence() { Message::DefaultMessenger()->ChangePrinters().Clear(); }

}  // namespace

CadShape box(std::array<double, 3> corner, std::array<double, 3> size) {
    return cad_shape(BRepPrimAPI_MakeBox(gp_Pnt(corner[0], corner[1], corner[2]), size[0], size[1], size[2]).Shape());
}
CadShape cylinder(double radius, double height) { return cad_shape(BRepPrimAPI_MakeCylinder(radius, height).Shape()); }
CadShape cone(double radius, double height) { return cad_shape(BRepPrimAPI_MakeCone(radius, 0, height).Shape()); }
CadShape sphere(double radius) { return cad_shape(BRepPrimAPI_MakeSphere(radius).Shape()); }
CadShape torus(double major, double minor) { return cad_shape(BRepPrimAPI_MakeTorus(major, minor).Shape()); }

CadShape rounded_box(double size, double radius) {
    const TopoDS_Shape box = BRepPrimAPI_MakeBox(size, size, size).Shape();
    BRepFilletAPI_MakeFillet fillet(box);
    for (TopExp_Explorer edges(box, TopAbs_EDGE); edges.More(); edges.Next())
        fillet.Add(radius, TopoDS::Edge(edges.Current()));
    return cad_shape(fillet.Shape());
}

CadShape hollow_cube(double size, double inner) {
    const double corner = (size - inner) / 2;
    return cut(box({0, 0, 0}, {size, size, size}), box({corner, corner, corner}, {inner, inner, inner}));
}

CadShape cut(const CadShape& shape, const CadShape& tool) {
    return cad_shape(BRepAlgoAPI_Cut(shape.data().shape, tool.data().shape).Shape());
}

CadShape moved(const CadShape& shape, std::array<double, 3> by) {
    gp_Trsf trsf;
    trsf.SetTranslation(gp_Vec(by[0], by[1], by[2]));
    return cad_shape(shape.data().shape.Moved(TopLoc_Location(trsf)));
}

CadShape together(const std::vector<CadShape>& shapes) {
    TopoDS_Compound compound;
    BRep_Builder().MakeCompound(compound);
    for (const CadShape& shape : shapes) BRep_Builder().Add(compound, shape.data().shape);
    return cad_shape(compound);
}

CadShape loose_faces(const CadShape& shape, int without) {
    std::vector<CadShape> faces;
    for (TopExp_Explorer all(shape.data().shape, TopAbs_FACE); all.More(); all.Next())
        if (without-- <= 0) faces.push_back(cad_shape(BRepBuilderAPI_Copy(all.Current()).Shape()));
    return together(faces);
}

CadShape open_shell(const CadShape& shape) {
    TopoDS_Shell shell;
    BRep_Builder().MakeShell(shell);
    TopoDS_Shape last;
    for (TopExp_Explorer all(shape.data().shape, TopAbs_FACE); all.More(); all.Next()) {
        if (!last.IsNull()) BRep_Builder().Add(shell, last);
        last = all.Current();
    }
    return cad_shape(shell);
}

CadShape line() { return cad_shape(BRepBuilderAPI_MakeEdge(gp_Pnt(0, 0, 0), gp_Pnt(1, 0, 0)).Shape()); }

void write_cad(const std::string& path, const CadShape& shape, const std::string& unit) {
    silence();
    const TopoDS_Shape& data = shape.data().shape;
    if (path.ends_with(".brep")) return require_written(BRepTools::Write(data, path.c_str()), path);
    if (path.ends_with(".step")) {
        STEPControl_Controller::Init();
        Interface_Static::SetCVal("write.step.unit", unit.c_str());
        STEPControl_Writer writer;
        writer.Transfer(data, STEPControl_AsIs);
        return require_written(writer.Write(path.c_str()) == IFSelect_RetDone, path);
    }
    IGESControl_Controller::Init();
    IGESControl_Writer writer(unit == "INCH" ? "IN" : unit.c_str(), 0);
    writer.AddShape(data);
    require_written(writer.Write(path.c_str()), path);
}

void write_assembly(const std::string& path, const std::string& name, const std::vector<CadPart>& parts) {
    silence();
    Handle(TDocStd_Document) document;
    XCAFApp_Application::GetApplication()->NewDocument("MDTV-XCAF", document);
    const Handle(XCAFDoc_ShapeTool) shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
    const Handle(XCAFDoc_ColorTool) colours = XCAFDoc_DocumentTool::ColorTool(document->Main());
    const auto set_name = [](const TDF_Label& label, const std::string& text) {
        TDataStd_Name::Set(label, TCollection_ExtendedString(text.c_str(), true));
    };
    const TDF_Label assembly = shapes->NewShape();
    set_name(assembly, name);
    for (const CadPart& part : parts) {
        const TDF_Label label = shapes->AddShape(part.shape.data().shape, false);
        set_name(label, part.name);
        const auto [r, g, b] = part.colour;
        if (r >= 0) colours->SetColor(label, Quantity_Color(r, g, b, Quantity_TOC_sRGB), XCAFDoc_ColorSurf);
        shapes->AddComponent(assembly, label, TopLoc_Location());
    }
    shapes->UpdateAssemblies();
    STEPCAFControl_Writer writer;
    Interface_Static::SetCVal("write.step.unit", "MM");
    writer.SetColorMode(true);
    writer.SetNameMode(true);
    writer.Transfer(document, STEPControl_AsIs);
    require_written(writer.Write(path.c_str()) == IFSelect_RetDone, path);
}

}  // namespace kerf::test

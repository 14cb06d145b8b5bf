// STEP and IGES come as a document of labels: assemblies, whose components refer to parts with a place, and parts with
// a shape. The walk goes down to the solids of every part; names and colours hang on labels of assemblies, parts,
// solids and faces. Faces are numbered in the order of the file. BREP is a shape without labels.
//
// OpenCASCADE wants a file's name, and Kerf has bytes that may come out of an archive: they are given a name by a file
// in memory.
#include "files/cad/inside/face_surface.h"
#include "files/cad/inside/model.h"

#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <IGESCAFControl_Reader.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_Static.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>

#include "base/core/error.h"
#include "base/core/ids.h"

namespace kerf::cad {

namespace {

constexpr std::size_t longest_path = 200;  // bytes of the name of a solid

class FileInMemory {
 public:
    explicit FileInMemory(std::string_view content) : descriptor_(memfd_create("cad", MFD_CLOEXEC)) {
        while (!content.empty()) {
            const ssize_t n = ::write(descriptor_, content.data(), content.size());
            if (n <= 0) throw Error(ErrorCode::io, "A copy of the CAD file in memory cannot be made.");
            content.remove_prefix(n);
        }
    }
    FileInMemory(const FileInMemory&) = delete;
    FileInMemory& operator=(const FileInMemory&) = delete;
    ~FileInMemory() { ::close(descriptor_); }
    std::string name() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

 private:
    int descriptor_;
};

// Returns at most so many bytes of a text, but whole characters of UTF-8.
std::string shortened(std::string text, std::size_t longest) {
    if (text.size() <= longest) return text;
    std::size_t end = longest;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
    text.resize(end);
    return text;
}

// Tells names that programs write where the user gave none.
bool is_filler(const std::string& name) {
    static const std::set<std::string> fillers = {"",
                                                  "SOLID",
                                                  "COMPOUND",
                                                  "COMPSOLID",
                                                  "SHELL",
                                                  "FACE",
                                                  "the product name",
                                                  "Open CASCADE Shape Model",
                                                  "Unnamed",
                                                  "*",
                                                  "NONE",
                                                  "Fusion-Komponente",
                                                  "PartBody",
                                                  "=>[0:1:1:2]"};
    const bool is_number = name.find_first_not_of("0123456789") == name.npos;
    return is_number || fillers.contains(name) || name.starts_with("Open CASCADE STEP translator") ||
           name.starts_with("=>[");
}

std::string name_of(const TDF_Label& label) {
    Handle(TDataStd_Name) attribute;
    if (label.IsNull() || !label.FindAttribute(TDataStd_Name::GetID(), attribute)) return "";
    const TCollection_ExtendedString& wide = attribute->Get();
    std::string text(wide.LengthOfCString() + 1, '\0');
    Standard_PCharacter begin = text.data();
    wide.ToUTF8CString(begin);
    text.resize(text.find('\0'));
    for (char& c : text)
        if (c == '/' || (c >= 0 && c < ' ') || c == '\x7f') c = '_';
    const std::size_t first = text.find_first_not_of(' '), last = text.find_last_not_of(' ');
    text = first == text.npos ? "" : text.substr(first, last - first + 1);
    return is_filler(text) ? "" : text;
}

std::string joined(const std::string& path, const std::string& name) {
    return path.empty() || name.empty() ? path + name : path + "/" + name;
}

Colour colour_of(const Quantity_Color& linear) {
    double rgb[3];
    linear.Values(rgb[0], rgb[1], rgb[2], Quantity_TOC_sRGB);
    Colour colour = {0, 0, 0, 255};
    for (std::size_t i = 0; i < 3; ++i) colour[i] = std::lround(255 * rgb[i]);
    return colour;
}

// Collects solids and loose faces, in the order of the file.
class ModelBuilder {
 public:
    explicit ModelBuilder(Model& model) : model_(model) {}

    // Adds the solids in a shape, which is placed by `place`. `colour` and `solid_name` are asked for the shape as it
    // is without the place.
    template <class ColourOf, class NameOf>
    void add(const TopoDS_Shape& shape, const TopLoc_Location& place, const std::string& path, const ColourOf& colour,
             const NameOf& solid_name) {
        TopTools_IndexedMapOfShape solids, in_solids;
        TopExp::MapShapes(shape, TopAbs_SOLID, solids);
        for (int i = 1; i <= solids.Extent(); ++i) {
            std::string own = solid_name(solids(i));
            const std::string part = path.substr(path.rfind('/') + 1);
            const std::string own_name = own.empty() ? part : own;
            if (own == part) own.clear();
            if (own.empty() && path.empty()) own = fmt::format("solid {}", model_.bodies.size() + 1);
            if (own.empty() && solids.Extent() > 1) own = fmt::format("solid {}", i);
            const std::string name = unique(joined(path, own));
            TopExp::MapShapes(solids(i), TopAbs_FACE, in_solids);
            model_.bodies.push_back(body_of(solids(i), place, name, colour));
            model_.bodies.back().own_name = own_name;
        }
        add_loose(shape, place, in_solids, path, colour);
    }

 private:
    template <class ColourOf>
    Body body_of(const TopoDS_Shape& solid, const TopLoc_Location& place, const std::string& name,
                 const ColourOf& colour) {
        Body body{name, solid.Moved(place), {}};
        TopTools_IndexedMapOfShape faces, placed;
        TopExp::MapShapes(solid, TopAbs_FACE, faces);
        TopExp::MapShapes(body.shape, TopAbs_FACE, placed);
        for (int i = 1; i <= faces.Extent(); ++i) {
            body.patch_of.Bind(placed(i), count_of(model_.patches));
            model_.patches.push_back(
                {fmt::format("{}/face {}", name, i), colour(faces(i), solid), surface_of(TopoDS::Face(placed(i)))});
        }
        return body;
    }

    template <class ColourOf>
    void add_loose(const TopoDS_Shape& shape, const TopLoc_Location& place, const TopTools_IndexedMapOfShape& in_solids,
                   const std::string& path, const ColourOf& colour) {
        TopTools_IndexedMapOfShape faces;
        TopExp::MapShapes(shape, TopAbs_FACE, faces);
        for (int i = 1; i <= faces.Extent(); ++i) {
            if (in_solids.Contains(faces(i))) continue;
            if (model_.loose.shape.IsNull()) {
                TopoDS_Compound compound;
                BRep_Builder().MakeCompound(compound);
                model_.loose.shape = compound;
                model_.loose.name = path.empty() ? "body" : path;
            }
            const TopoDS_Shape face = faces(i).Moved(place);
            if (model_.loose.patch_of.IsBound(face)) continue;
            BRep_Builder().Add(model_.loose.shape, face);
            model_.loose.patch_of.Bind(face, count_of(model_.patches));
            model_.patches.push_back({fmt::format("{}/face {}", model_.loose.name, model_.loose.patch_of.Extent()),
                                      colour(faces(i), shape), surface_of(TopoDS::Face(face))});
        }
    }

    std::string unique(std::string name) {
        name = shortened(std::move(name), longest_path);
        std::string tried = name;
        for (std::int32_t n = 2; !names_.insert(tried).second; ++n) tried = fmt::format("{} ({})", name, n);
        return tried;
    }

    Model& model_;
    std::set<std::string> names_;
};

// Walks through the labels of a document.
class DocumentWalk {
 public:
    DocumentWalk(const Handle(TDocStd_Document) & document, Model& model)
        : shapes_(XCAFDoc_DocumentTool::ShapeTool(document->Main())),
          colours_(XCAFDoc_DocumentTool::ColorTool(document->Main())),
          builder_(model) {}

    void run() {
        TDF_LabelSequence roots;
        shapes_->GetFreeShapes(roots);
        for (int i = 1; i <= roots.Length(); ++i) visit(roots(i), {}, "", {});
    }

 private:
    void visit(const TDF_Label& label, const TopLoc_Location& place, const std::string& path, Colour inherited) {
        TDF_Label part = label;
        TopLoc_Location own = place;
        if (XCAFDoc_ShapeTool::IsReference(label)) {
            XCAFDoc_ShapeTool::GetReferredShape(label, part);
            own = place * XCAFDoc_ShapeTool::GetLocation(label);
        }
        std::string name = name_of(part);
        if (name.empty()) name = name_of(label);
        const std::string below = joined(path, name);
        for (const TDF_Label& l : {part, label}) find_colour(l, inherited);
        if (!XCAFDoc_ShapeTool::IsAssembly(part)) {
            add_part(part, own, below, inherited);
            return;
        }
        TDF_LabelSequence components;
        XCAFDoc_ShapeTool::GetComponents(part, components);
        for (int i = 1; i <= components.Length(); ++i) visit(components(i), own, below, inherited);
    }

    void add_part(const TDF_Label& part, const TopLoc_Location& place, const std::string& path, Colour inherited) {
        const auto sub_label = [&](const TopoDS_Shape& shape) {
            TDF_Label label;
            shapes_->FindSubShape(part, shape, label);
            return label;
        };
        const auto colour = [&](const TopoDS_Shape& face, const TopoDS_Shape& solid) {
            Colour found = inherited;
            for (const TopoDS_Shape& shape : {solid, face})
                if (const TDF_Label label = sub_label(shape); !label.IsNull()) find_colour(label, found);
            return found;
        };
        builder_.add(XCAFDoc_ShapeTool::GetShape(part), place, path, colour,
                     [&](const TopoDS_Shape& solid) { return name_of(sub_label(solid)); });
    }

    // Leaves the colour as it is where the label has none.
    void find_colour(const TDF_Label& label, Colour& colour) const {
        Quantity_Color found;
        for (const XCAFDoc_ColorType type : {XCAFDoc_ColorSurf, XCAFDoc_ColorGen})
            if (colours_->GetColor(label, type, found)) {
                colour = colour_of(found);
                return;
            }
    }

    Handle(XCAFDoc_ShapeTool) shapes_;
    Handle(XCAFDoc_ColorTool) colours_;
    ModelBuilder builder_;
};

std::string unit_name(std::string name) {
    for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    static const std::map<std::string, std::string> short_names = {
        {"millimetre", "mm"}, {"millimeter", "mm"}, {"metre", "m"}, {"meter", "m"},
        {"centimetre", "cm"}, {"centimeter", "cm"}, {"in", "inch"}, {"foot", "ft"}};
    const auto found = short_names.find(name);
    return found == short_names.end() ? name : found->second;
}

std::string unit_of(STEPCAFControl_Reader& reader) {
    TColStd_SequenceOfAsciiString lengths, angles, solid_angles;
    reader.ChangeReader().FileUnits(lengths, angles, solid_angles);
    std::string units;
    std::set<std::string> seen;
    for (int i = 1; i <= lengths.Length(); ++i)
        if (const std::string unit = unit_name(lengths(i).ToCString()); seen.insert(unit).second)
            units += (units.empty() ? "" : " and ") + unit;
    return units.empty() ? "mm" : units;
}

std::string unit_of(IGESCAFControl_Reader& reader) {
    const Handle(TCollection_HAsciiString) unit = reader.IGESModel()->GlobalSection().UnitName();
    return unit.IsNull() ? "mm" : unit_name(unit->ToCString());
}

std::string_view last_line(std::string_view content) {
    content = content.substr(0, content.find_last_not_of(" \t\r\n\x1a") + 1);
    return content.substr(content.rfind('\n') + 1);  // npos + 1 is 0
}

// Tells a file that is cut off: OpenCASCADE takes the part of it that is there, and says nothing.
bool is_cut_off(std::string_view content, CadFormat format) {
    constexpr std::size_t section_column = 72;
    if (format == CadFormat::step) return content.find("END-ISO-10303-21") == content.npos;
    const std::string_view last = last_line(content);
    return format == CadFormat::iges && (last.size() <= section_column || last[section_column] != 'T');
}

template <class Reader>
void read_document(const FileInMemory& file, const std::string& path, Model& model) {
    Handle(XCAFApp_Application) application = XCAFApp_Application::GetApplication();
    Handle(TDocStd_Document) document;
    application->NewDocument("MDTV-XCAF", document);
    Reader reader;
    Interface_Static::SetCVal("xstep.cascade.unit", "MM");
    reader.SetNameMode(true);
    reader.SetColorMode(true);
    if (reader.ReadFile(file.name().c_str()) != IFSelect_RetDone)
        throw Error(ErrorCode::input, fmt::format("{}: the {} file is damaged and cannot be read. Export it again.",
                                                  path, name(model.format)));
    model.unit = unit_of(reader);
    reader.Transfer(document);
    DocumentWalk(document, model).run();
}

void read_brep(std::string_view content, Model& model) {
    std::istringstream stream{std::string(content)};
    stream.exceptions(std::ios::failbit | std::ios::badbit);  // OpenCASCADE loops for ever behind the end of the file
    TopoDS_Shape shape;
    BRepTools::Read(shape, stream, BRep_Builder());
    if (shape.IsNull()) return;
    BRepTools::Clean(shape);  // triangulations of others would be kept
    const auto no_colour = [](const TopoDS_Shape&, const TopoDS_Shape&) { return Colour{}; };
    ModelBuilder(model).add(shape, {}, "", no_colour, [](const TopoDS_Shape&) { return std::string(); });
}

void read_content(std::string_view content, const std::string& path, Model& model) {
    if (model.format == CadFormat::brep) return read_brep(content, model);
    const FileInMemory file(content);
    if (model.format == CadFormat::step) return read_document<STEPCAFControl_Reader>(file, path, model);
    read_document<IGESCAFControl_Reader>(file, path, model);
}

}  // namespace

Model read_model(std::string_view content, const std::string& path) {
    Model model;
    model.format = cad_format(content);
    if (model.format == CadFormat::none)
        throw Error(ErrorCode::input, path + ": this is no CAD file. Give STEP, IGES or BREP.");
    if (is_cut_off(content, model.format))
        throw Error(ErrorCode::input, fmt::format("{}: the {} file is cut off: its last line is missing. Export or "
                                                  "copy it again.",
                                                  path, name(model.format)));
    try {
        read_content(content, path, model);
    } catch (const Standard_Failure& failure) {
        throw Error(ErrorCode::input, fmt::format("{}: the {} file is damaged ({}). Export it again.", path,
                                                  name(model.format), failure.DynamicType()->Name()));
    } catch (const std::ios::failure&) {
        throw Error(ErrorCode::input, fmt::format("{}: the {} file is damaged or cut off. Export or copy it again.",
                                                  path, name(model.format)));
    }
    if (model.patches.empty())
        throw Error(ErrorCode::input,
                    fmt::format("{}: the {} file holds no faces, or it is damaged. Export the solids again.", path,
                                name(model.format)));
    return model;
}

std::string names_of(const std::vector<std::int32_t>& patches, const std::vector<Patch>& all) {
    constexpr std::size_t most_named = 4;
    std::string text;
    for (std::size_t i = 0; i < std::min(patches.size(), most_named); ++i)
        text += fmt::format("{}'{}'", i == 0 ? "" : ", ", all[patches[i]].name);
    if (patches.size() > most_named) text += fmt::format(" and {} more", patches.size() - most_named);
    return text;
}

}  // namespace kerf::cad

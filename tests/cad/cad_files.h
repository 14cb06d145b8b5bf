// CAD files with known volumes, made by OpenCASCADE.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace kerf::test {

/// A shape of OpenCASCADE, whose headers the tests do not see.
class CadShape {
 public:
    struct Data;
    explicit CadShape(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
    const Data& data() const { return *data_; }

 private:
    std::shared_ptr<const Data> data_;
};

CadShape box(std::array<double, 3> corner, std::array<double, 3> size);
CadShape cylinder(double radius, double height);
/// A full cone, whose tip is at the top.
CadShape cone(double radius, double height);
CadShape sphere(double radius);
CadShape torus(double major, double minor);
/// A box whose edges are all rounded.
CadShape rounded_box(double size, double radius);
/// A cube with a void: a box inside.
CadShape hollow_cube(double size, double inner);
/// The shape without what the tool fills.
CadShape cut(const CadShape& shape, const CadShape& tool);
CadShape moved(const CadShape& shape, std::array<double, 3> by);
CadShape together(const std::vector<CadShape>& shapes);
/// The faces of a shape by themselves, without the first `without` of them; no two share an edge.
CadShape loose_faces(const CadShape& shape, int without = 0);
/// Its shell without the last face.
CadShape open_shell(const CadShape& shape);
/// An edge: a shape without faces.
CadShape line();

/// A part of an assembly.
struct CadPart {
    std::string name;
    CadShape shape;
    std::array<double, 3> colour = {-1, -1, -1};  ///< sRGB; negative: none
};

/// Writes a file; the ending tells the format: .step, .igs or .brep. `unit`: of the numbers in it, "MM", "INCH" or "M";
/// the shapes are in millimetres.
void write_cad(const std::string& path, const CadShape& shape, const std::string& unit = "MM");
/// An assembly of this name.
void write_assembly(const std::string& path, const std::string& name, const std::vector<CadPart>& parts);

}  // namespace kerf::test

// The content of a CAD file, as OpenCASCADE's shapes with names and colours.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopoDS_Shape.hxx>

#include "files/io/cad_body.h"
#include "surface/soup/facet_sides.h"

namespace kerf::cad {

using Colour = std::array<std::uint8_t, 4>;  // sRGB and 255; zeros: no colour

/// A face of the file. Pieces of it, if it is cut, stay one patch.
struct Patch {
    std::string name;
    Colour colour = {};
    PatchFace face = {};  ///< millimetres; without the name
};

/// A solid in its place, or several that share faces (files/cad/inside/imprint.h).
struct Body {
    std::string name;  ///< path along the assembly; unique
    TopoDS_Shape shape;
    TopTools_DataMapOfShapeInteger patch_of;  ///< face -> index into Model::patches
    std::string own_name = {};                ///< name in the file without the path; empty if it has none
};

struct Model {
    CadFormat format = CadFormat::none;
    std::string unit;  ///< unit of the file, and shapes are in millimetres; empty for BREP, which has none
    std::vector<Body> bodies;
    std::vector<Patch> patches;
    Body loose;  ///< faces that belong to no solid, in a compound; null if there are none
    std::vector<std::string> notes;
};

/// Reads the content of a file. Throws Error(input) for content that is damaged, cut off or without any face.
Model read_model(std::string_view content, const std::string& path);

/// Returns the names of the patches of these faces, the first few of them.
std::string names_of(const std::vector<std::int32_t>& patches, const std::vector<Patch>& all);

}  // namespace kerf::cad

// Tessellates one solid.
#pragma once

#include <string>

#include "files/cad/inside/model.h"
#include "files/cad/inside/tessellation.h"

namespace kerf::cad {

struct MeshedBody {
    Tessellation facets;      ///< closed, without crossings, outwards
    double exact_volume = 0;  ///< volume of the solid; cubic millimetres
};

/// Tessellates a body until its facets are closed, do not cross, and hold the volume of the solid to within
/// CadOptions::volume_tolerance; with CadOptions::on_faces, until little is between facets and faces. The deflection is
/// that of the options, or as fine as the volume asks for. With `may_balance` vertices are moved off the faces for the
/// volume, else all stay on them. Closed faces of the body may be divided, which the model notes. Throws SolidDefect.
/// Deterministic.
MeshedBody mesh_body(Body& body, Model& model, const std::string& path, const CadOptions& options, bool may_balance);

/// Throws SolidDefect of a kind that files/io/cad_body.h names; `what` says the defect and the way out.
[[noreturn]] void refuse(const std::string& path, const std::string& what, const char* kind = SolidDefect::broken,
                         std::vector<ErrorElements> elements = {});

/// Returns "1 face", "2 faces".
std::string counted(std::size_t n, const char* one, const char* many);
std::string place_text(const Vec3& p);

}  // namespace kerf::cad

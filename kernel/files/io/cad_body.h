// The answer of the program kerf-cad to a CAD file, and the options that kerf-cad is given.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/core/bytes.h"
#include "base/core/error.h"
#include "base/core/hash.h"
#include "files/io/cad_points.h"
#include "surface/soup/soup.h"

namespace kerf {

/// Units of length into which a CAD file is converted.
enum class LengthUnit : std::int32_t { mm, cm, m, inch, ft };

/// The names of the units, in the order of the enumeration.
const std::vector<std::string>& length_unit_names();
double millimetres_of(LengthUnit unit);

struct CadOptions {
    std::int32_t solid = 0;            ///< number of the only solid, from 1 in the order of the file; 0: all
    bool unite = false;                ///< solids that touch or overlap become one
    bool no_imprint = false;           ///< solids that touch are refused, and do not become regions that share walls
    LengthUnit unit = LengthUnit::mm;  ///< unit of the result; a file without one (BREP) keeps its numbers
    double deflection = 0;             ///< largest distance of a chord from its curve as a share of the diagonal of
                                       ///< the solid; 0: such that the volume is right to `volume_tolerance`,
                                       ///< for which vertices leave the curved faces a little
    bool unit_is_asked = false;        ///< the user named `unit`: a file without a unit is refused
    bool on_faces = false;             ///< all vertices stay on the faces, and the volume is right to 0.001 only: for
                                       ///< meshes whose nodes on edges are put on the faces, too

    bool as_it_is = false;  ///< the triangles of all faces that get some, whether or not they meet: for a
                            ///< wrap of what import refuses

    static constexpr double volume_tolerance = 1e-4;  ///< most |volume of facets - volume of solid| / volume of solid

    /// Returns the options as arguments of kerf-cad.
    std::vector<std::string> arguments() const;
    /// Throws Error(usage) for arguments that are no options.
    static CadOptions from_arguments(std::span<const std::string> arguments);
};

/// The surface of which a patch is a face, with lengths in the unit of the soup.
struct PatchFace {
    std::string patch;  ///< name
    std::string kind;   ///< "plane", "cylinder", "cone of 15 degrees", "sphere", "torus", "spline", ...
    double radius = 0;  ///< of a cylinder, a sphere or a torus, else 0
    double tube = 0;    ///< radius of a torus's tube, else 0

    template <class Archive>
    void archive(Archive& a) {
        a(patch, kind, radius, tube);
    }
};

/// Returns "cylinder r = 0.375".
std::string to_text(const PatchFace& face);

/// The solids of a CAD file as one soup.
struct CadBody {
    /// Closed and free of intersections, unless it is as it is; patches are faces, named `<path of the solid>/face n`.
    Soup soup;
    std::vector<PatchFace> faces_of_patches;  ///< surfaces of the patches; none of a file without curved faces
    std::string format;                       ///< "STEP", "IGES" or "BREP"
    std::string file_unit;  ///< "inch"; "mm" if a STEP or IGES file names none; empty for BREP, which has none
    std::string unit;       ///< unit of the soup; empty if `file_unit` is
    std::int32_t solids = 0;
    std::int32_t faces = 0;
    double exact_volume = 0;  ///< volume of the solids with their curved faces, by OpenCASCADE
    double volume = 0;        ///< volume inside of the facets
    FileHash file_hash = {};  ///< hash of the bytes that were read

    template <class Archive>
    void archive(Archive& a) {
        a(soup, faces_of_patches, format, file_unit, unit, solids, faces, exact_volume, volume, file_hash);
    }
};

/// The error of a CAD file that was read well, but whose solids cannot be meshed as they are.
class SolidDefect : public Error {
 public:
    static constexpr const char* touching = "touching solids";  ///< or overlapping ones
    static constexpr const char* open = "open solid";
    static constexpr const char* broken = "broken solid";  ///< intersects itself, or its faces do not bound it

    SolidDefect(std::string kind, const std::string& message, std::vector<ErrorElements> elements = {})
        : Error(ErrorCode::input, message, std::move(elements)), kind_(std::move(kind)) {}
    const std::string& kind() const { return kind_; }

 private:
    std::string kind_;
};

/// The answer of kerf-cad: a body, or the reason why there is none.
struct CadAnswer {
    std::int32_t error_code = 0;  ///< an ErrorCode; 0: none
    std::string message;
    CadBody body;
    std::string defect = {};  ///< kind of a SolidDefect; empty: another error, or none
    std::vector<ErrorElements> elements = {};
    ProjectedPoints projected = {};  ///< points that were put on the faces; `body` has no soup then

    template <class Archive>
    void archive(Archive& a) {
        a(error_code, message, body, defect, elements, projected);
    }
};

/// An answer as bytes between processes of one machine type, and back. from_cad_bytes() throws Error(internal) for
/// bytes that are no answer, or the answer of another version of Kerf.
Bytes to_cad_bytes(const CadAnswer& answer);
CadAnswer from_cad_bytes(std::span<const char> bytes);

enum class CadFormat { none, step, iges, brep };

/// Returns the format that the first bytes of the content tell.
CadFormat cad_format(std::string_view content);
const char* name(CadFormat format);

}  // namespace kerf

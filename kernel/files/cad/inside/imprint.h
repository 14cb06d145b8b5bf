// Makes solids that touch share the faces, edges and vertices in which they touch.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/core/ids.h"
#include "base/core/types.h"
#include "files/cad/inside/contact.h"
#include "files/cad/inside/model.h"

namespace kerf::cad {

/// Solids whose common faces, edges and vertices exist once.
struct Assembly {
    Body faces;                     ///< faces of all solids, each once, in a compound; its patches are those of `sides`
    std::vector<FacetSides> sides;  ///< sides of the patches of `faces`, the bodies being the regions
    std::vector<Patch> patches;     ///< patches of `faces`: each is of one solid, or of the walls between two
    std::vector<std::string> region_names;  ///< names of the bodies, unique
    Array<RegionIndex, double> volumes;     ///< volumes of the bodies with their curved faces; cubic millimetres
    std::int32_t wall_faces = 0;            ///< number of faces of two bodies
    double tolerance = 0;  ///< distance within which faces were taken as one; millimetres; 0: that of the file
};

/// The reason why there is no assembly.
struct ImprintFailure {
    enum class Kind {
        overlap,  ///< two bodies hold a common volume; `where` is its middle
        apart,    ///< two bodies touch, but share no vertex afterwards
        broken,   ///< OpenCASCADE fails, or a body has changed its volume
    };
    Kind kind = Kind::broken;
    std::array<std::size_t, 2> bodies = {};  ///< the two bodies; the same twice: one body
    Vec3 where = Vec3::Zero();               ///< millimetres
};

/// Splits the faces of the bodies where others touch them (OpenCASCADE's general fuse), within 1e-6 of the diagonal of
/// the smallest body first, then within the tolerances of the model alone, then within 1e-5 of the diagonal. `contact`:
/// two bodies that are known to touch. Walls are patches of the name "A_to_B", A being the first of both in the order
/// of the bodies, and have the colour of its face; they have A behind them. The bodies stay as they are. Deterministic.
/// Seconds for some hundred faces that touch.
class Imprint {
 public:
    Imprint(const std::vector<Body>& bodies, const std::vector<Patch>& patches, const Contact& contact);

    const std::optional<Assembly>& assembly() const { return assembly_; }
    /// Returns the reason, if there is no assembly.
    const ImprintFailure& failure() const { return failure_; }

 private:
    std::optional<Assembly> assembly_;
    ImprintFailure failure_;
};

/// Returns names for regions: those of the bodies in the file without their path, "name_2" where one comes again,
/// "solid_3" for the third body if it has none.
std::vector<std::string> region_names(const std::vector<Body>& bodies);

}  // namespace kerf::cad

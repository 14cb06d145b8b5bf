// Reads CAD files as closed surfaces, by OpenCASCADE.
#pragma once

#include <string>
#include <string_view>

#include "files/io/cad_body.h"

namespace kerf {

/// Returns the solids of a STEP, IGES or BREP file as facets that meet as the faces of the solids do: closed, free of
/// intersections, turned outwards, a patch for each face. `content`: of the file, not compressed; `path` serves
/// messages.
///
/// Facets are welded by the topology of the model, never by coordinates. Loose faces are sewn where the file has no
/// solid. The volume is right to CadOptions::volume_tolerance, by chords that get finer and by vertices a little off
/// the curved faces (files/cad/inside/volume_balance.h), unless that takes more facets than some 100,000s, or 80,000 of
/// one face. With CadOptions::on_faces all vertices stay on the faces, with little between these and the facets. No two
/// facets cross. Soup::notes says what was read, converted, sewn, divided or left out.
///
/// Where solids touch, all of them are regions: the faces, edges and vertices in which they touch exist once
/// (files/cad/inside/imprint.h), Soup::sides and Soup::region_names are set, and the volume of each is right. Where
/// none touch, these stay empty, unless a solid lies inside of another one: it is cut out of that, and both are
/// regions, too.
///
/// Throws Error(input), in one sentence that names the file, the solids or faces and the way out, for a file that is
/// damaged or cut off or holds no faces, as SolidDefect for solids that are open, intersect themselves or overlap, or
/// touch where CadOptions::no_imprint forbids that or OpenCASCADE fails on it; Error(usage) for a solid that the file
/// does not have. Deterministic. Seconds for 1000 faces. Not for several threads at once: OpenCASCADE has global
/// settings.
CadBody import_cad(std::string_view content, const std::string& path, const CadOptions& options = {});

/// Puts points on the faces and curves that import_cad() tessellates with the same options
/// (files/cad/inside/projection.h). Throws as import_cad(), takes as much time and memory, and about 10 us a point
/// more.
ProjectedPoints project_on_cad(std::string_view content, const std::string& path, const CadOptions& options,
                               const CadPoints& points);

/// Silences OpenCASCADE's own messages, which would go to standard output.
void silence_occt();

}  // namespace kerf

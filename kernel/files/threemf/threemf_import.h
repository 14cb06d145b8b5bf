// Reads 3MF files as triangle soups, by lib3mf.
#pragma once

#include <string>
#include <string_view>

#include "files/io/cad_body.h"

namespace kerf {

/// Returns the objects that a 3MF file has to be built, where it places them, in `options.unit`. An object is a patch,
/// named as in the file, "object 5" where it has no name, behind the names of the objects of components that it is part
/// of: "table/leg". Where an object is placed several times, the others are "table/leg 2", "table/leg 3", ... Objects
/// that touch or overlap are not united. Objects that only support others in the print are passed over;
/// CadBody::soup.notes says so. `options.solid` takes one build item. CadBody::solids counts build items,
/// CadBody::faces patches.
///
/// lib3mf keeps coordinates and transformations in single precision; they are applied in double precision.
///
/// Throws Error(input) naming the file and the way out for content that is damaged or without facets, or repeats
/// objects too often; Error(usage) for options that only CAD files have, or a build item that is not there.
CadBody import_threemf(std::string_view content, const std::string& path, const CadOptions& options = {});

}  // namespace kerf

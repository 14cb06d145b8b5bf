// The surfaces that every checkout holds; assets/README.md tells what each is there for.
#pragma once

#include <string>
#include <vector>

#include "support/places.h"
#include "surface/complex/surface.h"

namespace kerf::test {

inline const std::vector<std::string>& asset_names() {
    static const std::vector<std::string> names = {
        "bearing_cap_14k", "bearing_cap_52k", "cube",           "cylinder",    "hollow_box", "knee_femoral",
        "knee_tibial",     "pipe_with_holes", "sinter_packing", "wing_in_box",
    };
    return names;
}

inline std::string asset_path(const std::string& name) { return asset_folder() + "/" + name + ".stl"; }

/// What a run cuts of it: the surface as it is, outward, with the keys of an input.
Surface asset_surface(const std::string& name);

}  // namespace kerf::test

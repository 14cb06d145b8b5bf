#include "support/assets.h"

#include "files/io/surface_reader.h"
#include "support/shapes.h"
#include "surface/diagnosis/orientation.h"

namespace kerf::test {

Surface asset_surface(const std::string& name) {
    Soup soup = read_surface(asset_path(name));
    orient(soup);
    return to_surface(soup);
}

}  // namespace kerf::test

#include "size/size_field.h"

#include "core/check.h"
#include "core/regular_tet.h"

namespace kerf {

SizeField::SizeField(double max_volume)
    : max_volume_(max_volume), edge_(max_volume > 0 ? regular_tet_edge(max_volume) : infinity) {
    KERF_CHECK(max_volume >= 0);
}

double SizeField::at(const Vec3&) const { return edge_; }

double SizeField::max_volume_at(const Vec3&) const { return max_volume_ > 0 ? max_volume_ : infinity; }

}  // namespace kerf

// A size field is the minimum of a constant and of sources (solids, sized_triangles.h, background_sizes.h),
// each of which has its size where it lies and grows with the distance. The running minimum is handed from source to
// source as a `bound`, so that trees are searched only for less than is known already. The constant is kept as the
// volume that was given, with its edge beside it: where no source is smaller the volume comes back to the last bit.
// `edge_factor_` scales the sources, so that a coarser field shares them. within() must not change a bit of any answer,
// so that a worker, which gets no more, meshes as it would with the whole field.
#include "surface/size/size_field.h"

#include <cmath>

#include <fmt/format.h>

#include "base/core/check.h"
#include "base/core/cube_root.h"
#include "base/geometry/tetrahedron.h"
#include "surface/size/mean_edge.h"

namespace kerf {

bool SizeSources::empty() const {
    return boxes.empty() && spheres.empty() && cylinders.empty() && triangles.empty() && backgrounds.empty();
}

double SizeSources::smallest() const {
    double least = triangles.smallest();
    for (const SizedBox& box : boxes) least = std::min(least, box.size);
    for (const SizedSphere& sphere : spheres) least = std::min(least, sphere.size);
    for (const SizedCylinder& cylinder : cylinders) least = std::min(least, cylinder.size);
    for (const BackgroundSizes& background : backgrounds) least = std::min(least, background.smallest());
    return least;
}

double SizeSources::size_of_solids(const Vec3& p, double bound) const {
    const auto take = [&](const auto& solids) {
        for (const auto& solid : solids) bound = std::min(bound, solid.size + growth * solid.distance(p));
    };
    take(boxes);
    take(spheres);
    take(cylinders);
    return bound;
}

double SizeSources::size_at(const Vec3& p, double bound) const {
    bound = size_of_solids(p, bound);
    for (const BackgroundSizes& background : backgrounds) bound = background.size_at(p, growth, bound);
    return triangles.size_at(p, growth, bound);
}

// The bound of the triangles leaves out backgrounds, which may jump between cells that overlap.
SizeSources SizeSources::within(const Eigen::AlignedBox3d& box, double bound) const {
    SizeSources kept = *this;
    kept.triangles = triangles.within(box, growth, [&](const Eigen::AlignedBox3d& cell) {
        return std::min(bound, size_of_solids(cell.center(), bound) + growth * cell.diagonal().norm() / 2);
    });
    return kept;
}

std::vector<std::string> SizeField::solids() const {
    std::vector<std::string> texts;
    if (!sources_) return texts;
    for (const SizedBox& box : sources_->boxes)
        texts.push_back(fmt::format("box:{},{}", fmt::join(box.low, ","), fmt::join(box.high, ",")));
    for (const SizedSphere& sphere : sources_->spheres)
        texts.push_back(fmt::format("sphere:{},{}", fmt::join(sphere.centre, ","), sphere.radius));
    for (const SizedCylinder& cylinder : sources_->cylinders)
        texts.push_back(fmt::format("cylinder:{},{},{}", fmt::join(cylinder.from, ","), fmt::join(cylinder.to, ","),
                                    cylinder.radius));
    return texts;
}

SizeField::SizeField(double max_volume)
    : max_volume_(max_volume), edge_(max_volume > 0 ? mean_edge_below(max_volume) : infinity) {
    KERF_CHECK(max_volume >= 0);
}

SizeField::SizeField(double max_volume, SizeSources sources, double edge_factor) : SizeField(max_volume) {
    KERF_CHECK(edge_factor > 0);
    edge_factor_ = edge_factor;
    set(std::move(sources));
}

void SizeField::set(SizeSources sources) {
    if (sources.empty())
        sources_.reset();
    else
        sources_ = std::make_shared<const SizeSources>(std::move(sources));
}

double SizeField::at(const Vec3& p, double bound) const {
    bound = std::min(bound, edge_);
    return sources_ ? std::min(bound, edge_factor_ * sources_->size_at(p, bound / edge_factor_)) : bound;
}

double SizeField::max_volume_at(const Vec3& p) const {
    const double edge = at(p);
    return edge < edge_ ? largest_volume_for(edge) : max_volume_ > 0 ? max_volume_ : infinity;
}

double SizeField::smallest() const { return sources_ ? std::min(edge_, edge_factor_ * sources_->smallest()) : edge_; }

double SizeField::reference_volume() const { return smallest() < edge_ ? largest_volume_for(smallest()) : max_volume_; }

SizeField SizeField::with_constant(double max_volume) const {
    SizeField field(max_volume);
    field.edge_factor_ = edge_factor_;
    field.sources_ = sources_;
    return field;
}

SizeField SizeField::coarser(double factor) const {
    SizeField field(max_volume_ * factor);
    field.edge_factor_ = edge_factor_ * cube_root(factor);
    field.sources_ = sources_;
    return field;
}

SizeField SizeField::within(const Eigen::AlignedBox3d& box) const {
    SizeField field = *this;
    if (sources_) field.set(sources_->within(box, edge_ / edge_factor_));
    return field;
}

bool is_too_large(const SizeField& size, const std::array<Vec3, 4>& corners) {
    if (size.is_empty()) return false;
    const auto& [a, b, c, d] = corners;
    if (size.is_constant()) return six_volumes_of(a, b, c, d) > 6 * size.reference_volume();
    // Among 1.0 to 1.2, and among bounds of the volume and of the longest edge, this bound makes most edges 0.7 to 1.4
    // times as long as wanted (97 %), with 1 in the median.
    constexpr double too_long = 1.15;
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = i + 1; j < 4; ++j) sum += (corners[i] - corners[j]).norm();
    const double allowed = sum / 6 / too_long;
    return size.at((a + b + c + d) / 4, allowed) < allowed;
}

}  // namespace kerf

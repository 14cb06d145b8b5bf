// The size of tetrahedra that is wanted at each point of space.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include <Eigen/Geometry>

#include "base/core/bytes.h"
#include "base/core/types.h"
#include "surface/size/background_sizes.h"
#include "surface/size/inside/sized_triangles.h"

namespace kerf {

/// A box. Each solid knows the distance of a point from it, 0 inside, and the edge length `size` > 0 wanted inside.
struct SizedBox {
    Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< opposite corners, low <= high
    double size = 1;

    double distance(const Vec3& p) const { return (low - p).cwiseMax(p - high).cwiseMax(0).norm(); }

    template <class Archive>
    void archive(Archive& a) {
        a(low, high, size);
    }
};

struct SizedSphere {
    Vec3 centre = Vec3::Zero();
    double radius = 0;
    double size = 1;

    double distance(const Vec3& p) const { return std::max(0.0, (p - centre).norm() - radius); }

    template <class Archive>
    void archive(Archive& a) {
        a(centre, radius, size);
    }
};

/// A right circular cylinder with flat ends.
struct SizedCylinder {
    Vec3 from = Vec3::Zero(), to = Vec3::UnitX();  ///< centres of the ends, which differ
    double radius = 0;
    double size = 1;

    double distance(const Vec3& p) const {
        const double length = (to - from).norm();
        const Vec3 axis = (to - from) / length;
        const double along = axis.dot(p - from);
        const double beyond_end = std::max({0.0, -along, along - length});
        const double beyond_side = std::max(0.0, (p - from - along * axis).norm() - radius);
        return std::hypot(beyond_end, beyond_side);
    }

    template <class Archive>
    void archive(Archive& a) {
        a(from, to, radius, size);
    }
};

/// The sources of a SizeField, which takes the minimum of a constant and of all of them. A source has its size where it
/// lies; elsewhere, `growth` times the distance is added.
struct SizeSources {
    double growth = 0;  ///< >= 0
    std::vector<SizedBox> boxes;
    std::vector<SizedSphere> spheres;
    std::vector<SizedCylinder> cylinders;
    SizedTriangles triangles;
    std::vector<BackgroundSizes> backgrounds;

    bool empty() const;
    double smallest() const;
    /// Returns the least of all sources and `bound` at a point.
    double size_at(const Vec3& p, double bound) const;

    /// Returns the least of the boxes, spheres and cylinders and `bound` at a point.
    double size_of_solids(const Vec3& p, double bound) const;
    /// Returns the sources without triangles that do not matter in the box: size_at(p, bound) is the same there.
    SizeSources within(const Eigen::AlignedBox3d& box, double bound) const;

    template <class Archive>
    void archive(Archive& a) {
        a(growth, boxes, spheres, cylinders, triangles, backgrounds);
    }
};

/// The wanted edge length as a function of space: the minimum of a constant and of sources. It is a value, cheap to
/// copy, serialised with all its data. The answer depends on the point alone, and differs between two points by no more
/// than growth() times their distance (but see BackgroundSizes). Thread-safe.
class SizeField {
 public:
    /// A field that asks for no size anywhere: infinity.
    SizeField() = default;
    /// A field that is the same everywhere: tetrahedra of at most this volume, which is kept as it is; 0: no size is
    /// asked for.
    explicit SizeField(double max_volume);
    /// A field of a constant, 0 for none, and of sources, which make it smaller at places; their lengths count
    /// `edge_factor` > 0 times.
    SizeField(double max_volume, SizeSources sources, double edge_factor = 1);

    /// Returns the wanted edge length; infinity if none is. O(log n) for n triangles and cells in the sources, a few
    /// microseconds.
    double at(const Vec3& p) const { return at(p, edge_); }
    /// Returns the lesser of at(p) and `bound`, sooner if the bound is small.
    double at(const Vec3& p, double bound) const;
    /// Returns the largest volume of a tetrahedron at p, with which edges have the length at(p) on average
    /// (mean_edge.h). Infinity if no size is wanted.
    double max_volume_at(const Vec3& p) const;
    /// A lower bound of the wanted edge length at all points; infinity if none is wanted.
    double smallest() const;
    bool is_empty() const { return max_volume_ == 0 && is_constant(); }
    /// Whether all points have the same edge length, infinity included.
    bool is_constant() const { return !sources_; }
    /// max_volume_at() at the smallest size: that of all points if the field is constant. 0: no size is wanted. Volumes
    /// are measured in units of it where tetrahedra are counted, see sized_volume().
    double reference_volume() const;
    /// The largest volume by the constant alone; infinity if there is none.
    double constant_volume() const { return max_volume_ > 0 ? max_volume_ : infinity; }
    /// Returns the boxes, spheres and cylinders of the sources, in that order, as --size-in has them, without their
    /// sizes.
    std::vector<std::string> solids() const;
    /// Calls visit(i) for each of solids() in which the point lies.
    template <class Visit>
    void for_each_solid_at(const Vec3& p, const Visit& visit) const {
        if (!sources_) return;
        std::size_t number = 0;
        const auto look = [&](const auto& solids) {
            for (const auto& solid : solids) {
                if (solid.distance(p) == 0) visit(number);
                ++number;
            }
        };
        look(sources_->boxes);
        look(sources_->spheres);
        look(sources_->cylinders);
    }
    /// The largest change of at() per distance.
    double growth() const { return sources_ ? edge_factor_ * sources_->growth : 0; }

    /// Returns the field with the same sources and this constant in place of its own. 0: no constant.
    SizeField with_constant(double max_volume) const;
    /// Returns the field whose tetrahedra may be `factor` > 0 times as large in volume.
    SizeField coarser(double factor) const;
    /// Returns a field with fewer sources that gives the same answer, to the last bit, at each point of the box: for a
    /// worker that needs no others. It is constant or empty if and only if this one is. O(n) for n triangles in the
    /// sources.
    SizeField within(const Eigen::AlignedBox3d& box) const;

    template <class Archive>
    void archive(Archive& a) {
        a(max_volume_, edge_, edge_factor_);
        if constexpr (std::is_same_v<Archive, ByteReader>) {
            SizeSources sources;
            a(sources);
            set(std::move(sources));
        } else {
            a(sources_ ? *sources_ : SizeSources());
        }
    }

 private:
    void set(SizeSources sources);

    static constexpr double infinity = std::numeric_limits<double>::infinity();

    double max_volume_ = 0;                       // of the constant; 0: none
    double edge_ = infinity;                      // of the constant, on average
    double edge_factor_ = 1;                      // factor of the sources, see coarser()
    std::shared_ptr<const SizeSources> sources_;  // not empty; null: none
};

/// Whether a tetrahedron with these corners should be divided. If the field is constant, its volume must exceed the
/// bound; else its mean edge must be longer than wanted at its centroid, by a share that makes most edges as long as
/// wanted.
bool is_too_large(const SizeField& size, const std::array<Vec3, 4>& corners);

}  // namespace kerf

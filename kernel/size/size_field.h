// How fine the tetrahedra shall be, and where.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <type_traits>
#include <vector>

#include "core/bytes.h"
#include "size/background_sizes.h"
#include "size/sized_shapes.h"
#include "size/sized_triangles.h"

namespace kerf {

/// All from which a SizeField takes the minimum, besides a constant. Each has its size where it lies, and more by
/// `growth` times the distance elsewhere.
struct SizeSources {
    double growth = 0;  ///< >= 0
    std::vector<SizedBox> boxes;
    std::vector<SizedSphere> spheres;
    std::vector<SizedCylinder> cylinders;
    SizedTriangles triangles;
    std::vector<BackgroundSizes> backgrounds;

    bool empty() const;
    double smallest() const;
    /// The least of all sources and `bound` at a point.
    double size_at(const Vec3& p, double bound) const;

    /// The size that the boxes, spheres and cylinders alone ask for.
    double size_of_solids(const Vec3& p, double bound) const;
    /// The sources without the triangles that have no say in the box, where size_at(p, bound) stays the same.
    SizeSources within(const Eigen::AlignedBox3d& box, double bound) const;

    template <class Archive>
    void archive(Archive& a) {
        a(growth, boxes, spheres, cylinders, triangles, backgrounds);
    }
};

/// Wanted edge length in space: the minimum of a constant and of sources. A value, cheap to copy: serialised with all
/// that it needs, asked at a point. The answer depends on the point alone, and differs between two points by no more
/// than growth() times their distance (but see BackgroundSizes). Thread-safe.
class SizeField {
 public:
    /// Nothing is asked anywhere.
    SizeField() = default;
    /// A field that is the same everywhere: tetrahedra of at most this volume, which is kept as it is. 0: nothing is
    /// asked.
    explicit SizeField(double max_volume);
    /// A constant, 0 for none, and what makes it smaller at places.
    SizeField(double max_volume, SizeSources sources);

    /// Wanted edge length; infinity where nothing is asked. O(log n) with n triangles and cells in the sources, a few
    /// microseconds.
    double at(const Vec3& p) const { return at(p, edge_); }
    /// The least of at(p) and `bound`, which is found sooner where the bound is small.
    double at(const Vec3& p, double bound) const;
    /// Largest volume of a tetrahedron there: that of the regular one with the edge at(p). Infinity where nothing is
    /// asked.
    double max_volume_at(const Vec3& p) const;
    /// No point has a smaller edge length; infinity if nothing is asked.
    double smallest() const;
    bool is_empty() const { return max_volume_ == 0 && is_constant(); }
    /// Whether all points have the same edge length, infinity included.
    bool is_constant() const { return !sources_; }
    /// max_volume_at() where the field is smallest: of a constant field, everywhere. 0: nothing is asked. Volumes are
    /// told in such units where their tetrahedra are counted, see sized_volume().
    double reference_volume() const;
    /// Largest volume by the constant alone; infinity if there is none.
    double constant_volume() const { return max_volume_ > 0 ? max_volume_ : infinity; }
    /// Largest change of at() by distance.
    double growth() const { return sources_ ? edge_factor_ * sources_->growth : 0; }

    /// The field with this constant, and the same sources, in place of its own. 0: no constant.
    SizeField with_constant(double max_volume) const;
    /// The field whose tetrahedra may be `factor` > 0 times as large.
    SizeField coarser(double factor) const;
    /// A field with the same answer, to the last bit, at each point of the box, that has fewer sources to travel with.
    /// Constant or empty where this one is, and only there. O(n) with n triangles in the sources.
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
    double edge_ = infinity;                      // of the constant
    double edge_factor_ = 1;                      // of the sources
    std::shared_ptr<const SizeSources> sources_;  // not empty; null: none
};

/// Whether a tetrahedron with these corners is to be divided: of a constant field if its volume is above the bound;
/// where sizes differ, if its mean edge is longer than wanted at its centroid by a share that makes most edges as long
/// as wanted.
bool is_too_large(const SizeField& size, const std::array<Vec3, 4>& corners);

}  // namespace kerf

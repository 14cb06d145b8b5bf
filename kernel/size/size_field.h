// How fine the tetrahedra shall be, and where.
#pragma once

#include <limits>

#include "core/types.h"

namespace kerf {

/// Wanted edge length in space. A value: copied, serialised, asked at a point. Deterministic and thread-safe.
class SizeField {
 public:
    /// Nothing is asked anywhere.
    SizeField() = default;
    /// The same everywhere: tetrahedra of at most this volume, which is kept as it is. 0: nothing is asked.
    explicit SizeField(double max_volume);

    /// Wanted edge length; infinity where nothing is asked.
    double at(const Vec3& p) const;
    /// Largest volume of a tetrahedron there: that of the regular one with the edge at(p). Infinity where nothing is
    /// asked.
    double max_volume_at(const Vec3& p) const;
    /// No point has a smaller edge length; infinity if nothing is asked.
    double smallest() const { return edge_; }
    bool is_empty() const { return reference_volume() == 0; }
    /// Whether all points have the same edge length, infinity included.
    bool is_constant() const { return true; }
    /// max_volume_at() where the field is smallest: of a constant field, everywhere. 0: nothing is asked. Volumes are
    /// told in such units where their tetrahedra are counted.
    double reference_volume() const { return max_volume_; }

    /// The field whose tetrahedra may be `factor` > 0 times as large.
    SizeField coarser(double factor) const { return SizeField(max_volume_ * factor); }

    template <class Archive>
    void archive(Archive& a) {
        a(max_volume_, edge_);
    }

 private:
    double max_volume_ = 0;  // 0: none
    double edge_ = infinity;

    static constexpr double infinity = std::numeric_limits<double>::infinity();
};

}  // namespace kerf

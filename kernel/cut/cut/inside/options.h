// The options of cuts: the choices of a user, and what follows for one body.
#pragma once

#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "base/core/cancellation.h"
#include "cut/cut/cut.h"
#include "cut/cut/inside/load.h"
#include "surface/size/size_field.h"

namespace kerf {

/// The criterion that places the plane.
enum class Criterion {
    inertia,      ///< across the principal axis of the smallest moment, bisecting the load
    volume,       ///< across a coordinate axis, bisecting the volume
    equidistant,  ///< across a coordinate axis, bisecting the extent
};

/// The choices that hold for all cuts of a run.
struct CutChoices {
    Criterion criterion = Criterion::inertia;
    std::int32_t axis = -1;  ///< coordinate axis 0, 1, 2 of the plane's normal; -1: chosen by the criterion
    ContourMethod contour = ContourMethod::min_cut;
    Balance balance = Balance::work;  ///< the quantity that the halves share evenly
};

/// The options of the cuts of one body.
struct CutOptions : CutChoices {
    CutOptions() = default;
    explicit CutOptions(const CutChoices& choices, SizeField size_of_body = {})
        : CutChoices(choices), size(std::move(size_of_body)) {}

    SizeField size;  ///< of tetrahedra; it bounds interface triangles, and weighs the load
    double volume_weight = LoadModel().volume_weight;
    std::shared_ptr<const std::vector<VolumeSample>> samples;  ///< of the body, see of() and LoadModel::samples
    double load_window = 0.1;                                  ///< planes whose load is further off are tried last
    std::int32_t plane_steps = 6;                              ///< on either side, per axis
    std::int32_t repairs = 9;                                  ///< rounds of local repair per plane
    double good_dihedral_deg = 25;  ///< thresholds of InterfaceQuality below which a cut is soft
    double good_angle_deg = 20;
    double good_gap_rel = 0.2;
    bool has_coarse_interfaces = false;           ///< interfaces have their contours alone, whatever the size
    std::int64_t max_interface_points = 1 << 29;  ///< with more, bisect() throws Error(memory)
    CancellationCheck check_cancelled;            ///< called during every cut

    /// The longest wanted edge of an interface at a point; infinity: any. If the size is the same everywhere, it is a
    /// little larger than the edge of the largest wanted tetrahedron; sizes that differ by place are means, which a
    /// bound a little below them gives.
    double max_interface_edge(const Vec3& p) const {
        if (has_coarse_interfaces) return std::numeric_limits<double>::infinity();
        return (size.is_constant() ? 1.1 : 0.95) * size.at(p);
    }
    /// Returns the options for this body, whose load samples are included, see LoadModel::of().
    CutOptions of(const Surface& surface) const {
        CutOptions options = *this;
        if (bisected_load().depends_on_place()) options.samples = load().of(surface).samples;
        return options;
    }
    /// Returns the load of the body.
    LoadModel load() const { return {balance, size, volume_weight, samples}; }
    /// Returns the load that the criterion bisects: the volume for Criterion::volume, else load().
    LoadModel bisected_load() const {
        return {criterion == Criterion::volume ? Balance::volume : balance, size, volume_weight, samples};
    }
};

}  // namespace kerf

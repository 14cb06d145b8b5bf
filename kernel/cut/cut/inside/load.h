// The load of a body: the work of meshing it, and its share below a plane.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "cut/cut/cut.h"
#include "surface/size/volume_samples.h"

namespace kerf {

/// The quantity that the two halves of a cut share evenly. `inertia` is the second moment of the volume about the plane
/// through the centroid of the body's vertices that is parallel to the cut; such halves get leaves by volume.
enum class Balance { nodes, faces, volume, inertia, work };

/// The work of meshing a body: F + w times the integral of dV / a, where F is the number of facets, V the volume and a
/// the wanted volume of a tetrahedron; F alone if no size is wanted. w depends on the mesher. The integral is V / a if
/// a is the same everywhere, else that of sample_volume().
struct LoadModel {
    Balance balance = Balance::work;
    SizeField size = {};         ///< a
    double volume_weight = 0.1;  ///< w: time of a wanted tetrahedron inside over that of a facet; of the default mesher

    /// Samples of the body, if the work depends on the place; see of().
    std::shared_ptr<const std::vector<VolumeSample>> samples = {};

    /// Returns the load of a whole body. `volume` is the result of volume_of().
    double load(double vertices, double facets, double volume) const;
    /// Returns the volume that counts for the load of a body, 0 if none does. `enclosed` is the body's volume.
    double volume_of(const SurfaceArrays& surface, double enclosed) const;
    /// Returns the model with the samples of this body, for a caller who asks for the load below many planes.
    LoadModel of(const Surface& surface) const;
    bool depends_on_place() const { return balance == Balance::work && !size.is_constant(); }
    bool needs_volume() const {
        return balance == Balance::volume || balance == Balance::inertia ||
               (balance == Balance::work && !size.is_empty());
    }
};

/// The load below the planes of one direction. Facets count by their centroids; the volume is exact, or sampled if
/// sizes differ by place.
class LoadProfile {
 public:
    /// Heights are measured along `plane.normal` from `plane.origin`, second moments about `plane`. The surface must
    /// not be empty.
    LoadProfile(const Surface& surface, const Plane& plane, const LoadModel& model);

    /// Returns the fraction of the whole load below the given height. O(#F).
    double fraction_below(double height) const;
    /// Returns the fractions below many heights. O(#V + #F + n m) for n heights and m facets between the lowest and the
    /// highest of them.
    std::vector<double> fractions_below(const std::vector<double>& heights) const;
    /// Returns the height below which the given fraction, in [0, 1], of the load lies. Expected O(#V + #F).
    double bisect(double fraction) const;
    double lowest() const { return lowest_; }
    double highest() const { return highest_; }

 private:
    // A facet whose share of the volume integral counts.
    struct Item {
        double low, mid, high;  // heights of the facet's vertices, ascending
        double area_z;          // area times the normal's height component
        double centroid;
        double potential;  // mean over the facet
    };
    // The sum of items that lie wholly below all heights still in question: their integral is linear in the potential
    // of the height.
    struct Below {
        double count = 0;
        double area_z = 0;
        double integral = 0;  // of the potential over area_z
        void add(const Item& item);
    };
    void find_items(const Surface& surface, const Plane& plane, const Array<Vertex, double>& height);
    void find_centroids(const Surface& surface, const Array<Vertex, double>& height);
    double load_of(double count, double integral, double height) const;
    double bisect_count(double fraction) const;
    double potential(double height) const;
    double mean_potential(double a, double b, double c) const;
    double load_below(std::span<const Item> items, const Below& below, double height) const;
    double sampled_volume_below(double height) const;
    // Drops from `open` the items that matter for no height between `low` and `high`: those above, and those below,
    // which are added to `below`.
    static void settle(double low, double high, std::vector<Item>& open, Below& below);

    LoadModel model_;
    std::vector<Item> items_;        // empty if the load does not depend on the volume
    std::vector<double> centroids_;  // used then: heights of the facets, or of the vertices if nodes are balanced
    std::vector<std::pair<double, double>> samples_;  // heights, ascending, and the sum of volume over wanted volume up
                                                      // to each
    double lowest_ = 0, highest_ = 0, total_ = 0;
};

}  // namespace kerf

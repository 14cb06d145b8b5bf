// How much work lies below a plane.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "cut/cut.h"
#include "size/volume_samples.h"

namespace kerf {

/// What the two halves of a cut should have alike. `inertia`: the second moment of the volume about the plane through
/// the centroid of the body's vertices that is parallel to the cut; such halves get leaves by volume.
enum class Balance { nodes, faces, volume, inertia, work };

/// Work of meshing a body: F + w times the integral of dV / a, F facets, V volume, a the wanted volume of a
/// tetrahedron; F alone where none is asked. w depends on the mesher. The integral is V / a where a is the same
/// everywhere, else that of sample_volume().
struct LoadModel {
    Balance balance = Balance::work;
    SizeField size = {};         ///< a
    double volume_weight = 0.1;  ///< w: time of a wanted tetrahedron inside over that of a facet; of the default mesher

    /// Samples of the body in question, if the work depends on the place; see of().
    std::shared_ptr<const std::vector<VolumeSample>> samples = {};

    /// The load of a whole body; `volume`: what volume_of() says of it.
    double load(double vertices, double facets, double volume) const;
    /// The volume of a body that counts; 0 where none does. `enclosed` is its volume.
    double volume_of(const SurfaceArrays& surface, double enclosed) const;
    /// The model that knows the samples of this body, for who asks it of many planes.
    LoadModel of(const Surface& surface) const;
    bool depends_on_place() const { return balance == Balance::work && !size.is_constant(); }
    bool needs_volume() const {
        return balance == Balance::volume || balance == Balance::inertia ||
               (balance == Balance::work && !size.is_empty());
    }
};

/// Load below the planes of one direction. Facets count by their centroid; volume is exact, unless sizes differ: then
/// it comes in samples.
class LoadProfile {
 public:
    /// Heights are measured along `plane.normal` from `plane.origin`, second moments about `plane`. The surface must
    /// not be empty.
    LoadProfile(const Surface& surface, const Plane& plane, const LoadModel& model);

    /// Fraction of the whole load below the given height. O(#F).
    double fraction_below(double height) const;
    /// The fractions below many heights. O(#V + #F + n m) with m facets between the lowest and the highest of n
    /// heights.
    std::vector<double> fractions_below(const std::vector<double>& heights) const;
    /// Height below which the given fraction, in [0, 1], of the load lies. Expected O(#V + #F).
    double bisect(double fraction) const;
    double lowest() const { return lowest_; }
    double highest() const { return highest_; }

 private:
    // A facet whose part of the volume counts.
    struct Item {
        double low, mid, high;  // heights of the facet's vertices, ascending
        double area_z;          // area times the normal's height component
        double centroid;
        double potential;  // mean over the facet
    };
    // Items that lie wholly below every height still in question: their integral is linear in that of the height.
    struct Below {
        double count = 0;
        double area_z = 0;
        double integral = 0;  // of the potential over area_z
        void add(const Item& item);
    };
    void take_items(const Surface& surface, const Plane& plane, const std::vector<double>& height);
    void take_centroids(const Surface& surface, const std::vector<double>& height);
    double load_of(double count, double integral, double height) const;
    double bisect_count(double fraction) const;
    double potential(double height) const;
    double mean_potential(double a, double b, double c) const;
    double load_below(std::span<const Item> items, const Below& below, double height) const;
    double sampled_volume_below(double height) const;
    // Drops from `open` what matters to no height between the two: what lies above, and what lies below, which is added
    // to `below`.
    static void settle(double low, double high, std::vector<Item>& open, Below& below);

    LoadModel model_;
    std::vector<Item> items_;        // none if their volume does not count
    std::vector<double> centroids_;  // then: heights of the facets, or of the vertices if nodes are balanced
    std::vector<std::pair<double, double>> samples_;  // heights, ascending, and the sized volume up to there
    double lowest_ = 0, highest_ = 0, total_ = 0;
};

}  // namespace kerf

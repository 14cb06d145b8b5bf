#include "fill/improve/inside/best_place.h"

#include "base/core/mixed_bits.h"

namespace kerf {

namespace {

constexpr int most_steps = 24, most_failures = 8;  // failures one after the other
constexpr double first_step = 0.3;                 // share of the distance to the nearest vertex
constexpr double longer = 1.4, shorter = 0.8;

class Directions {
 public:
    explicit Directions(std::int32_t seed) : numbers_(static_cast<std::uint64_t>(seed) * 2 + 1) {}
    // Returns a vector in the cube from -1 to 1.
    Vec3 next() {
        const double x = number(), y = number(), z = number();
        return {x, y, z};
    }

 private:
    double number() { return (numbers_.next() >> 33) * 0x1p-30 - 1; }
    RandomSequence numbers_;
};

}  // namespace

// Returns the worst badness, or some number that is not below the limit if the worst is not. A face that has failed
// moves to the front, to be asked early the next time.
double BestPlace::worst_at(const ImprovedMesh& mesh, const Vec3& p, double limit, double excess) {
    double worst = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < faces_.size(); ++i) {
        worst = std::max(worst, mesh.badness_of(p, faces_[i].a, faces_[i].b, faces_[i].c, excess));
        if (worst < limit) continue;
        std::swap(faces_[i], faces_[i / 2]);
        return worst;
    }
    return worst;
}

BestPlace::Place BestPlace::search(const ImprovedMesh& mesh, Place best, double excess, std::int32_t seed) {
    Vec3 towards_centre = Vec3::Zero();
    double distance_sq = std::numeric_limits<double>::infinity();
    for (const Face& face : faces_) {
        towards_centre += (face.a - best.at) + (face.b - best.at) + (face.c - best.at);
        distance_sq = std::min({distance_sq, (face.a - best.at).squaredNorm(), (face.b - best.at).squaredNorm(),
                                (face.c - best.at).squaredNorm()});
    }
    double step = first_step * std::sqrt(distance_sq);
    Directions directions(seed);
    Vec3 direction = towards_centre.normalized();
    int failures = 0;
    for (int i = 0; i < most_steps && failures < most_failures; ++i) {
        const Vec3 p = best.at + step * direction;
        const double badness = worst_at(mesh, p, best.badness, excess);
        if (badness < best.badness) {
            best = {p, badness};
            step *= longer;
            failures = 0;
        } else {
            step *= shorter;
            ++failures;
            direction = directions.next();
        }
    }
    return best;
}

}  // namespace kerf

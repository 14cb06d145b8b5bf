// Errors of elements are left alike per cell (Ladeveze, Coffignal and Pelle 1986, ladeveze1986). Notation: p order of
// the elements, h edge length, e error of a cell. With e^2 ~ h^2p in a cell that is divided and a number of cells ~
// h^-3, the fewest cells for a sum of e^2 have h ~ (h0^2p / (e^2 / volume))^(1 / (2p + 3)) of the present h0.
#include "solve/equations/error_sizes.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <tuple>

#include <Eigen/Geometry>

#include "base/core/regular_tet.h"
#include "base/geometry/box.h"

namespace kerf {

namespace {

constexpr double cube_width = 2;  // the most, in edges of the cells; at least half of it
constexpr int deepest = 18;
constexpr double least_ratio = 0.25, largest_ratio = 2;  // of a length to the present one
constexpr double more_cells = 4;                         // limit for the next mesh, in multiples of the present one
constexpr double below_target = 0.9;                     // so that the mesh after it is not needed
constexpr double edge_of_cells = 1.16;                   // mean of a mesh, over that of the regular tetrahedron
constexpr double steps_of_two = 16;                      // rounded lengths in a factor of two

using Corner = std::array<std::int32_t, 3>;

/// A cube of a grid that is 2^level cubes wide.
struct Cube {
    std::int32_t level = 0;
    Corner place{};
    bool operator<(const Cube& o) const { return std::tie(level, place) < std::tie(o.level, o.place); }
};

/// The cells with their centroids in a cube.
struct CubeSum {
    Cube cube;
    double volume = 0, cells = 0;
    std::vector<double> squared_errors;  // of each field

    template <class Archive>
    void archive(Archive& a) {
        a(cube.level, cube.place, volume, cells, squared_errors);
    }
    void add(const CubeSum& o) {
        volume += o.volume;
        cells += o.cells;
        for (std::size_t i = 0; i < squared_errors.size(); ++i) squared_errors[i] += o.squared_errors[i];
    }
    double edge() const { return regular_tet_edge(volume / cells); }
};

/// All cubes of a mesh, which are as fine as its cells.
class Cubes {
 public:
    Cubes(const Vec3& low, double width) : low_(low), width_(width) {}

    Cube at(const Vec3& p, double edge) const {
        const double levels = std::ceil(std::log2(width_ / (cube_width * edge)));
        Cube cube{static_cast<std::int32_t>(std::clamp(levels, 0.0, double{deepest})), {}};
        const double count = 1 << cube.level;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            cube.place[axis] = std::clamp(std::floor((p[axis] - low_[axis]) / width_ * count), 0.0, count - 1);
        }
        return cube;
    }
    Vec3 corner(std::int32_t level, const Corner& place) const {
        return low_ + Vec3(place[0], place[1], place[2]) * (width_ / (1 << level));
    }

 private:
    Vec3 low_;
    double width_;
};

Cubes cubes_of(const FeSpace& space, Communicator& ranks) {
    Box box = box_around(space.points());
    for (const Vec3& low : all_gather(ranks, Vec3(box.min()))) box.min() = box.min().cwiseMin(low);
    for (const Vec3& high : all_gather(ranks, Vec3(box.max()))) box.max() = box.max().cwiseMax(high);
    return {box.min(), box.sizes().maxCoeff()};
}

std::vector<CubeSum> merged(std::vector<CubeSum> sums) {
    std::stable_sort(sums.begin(), sums.end(), [](const CubeSum& a, const CubeSum& b) { return a.cube < b.cube; });
    std::vector<CubeSum> result;
    for (CubeSum& sum : sums) {
        const bool is_new = result.empty() || result.back().cube < sum.cube;
        if (is_new)
            result.push_back(std::move(sum));
        else
            result.back().add(sum);
    }
    return result;
}

// The cubes of all ranks, ascending.
std::vector<CubeSum> sum_errors(const FeSpace& space, const std::vector<const StressField*>& fields, const Cubes& cubes,
                                Communicator& ranks) {
    std::vector<CubeSum> sums;
    for (std::size_t p = 0; p < space.parts().size(); ++p) {
        const TetMesh& mesh = space.parts()[p].mesh;
        std::vector<CubeSum> of_part;
        for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
            const double volume = space.element(p, t).volume();
            Vec3 centroid = Vec3::Zero();
            for (const std::int32_t corner : mesh.tets[t]) centroid += mesh.vertices[corner] / 4;
            CubeSum& sum = of_part.emplace_back();
            sum.cube = cubes.at(centroid, regular_tet_edge(volume));
            sum.volume = volume;
            sum.cells = 1;
            for (const StressField* field : fields)
                sum.squared_errors.push_back(field->parts[p].error[t] * field->parts[p].error[t]);
        }
        of_part = merged(std::move(of_part));
        std::move(of_part.begin(), of_part.end(), std::back_inserter(sums));
    }
    return merged(gather_items(ranks, merged(std::move(sums))));
}

// Lowers the lengths, as shares of the present ones of each cube, to those that a field asks for.
void lower_to_field(const std::vector<CubeSum>& sums, std::size_t field, double squared_aim, int order,
                    std::vector<double>& ratios) {
    const double p = order, exponent = 1 / (2 * p + 3);
    // h^(2p+3) = C h0^2p volume / e^2, so that e^2 of the next mesh is that of this one times (h / h0)^2p.
    const auto share = [&](const CubeSum& sum) {
        const double density = sum.squared_errors[field] / sum.volume * std::pow(sum.edge(), 3);
        return density > 0 ? std::pow(density, -exponent) : INFINITY;
    };
    double left = 0;  // with C = 1
    for (const CubeSum& sum : sums)
        if (const double s = share(sum); std::isfinite(s)) left += sum.squared_errors[field] * std::pow(s, 2 * p);
    if (!(left > 0)) return;
    const double scale = std::pow(squared_aim / left, 1 / (2 * p));
    for (std::size_t i = 0; i < sums.size(); ++i) ratios[i] = std::min(ratios[i], scale * share(sums[i]));
}

double rounded(double length) { return std::exp2(std::round(steps_of_two * std::log2(length)) / steps_of_two); }

// The mesh of all cubes, six tetrahedra each. A corner has the geometric mean of the lengths of the cubes around it
// that are as large.
class CubeMesh {
 public:
    explicit CubeMesh(const Cubes& cubes) : cubes_(cubes) {}

    void add(const Cube& cube, double length) {
        std::array<std::int32_t, 8> corners{};
        for (std::size_t i = 0; i < 8; ++i) {
            Corner place = cube.place;
            for (std::size_t axis = 0; axis < 3; ++axis) place[axis] += i >> axis & 1;
            corners[i] = number(cube.level, place);
            logs_[corners[i]] += std::log2(length);
            counts_[corners[i]] += 1;
        }
        // Six tetrahedra along the diagonal from corner 0 to 7, one for each order of the axes.
        constexpr std::array<std::array<int, 2>, 6> ways = {{{1, 3}, {3, 2}, {2, 6}, {6, 4}, {4, 5}, {5, 1}}};
        for (const auto& [a, b] : ways) mesh_.tets.push_back({corners[0], corners[a], corners[b], corners[7]});
    }
    SizedMesh take() {
        for (std::size_t v = 0; v < logs_.size(); ++v) mesh_.size.push_back(std::exp2(logs_[v] / counts_[v]));
        return std::move(mesh_);
    }

 private:
    std::int32_t number(std::int32_t level, const Corner& place) {
        const auto [found, is_new] = numbers_.try_emplace(Cube{level, place}, mesh_.vertices.size());
        if (is_new) {
            mesh_.vertices.push_back(cubes_.corner(level, place));
            logs_.push_back(0);
            counts_.push_back(0);
        }
        return found->second;
    }

    const Cubes& cubes_;
    std::map<Cube, std::int32_t> numbers_;  // of corners
    std::vector<double> logs_, counts_;
    SizedMesh mesh_;
};

}  // namespace

double error_of_next_mesh(double relative_error, double target, int order) {
    return std::max(below_target * target, relative_error * std::pow(more_cells, -order / 3.0));
}

SizedMesh sizes_for_error(const FeSpace& space, const std::vector<const StressField*>& fields, double aim,
                          Communicator& ranks) {
    const Cubes cubes = cubes_of(space, ranks);
    const std::vector<CubeSum> sums = sum_errors(space, fields, cubes, ranks);
    std::vector<double> ratios(sums.size(), largest_ratio);
    for (std::size_t field = 0; field < fields.size(); ++field) {
        const EnergyNorms& norms = fields[field]->norms;
        lower_to_field(sums, field, std::pow(aim * std::hypot(norms.solution, norms.error), 2), space.order(), ratios);
    }
    CubeMesh mesh(cubes);
    for (std::size_t i = 0; i < sums.size(); ++i)
        mesh.add(sums[i].cube, rounded(std::max(ratios[i], least_ratio) * edge_of_cells * sums[i].edge()));
    return mesh.take();
}

}  // namespace kerf

#include "solve/elastic_problem.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SVD>

#include "core/error.h"

namespace kerf {

namespace {

constexpr std::uint8_t no_material = 255;

// The numbers of the materials of parts that are named, of regions, of bodies, and of all else.
struct MaterialPlaces {
    std::map<NodeId, std::uint8_t> of_part;
    std::vector<std::uint8_t> of_region;
    std::vector<std::uint8_t> of_body;
    std::uint8_t of_rest = no_material;

    std::uint8_t at(NodeId part, RegionIndex region, std::int32_t body) const {
        if (const auto named = of_part.find(part); named != of_part.end()) return named->second;
        const auto r = static_cast<std::size_t>(region.value());
        if (r < of_region.size() && of_region[r] != no_material) return of_region[r];
        return of_body[body] != no_material ? of_body[body] : of_rest;
    }
};

class ProblemMaker {
 public:
    ProblemMaker(const FeSpace& space, const MeshOutline& outline, const ElasticCase& wanted)
        : space_(space),
          outline_(outline),
          wanted_(wanted),
          selector_(space, outline.patch_names),
          bodies_(find_bodies(space)) {}

    ElasticProblem make() {
        problem_ = make_free_problem(space_, wanted_.materials.front().material);
        choose_materials();
        hold();
        require_supported(problem_, bodies_);
        for (const std::string& name : wanted_.names()) add_case(name);
        return std::move(problem_);
    }

 private:
    void choose_materials();
    void place_material(const MaterialUse& use, MaterialPlaces& places) const;
    void place_in_regions(const MaterialUse& use, const std::vector<std::string>& regions,
                          MaterialPlaces& places) const;
    std::vector<char> bodies_at(const std::vector<std::string>& patches, const std::string& who) const;
    void hold();
    // Of the case that was added last.
    void add_case(const std::string& name);
    void add_force(std::size_t p, std::int32_t node, const Vec3& force);
    void add_load(const Load& load);
    void add_force_at(std::int64_t row, const Vec3& force);
    void add_weight();

    const FeSpace& space_;
    const MeshOutline& outline_;
    const ElasticCase& wanted_;
    SurfaceSelector selector_;
    SpaceBodies bodies_;
    ElasticProblem problem_;
};

// Bodies with a triangle of these patches.
std::vector<char> ProblemMaker::bodies_at(const std::vector<std::string>& patches, const std::string& who) const {
    SurfaceSelection where;
    where.patches = patches;
    std::vector<std::int32_t> found(bodies_.count, 0);
    for (const SurfaceFacet& facet : selector_.facets(where, who))
        found[bodies_.of_node[space_.nodes_of_facet(facet.part, facet.facet)[0]]] = 1;
    space_.ranks().all_reduce(std::span(found), Reduction::largest);
    return {found.begin(), found.end()};
}

void ProblemMaker::choose_materials() {
    if (wanted_.materials.size() >= no_material) throw Error(ErrorCode::usage, "A case may have up to 254 materials.");
    problem_.materials.clear();
    MaterialPlaces places;
    places.of_body.resize(bodies_.count, no_material);
    places.of_region.resize(outline_.region_names.size(), no_material);
    for (const MaterialUse& use : wanted_.materials) {
        problem_.materials.push_back(use.material);
        place_material(use, places);
    }
    if (problem_.materials.size() == 1 && places.of_rest == 0) return;
    std::int64_t without = 0;
    for (std::size_t p = 0; p < space_.parts().size(); ++p) {
        const Part& part = space_.parts()[p];
        std::vector<std::uint8_t>& of_tet = problem_.material_of_tet.emplace_back();
        for (std::size_t t = 0; t < part.mesh.tets.size(); ++t) {
            of_tet.push_back(places.at(part.id, part.region_of(static_cast<std::int32_t>(t)),
                                       bodies_.of_node[space_.nodes_of(p, t)[0]]));
            if (of_tet.back() == no_material) ++without;
        }
    }
    without = space_.ranks().all_reduce(without, Reduction::sum);
    if (without > 0)
        throw Error(
            ErrorCode::usage,
            fmt::format("{} tetrahedra have no material. Add one without region, parts and patch: it is for the "
                        "rest.",
                        without));
}

void ProblemMaker::place_in_regions(const MaterialUse& use, const std::vector<std::string>& regions,
                                    MaterialPlaces& places) const {
    const std::vector<std::string>& names = outline_.region_names;
    for (const std::string& wanted : regions) {
        const auto found = std::find(names.begin(), names.end(), wanted);
        if (found == names.end())
            throw Error(
                ErrorCode::usage,
                fmt::format("Material '{}' names the region '{}', but {}.", use.material.name, wanted,
                            names.empty() ? std::string("the mesh has no regions with names")
                                          : fmt::format("those of the mesh are '{}'", fmt::join(names, "', '"))));
        std::uint8_t& of_region = places.of_region[static_cast<std::size_t>(found - names.begin())];
        if (of_region != no_material)
            throw Error(ErrorCode::usage, fmt::format("The region '{}' has two materials: '{}' and '{}'.", wanted,
                                                      problem_.materials[of_region].name, use.material.name));
        of_region = static_cast<std::uint8_t>(problem_.materials.size() - 1);
    }
}

// Where the material that was added last is.
void ProblemMaker::place_material(const MaterialUse& use, MaterialPlaces& places) const {
    const std::uint8_t number = problem_.materials.size() - 1;
    const std::string who = fmt::format("Material '{}'", use.material.name);
    for (const NodeId id : use.parts) {
        if (std::none_of(outline_.parts.begin(), outline_.parts.end(), [&](const PartExtent& e) { return e.id == id; }))
            throw Error(ErrorCode::usage, fmt::format("{} names part {}, which this mesh does not have.", who, id));
        if (!places.of_part.emplace(id, number).second)
            throw Error(ErrorCode::usage, fmt::format("Part {} has two materials.", id));
    }
    if (!use.patches.empty()) {
        const std::vector<char> here = bodies_at(use.patches, who);
        for (std::size_t b = 0; b < here.size(); ++b) {
            if (!here[b]) continue;
            if (places.of_body[b] != no_material)
                throw Error(ErrorCode::usage,
                            fmt::format("The body at patch '{}' has two materials: '{}' and '{}'.", use.patches.front(),
                                        problem_.materials[places.of_body[b]].name, use.material.name));
            places.of_body[b] = number;
        }
    }
    const std::vector<std::string>& regions = outline_.region_names;
    const bool is_name_of_region = std::find(regions.begin(), regions.end(), use.material.name) != regions.end();
    if (!use.says_where() && is_name_of_region) return place_in_regions(use, {use.material.name}, places);
    place_in_regions(use, use.regions, places);
    if (use.says_where()) return;
    if (places.of_rest != no_material)
        throw Error(ErrorCode::usage,
                    fmt::format("Materials '{}' and '{}' are for everything. Say with region, parts or "
                                "patch where one of them is.",
                                problem_.materials[places.of_rest].name, use.material.name));
    places.of_rest = number;
}

// A part may have a node of a patch without a triangle of it: all who have the node are told.
void ProblemMaker::hold() {
    for (std::int32_t s = 0; s < std::ssize(wanted_.supports); ++s) {
        const Support& support = wanted_.supports[s];
        const auto hold_node = [&](std::int32_t node) {
            for (std::size_t c = 0; c < 3; ++c) {
                std::int32_t& of = problem_.support_of[3 * node + c];
                if (support.displacement[c]) of = std::min(of, s);
            }
        };
        problem_.supports.push_back(support.name);
        if (support.where.point) {
            const std::int64_t row = selector_.nearest_vertex(*support.where.point);
            for (std::int32_t n = 0; n < space_.node_count(); ++n)
                if (space_.row_of(n) == row) hold_node(n);
            continue;
        }
        for (const SurfaceFacet& facet : selector_.facets(support.where, fmt::format("Support '{}'", support.name)))
            for (const std::int32_t node : space_.nodes_of_facet(facet.part, facet.facet))
                if (node >= 0) hold_node(node);
    }
    space_.exchange().share_smallest(std::span(problem_.support_of), 3);
    for (std::size_t dof = 0; dof < problem_.support_of.size(); ++dof)
        if (problem_.is_held(dof))
            problem_.prescribed[dof] = *wanted_.supports[problem_.support_of[dof]].displacement[dof % 3];
}

// On cells of the part `p`.
void ProblemMaker::add_force(std::size_t p, std::int32_t node, const Vec3& force) {
    for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t dof = 3 * node + c;
        problem_.forces.back()[dof] += force[c];
        if (problem_.is_held(dof))
            problem_.held_forces.back().add(problem_.support_of[dof], space_.region_of(p), c, force[c]);
    }
}

// The part that owns the node, of those that have it, takes the force.
void ProblemMaker::add_force_at(std::int64_t row, const Vec3& force) {
    const std::int64_t own = row - space_.first_row();
    if (own < 0 || own >= space_.owned_count()) return;
    for (std::size_t p = 0; p < space_.parts().size(); ++p) {
        const std::vector<std::int32_t>& nodes = space_.nodes_of_parts()[p].of_vertex;
        if (std::find(nodes.begin(), nodes.end(), own) != nodes.end()) return add_force(p, own, force);
    }
}

void ProblemMaker::add_load(const Load& load) {
    const std::string who = fmt::format("Load '{}'", load.name);
    if (load.where.point) return add_force_at(selector_.nearest_vertex(*load.where.point), *load.force);
    const std::vector<SurfaceFacet> facets = selector_.facets(load.where, who);
    double area = 0;
    for (const SurfaceFacet& facet : facets) area += facet.area;
    area = space_.ranks().all_reduce(area, Reduction::sum);
    for (const SurfaceFacet& facet : facets) {
        const Vec3 traction = load.pressure   ? Vec3(-*load.pressure * facet.normal)
                              : load.traction ? *load.traction
                                              : Vec3(*load.force / area);
        const auto nodes = space_.nodes_of_facet(facet.part, facet.facet);
        const TriangleShares shares = node_areas(facet.area, space_.order());
        for (std::size_t i = 0; i < nodes.size(); ++i)
            if (nodes[i] >= 0) add_force(facet.part, nodes[i], shares[i] * traction);
    }
}

void ProblemMaker::add_weight() {
    for_all_tets(space_, [&](std::size_t p, std::size_t t) {
        const TetElement::Shapes volumes = space_.element(p, t).node_volumes();
        const auto nodes = space_.nodes_of(p, t);
        const Vec3 density = problem_.material(p, t).density * *wanted_.gravity;
        for (int n = 0; n < element_nodes(space_.order()); ++n) add_force(p, nodes[n], volumes[n] * density);
    });
}

void ProblemMaker::add_case(const std::string& name) {
    problem_.cases.push_back(name);
    problem_.forces.emplace_back(3 * space_.node_count(), 0);
    problem_.held_forces.emplace_back(problem_.supports.size(), space_.region_count());
    for (const Load& load : wanted_.loads)
        if (load.load_case.empty() || load.load_case == name) add_load(load);
    if (wanted_.gravity) add_weight();
}

using Motion = Eigen::Matrix<double, 6, 1>;  // translation, then rotation about the body's middle, in radians x scale
using MotionMatrix = Eigen::Matrix<double, 6, 6>;

// What is left of motions without the others, in words. `motions`: orthonormal columns that nothing prevents.
std::string motions_text(const Eigen::MatrixXd& motions, const Vec3& middle, double scale) {
    if (motions.cols() == 6) return "it is not held at all";
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(motions.bottomRows(3), Eigen::ComputeFullV);
    const Eigen::MatrixXd sorted = motions * svd.matrixV();  // those that turn most come first
    std::string text;
    const auto direction = [](const Vec3& v) {
        Eigen::Index largest = 0;
        v.cwiseAbs().maxCoeff(&largest);
        const Vec3 unit = (v[largest] < 0 ? -v : v).normalized();
        const auto shown = [](double x) { return std::abs(x) < 5e-4 ? 0.0 : x; };
        return fmt::format("({:.3g}, {:.3g}, {:.3g})", shown(unit.x()), shown(unit.y()), shown(unit.z()));
    };
    for (Eigen::Index i = 0; i < sorted.cols(); ++i) {
        const Vec3 translation = sorted.col(i).head<3>(), rotation = sorted.col(i).tail<3>() / scale;
        if (!text.empty()) text += ", and to ";
        if (rotation.norm() * scale < 1e-6) {
            text += fmt::format("move along {}", direction(translation));
            continue;
        }
        const Vec3 on_axis = middle + rotation.cross(translation) / rotation.squaredNorm();
        text += fmt::format("turn about {} through ({:.6g}, {:.6g}, {:.6g})", direction(rotation), on_axis.x(),
                            on_axis.y(), on_axis.z());
    }
    return "it is free to " + text;
}

}  // namespace

ElasticProblem make_free_problem(const FeSpace& space, const Material& material) {
    ElasticProblem problem;
    problem.space = &space;
    problem.materials = {material};
    problem.support_of.assign(3 * space.node_count(), ElasticProblem::free);
    problem.prescribed.assign(3 * space.node_count(), 0);
    return problem;
}

ElasticProblem make_problem(const FeSpace& space, const MeshOutline& outline, const ElasticCase& wanted) {
    return ProblemMaker(space, outline, wanted).make();
}

void require_supported(const ElasticProblem& problem, const SpaceBodies& bodies) {
    const FeSpace& space = *problem.space;
    const std::int32_t count = bodies.count;
    std::vector<double> middles(4 * count, 0), scales(count, 0), products(36 * count, 0);
    for (std::int32_t n = 0; n < space.owned_count(); ++n) {
        double* sum = &middles[4 * bodies.of_node[n]];
        for (int c = 0; c < 3; ++c) sum[c] += space.points()[n][c];
        sum[3] += 1;
    }
    space.ranks().all_reduce(std::span(middles), Reduction::sum);
    const auto middle_of = [&](std::int32_t b) -> Vec3 {
        return Vec3(middles[4 * b], middles[4 * b + 1], middles[4 * b + 2]) / middles[4 * b + 3];
    };
    for (std::int32_t n = 0; n < space.owned_count(); ++n) {
        const std::int32_t b = bodies.of_node[n];
        scales[b] = std::max(scales[b], (space.points()[n] - middle_of(b)).norm());
    }
    space.ranks().all_reduce(std::span(scales), Reduction::largest);
    for (std::int32_t n = 0; n < space.owned_count(); ++n)
        for (int c = 0; c < 3; ++c) {
            if (!problem.is_held(3 * n + c)) continue;
            const std::int32_t b = bodies.of_node[n];
            const Vec3 axis = Vec3::Unit(c), arm = (space.points()[n] - middle_of(b)) / scales[b];
            Motion held;
            held << axis, arm.cross(axis);  // component c of the motion of the node
            Eigen::Map<MotionMatrix>(&products[36 * b]) += held * held.transpose();
        }
    space.ranks().all_reduce(std::span(products), Reduction::sum);
    for (std::int32_t b = 0; b < count; ++b) {
        const MotionMatrix product = Eigen::Map<const MotionMatrix>(&products[36 * b]);
        const Eigen::SelfAdjointEigenSolver<MotionMatrix> solver(product);
        const double largest = solver.eigenvalues()[5];
        Eigen::Index left = 0;
        while (left < 6 && solver.eigenvalues()[left] <= 1e-10 * largest) ++left;
        if (left == 0) continue;
        const Vec3 middle = middle_of(b);
        throw Error(ErrorCode::usage,
                    fmt::format("The supports leave {} around ({:.6g}, {:.6g}, {:.6g}) free: {}. Add a [[support]] "
                                "against that.",
                                count == 1 ? "the body" : "a body", middle.x(), middle.y(), middle.z(),
                                motions_text(solver.eigenvectors().leftCols(left), middle, scales[b])));
    }
}

}  // namespace kerf

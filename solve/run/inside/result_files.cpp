#include "solve/run/inside/result_files.h"

#include <numeric>

#include <fmt/format.h>

namespace kerf {

namespace {

// Stress and von Mises stress of points or cells.
void add_stresses(const std::vector<SymmetricTensor>& stresses, PartValues::Of of, const std::string& suffix,
                  std::vector<PartValues>& all) {
    std::vector<float> tensors, mises;
    tensors.reserve(6 * stresses.size());
    mises.reserve(stresses.size());
    for (const SymmetricTensor& stress : stresses) {
        for (const double value : stress) tensors.push_back(value);
        mises.push_back(von_mises(stress));
    }
    all.push_back({"Stress" + suffix, of, 6, std::move(tensors)});
    all.push_back({"VonMises" + suffix, of, 1, std::move(mises)});
}

std::vector<double> vectors_at_points(const ElasticProblem& problem, const std::vector<double>& of_nodes,
                                      std::size_t p) {
    std::vector<double> vectors;
    const auto add = [&](const std::vector<std::int32_t>& nodes) {
        for (const std::int32_t node : nodes)
            for (std::size_t c = 0; c < 3; ++c) vectors.push_back(of_nodes[3 * node + c]);
    };
    const PartFeNodes& nodes = problem.space->nodes_of_parts()[p];
    add(nodes.of_vertex);
    if (problem.space->parts()[p].order() == 2) add(nodes.of_edge);
    return vectors;
}

}  // namespace

std::vector<PartValues> values_of_part(const ElasticProblem& problem, const std::vector<CaseSolution>& solutions,
                                       std::size_t p) {
    std::vector<PartValues> values;
    for (const CaseSolution& solution : solutions) {
        const std::string suffix = solutions.size() > 1 ? " " + solution.name : "";
        values.push_back(
            {"Displacement" + suffix, PartValues::Of::points, 3, vectors_at_points(problem, solution.displacement, p)});
        const PartStress& stress = solution.stress.parts[p];
        std::vector<SymmetricTensor> at_nodes = stress.at_vertex;
        at_nodes.insert(at_nodes.end(), stress.at_edge.begin(), stress.at_edge.end());
        add_stresses(at_nodes, PartValues::Of::points, suffix, values);
        add_stresses(stress.of_tet, PartValues::Of::tets, suffix, values);
        values.push_back({"ErrorIndicator" + suffix, PartValues::Of::tets, 1,
                          std::vector<float>(stress.error.begin(), stress.error.end())});
    }
    return values;
}

std::vector<PartValues> values_of_part(const ElasticProblem& problem, const std::vector<Mode>& modes, std::size_t p) {
    std::vector<PartValues> values;
    for (std::size_t m = 0; m < modes.size(); ++m)
        values.push_back(
            {fmt::format("Mode {}", m + 1), PartValues::Of::points, 3, vectors_at_points(problem, modes[m].shape, p)});
    return values;
}

void write_sizes(const std::string& path, const SizedMesh& sizes) {
    Part part;
    part.mesh.vertices = sizes.vertices;
    part.mesh.tets.assign(sizes.tets.begin(), sizes.tets.end());
    part.global_id.resize(sizes.vertices.size());
    std::iota(part.global_id.begin(), part.global_id.end(), 0);
    const PartValues size = {"size", PartValues::Of::points, 1,
                             std::vector<float>(sizes.size.begin(), sizes.size.end())};
    write_part(path, part, {}, std::span(&size, 1));
}

}  // namespace kerf

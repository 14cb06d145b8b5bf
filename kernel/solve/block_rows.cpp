#include "solve/block_rows.h"

#include <algorithm>
#include <numeric>

namespace kerf {

namespace {

// Which nodes share an element, without values. Corner by corner: first how often, then who, then each once.
BlockRows pattern_of(const FeSpace& space) {
    const int nodes_each = element_nodes(space.order());
    BlockRows rows;
    std::vector<std::int64_t> first(space.node_count() + 1, 0);
    for_all_tets(space, [&](std::size_t p, std::size_t t) {
        const auto nodes = space.nodes_of(p, t);
        for (int i = 0; i < nodes_each; ++i) ++first[nodes[i] + 1];
    });
    std::partial_sum(first.begin(), first.end(), first.begin());
    // The elements of each node, as number of the part and of the tetrahedron.
    std::vector<std::int64_t> element_at(first.back());
    std::vector<std::int64_t> next(first.begin(), first.end() - 1);
    std::vector<std::int64_t> first_tet{0};
    for (const Part& part : space.parts()) first_tet.push_back(first_tet.back() + part.tet_count());
    for_all_tets(space, [&](std::size_t p, std::size_t t) {
        const auto nodes = space.nodes_of(p, t);
        for (int i = 0; i < nodes_each; ++i) element_at[next[nodes[i]]++] = first_tet[p] + t;
    });
    std::vector<std::int32_t> around;
    rows.first.push_back(0);
    for (std::int32_t n = 0; n < space.node_count(); ++n) {
        around.clear();
        for (std::int64_t i = first[n]; i < first[n + 1]; ++i) {
            const std::int64_t element = element_at[i];
            const std::size_t p = std::upper_bound(first_tet.begin(), first_tet.end(), element) - first_tet.begin() - 1;
            const auto nodes = space.nodes_of(p, element - first_tet[p]);
            around.insert(around.end(), nodes.begin(), nodes.begin() + nodes_each);
        }
        std::sort(around.begin(), around.end());
        around.erase(std::unique(around.begin(), around.end()), around.end());
        rows.columns.insert(rows.columns.end(), around.begin(), around.end());
        rows.first.push_back(std::ssize(rows.columns));
    }
    return rows;
}

void add_block(BlockRows& rows, std::int32_t row, std::int32_t column, const Eigen::Matrix3d& block) {
    const auto begin = rows.columns.begin() + rows.first[row], end = rows.columns.begin() + rows.first[row + 1];
    double* value = &rows.values[9 * (std::lower_bound(begin, end, column) - rows.columns.begin())];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) value[3 * i + j] += block(i, j);
}

void add_spring_blocks(const ElasticProblem& problem, BlockRows& rows) {
    for (const SurfaceSprings::Facet& facet : problem.springs.facets) {
        const FacetStiffness blocks = spring_stiffness(*problem.space, problem.springs, facet);
        const auto nodes = problem.space->nodes_of_facet(facet.part, facet.facet);
        for (std::size_t a = 0; a < nodes.size(); ++a)
            for (std::size_t b = 0; b < nodes.size(); ++b)
                if (nodes[a] >= 0 && nodes[b] >= 0) add_block(rows, nodes[a], nodes[b], blocks[a][b]);
    }
}

}  // namespace

void turn_into_frames(const NodeFrames& frames, BlockRows& rows) {
    if (frames.empty()) return;
    for (std::int32_t n = 0; n < rows.row_count(); ++n)
        for (std::int64_t i = rows.first[n]; i < rows.first[n + 1]; ++i) {
            const NodeFrames::Frame *row = frames.at(n), *column = frames.at(rows.columns[i]);
            Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> block(&rows.values[9 * i]);
            if (row) block = (row->axes * block).eval();
            if (column) block = (block * column->axes.transpose()).eval();
        }
}

BlockRows stiffness_of_rank(const ElasticProblem& problem) {
    const FeSpace& space = *problem.space;
    BlockRows rows = pattern_of(space);
    rows.values.assign(9 * rows.columns.size(), 0);
    const int nodes_each = element_nodes(space.order());
    TetElement::Stiffness blocks;
    for_all_tets(space, [&](std::size_t p, std::size_t t) {
        space.element(p, t).stiffness(problem.material(p, t), blocks);
        const auto nodes = space.nodes_of(p, t);
        for (int a = 0; a < nodes_each; ++a) {
            for (int b = 0; b < nodes_each; ++b) add_block(rows, nodes[a], nodes[b], blocks[a][b]);
        }
    });
    add_spring_blocks(problem, rows);
    turn_into_frames(problem.frames, rows);
    return rows;
}

}  // namespace kerf

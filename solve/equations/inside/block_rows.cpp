// The stiffness of a rank is summed into rows of 3 x 3 blocks, of which those on and above the diagonal are stored. The
// pattern comes first: the elements around each node are listed by counting, and their nodes, ascending and each once,
// are the columns of its row. Then the blocks of elements and springs are added at places found by bisection.
// `NumberedElements` hides which elements these are: those of the space, or straight ones of order 1 over its corners,
// for the coarser level of a multigrid. Everything is along x, y and z until the end, when rows and columns of nodes
// with axes of their own are turned.
#include "solve/equations/inside/block_rows.h"

#include <algorithm>
#include <numeric>

#include "solve/equations/inside/mass_matrix.h"

namespace kerf {

namespace {

// The elements of a rank with numbers for the nodes of a matrix: all nodes of the elements, or their corners.
class NumberedElements {
 public:
    NumberedElements(const FeSpace& space, const std::vector<std::int32_t>& corner_numbers)
        : space_(space), numbers_(corner_numbers) {
        for (const Part& part : space.parts()) first_tet_.push_back(first_tet_.back() + part.tet_count());
    }

    int order() const { return numbers_.empty() ? space_.order() : 1; }
    int nodes_each() const { return element_nodes(order()); }
    std::int32_t node_count() const {
        if (numbers_.empty()) return space_.node_count();
        return 1 + std::max(-1, *std::max_element(numbers_.begin(), numbers_.end()));
    }
    std::array<std::int32_t, most_element_nodes> nodes_of(std::size_t p, std::size_t t) const {
        auto nodes = space_.nodes_of(p, t);
        for (int i = 0; i < nodes_each() && !numbers_.empty(); ++i) nodes[i] = numbers_[nodes[i]];
        return nodes;
    }
    std::array<std::int32_t, 6> nodes_of_facet(std::size_t p, std::size_t facet) const {
        auto nodes = space_.nodes_of_facet(p, facet);
        for (std::size_t i = 0; i < nodes.size() && !numbers_.empty(); ++i) nodes[i] = i < 3 ? numbers_[nodes[i]] : -1;
        return nodes;
    }
    NodeFrames frames(const NodeFrames& of_space) const {
        return numbers_.empty() ? of_space : of_space.renumbered(numbers_);
    }
    std::int64_t number_of(std::size_t p, std::size_t t) const { return first_tet_[p] + t; }
    std::array<std::int32_t, most_element_nodes> nodes_of(std::int64_t element) const {
        const auto p = std::upper_bound(first_tet_.begin(), first_tet_.end(), element) - first_tet_.begin() - 1;
        return nodes_of(p, element - first_tet_[p]);
    }
    TetElement element(std::size_t p, std::size_t t) const {
        if (numbers_.empty()) return space_.element(p, t);
        const auto nodes = space_.nodes_of(p, t);
        std::array<Vec3, 4> corners;
        for (std::size_t i = 0; i < 4; ++i) corners[i] = space_.points()[nodes[i]];
        return {corners, 1};
    }

 private:
    const FeSpace& space_;
    const std::vector<std::int32_t>& numbers_;
    std::vector<std::int64_t> first_tet_{0};
};

// Returns the pattern of the matrix without values: which nodes share an element. `first` counts the elements around
// each node, `element_at` lists them.
SymmetricBlocks<3> pattern_of(const FeSpace& space, const NumberedElements& elements) {
    const int nodes_each = elements.nodes_each();
    const std::int32_t node_count = elements.node_count();
    SymmetricBlocks<3> rows;
    std::vector<std::int64_t> first(node_count + 1, 0);
    for_all_tets(space, [&](std::size_t p, std::size_t t) {
        const auto nodes = elements.nodes_of(p, t);
        for (int i = 0; i < nodes_each; ++i) ++first[nodes[i] + 1];
    });
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<std::int64_t> element_at(first.back());
    std::vector<std::int64_t> next(first.begin(), first.end() - 1);
    for_all_tets(space, [&](std::size_t p, std::size_t t) {
        const auto nodes = elements.nodes_of(p, t);
        for (int i = 0; i < nodes_each; ++i) element_at[next[nodes[i]]++] = elements.number_of(p, t);
    });
    std::vector<std::int32_t> around;
    rows.first.push_back(0);
    for (std::int32_t n = 0; n < node_count; ++n) {
        around.assign(1, n);
        for (std::int64_t i = first[n]; i < first[n + 1]; ++i) {
            const auto nodes = elements.nodes_of(element_at[i]);
            std::copy_if(nodes.begin(), nodes.begin() + nodes_each, std::back_inserter(around),
                         [n](std::int32_t node) { return node > n; });
        }
        std::sort(around.begin(), around.end());
        around.erase(std::unique(around.begin(), around.end()), around.end());
        rows.columns.insert(rows.columns.end(), around.begin(), around.end());
        rows.first.push_back(std::ssize(rows.columns));
    }
    rows.columns.shrink_to_fit();
    return rows;
}

void add_block(SymmetricBlocks<3>& rows, std::int32_t row, std::int32_t column, const Eigen::Matrix3d& block) {
    if (column < row) return;
    const auto begin = rows.columns.begin() + rows.first[row], end = rows.columns.begin() + rows.first[row + 1];
    rows.block(std::lower_bound(begin, end, column) - rows.columns.begin()) += block;
}

void add_spring_blocks(const ElasticProblem& problem, const NumberedElements& elements, SymmetricBlocks<3>& rows) {
    for (const SurfaceSprings::Facet& facet : problem.springs.facets) {
        const FacetStiffness blocks = spring_stiffness(*problem.space, problem.springs, facet, elements.order());
        const auto nodes = elements.nodes_of_facet(facet.part, facet.facet);
        for (std::size_t a = 0; a < nodes.size(); ++a)
            for (std::size_t b = 0; b < nodes.size(); ++b)
                if (nodes[a] >= 0 && nodes[b] >= 0) add_block(rows, nodes[a], nodes[b], blocks[a][b]);
    }
}

}  // namespace

void turn_into_frames(const NodeFrames& frames, SymmetricBlocks<3>& rows) {
    if (frames.empty()) return;
    for (std::int32_t n = 0; n < rows.row_count(); ++n)
        for (std::int64_t i = rows.first[n]; i < rows.first[n + 1]; ++i) {
            const NodeFrames::Frame *row = frames.at(n), *column = frames.at(rows.columns[i]);
            auto block = rows.block(i);
            if (row) block = (row->axes * block).eval();
            if (column) block = (block * column->axes.transpose()).eval();
        }
}

SymmetricBlocks<3> stiffness_of_rank(const ElasticProblem& problem, const StiffnessChoice& choice) {
    const FeSpace& space = *problem.space;
    const NumberedElements elements(space, choice.corner_numbers);
    SymmetricBlocks<3> rows = pattern_of(space, elements);
    rows.values.assign(9 * rows.columns.size(), 0);
    const int nodes_each = elements.nodes_each();
    TetElement::Stiffness blocks;
    for_all_tets(space, [&](std::size_t p, std::size_t t) {
        const TetElement element = elements.element(p, t);
        element.stiffness(problem.material(p, t), blocks);
        if (const double density = choice.mass_factor * problem.material(p, t).density; density != 0) {
            const MassShares shares = mass_shares(element);
            for (int a = 0; a < nodes_each; ++a)
                for (int b = 0; b < nodes_each; ++b) blocks[a][b].diagonal().array() += density * shares[a][b];
        }
        const auto nodes = elements.nodes_of(p, t);
        for (int a = 0; a < nodes_each; ++a)
            for (int b = 0; b < nodes_each; ++b) add_block(rows, nodes[a], nodes[b], blocks[a][b]);
    });
    add_spring_blocks(problem, elements, rows);
    turn_into_frames(elements.frames(problem.frames), rows);
    return rows;
}

}  // namespace kerf

// Smoothed aggregation (Vanek, Mandel and Brezina 1996, vanek1996). Nodes are grouped into aggregates, and the rigid
// motions of the nodes of an aggregate, made orthonormal, are six columns of the tentative prolongation T; the
// triangular factor has the motions of the coarse node. One step of Jacobi's method smooths it, P = T - 4 / (3 lambda)
// D^-1 A T with the blocks D of the diagonal and the largest eigenvalue lambda of D^-1 A, and the coarse matrix is P^T
// A P. Motions that depend on others, as turns of a single node, are columns of zeros, and so are their rows and
// columns of the coarse matrix. A is a sum of shares over the ranks: owners add the rows of A T that other ranks have,
// rank after rank, send the finished rows of P back to the ghosts, and then each rank multiplies its own share, so that
// the coarse matrix is a sum of shares again. A row of the share needs the blocks below the diagonal, too, which
// `lower_` finds above it.
#include "solve/multigrid/inside/smoothed_aggregation.h"

#include <algorithm>
#include <array>

#include "base/core/ids.h"
#include "solve/multigrid/inside/aggregates.h"

namespace kerf {

namespace {

using MotionBlock = Eigen::Matrix<double, rigid_motions, rigid_motions, Eigen::RowMajor>;

// One row of a prolongation, finished or not: blocks by the global number of the coarse node.
template <int B>
struct SparseRow {
    using Block = RowMajorBlock<B, rigid_motions>;
    std::vector<std::int64_t> ids;
    std::vector<Block> blocks;

    Block& at(std::int64_t id) {
        for (std::size_t i = 0; i < ids.size(); ++i)
            if (ids[i] == id) return blocks[i];
        ids.push_back(id);
        return blocks.emplace_back(Block::Zero());
    }
    void clear() {
        ids.clear();
        blocks.clear();
    }
};

// A block of a row that is sent to another rank.
template <int B>
struct SentBlock {
    std::int32_t place = 0;  // of the row's node among those that both ranks have
    std::int64_t id = 0;     // of the coarse node
    std::array<double, B * rigid_motions> block{};

    template <class Archive>
    void archive(Archive& a) {
        a(place, id, block);
    }
};

// Makes columns orthonormal (Gram and Schmidt, twice for the sake of rounding). Columns that depend on those before
// become zero.
void orthonormalise(Eigen::MatrixXd& columns, MotionBlock& factor) {
    constexpr double dependent = 1e-8;
    factor.setZero();
    for (Eigen::Index c = 0; c < rigid_motions; ++c) {
        const double before = columns.col(c).norm();
        for (int pass = 0; pass < 2; ++pass)
            for (Eigen::Index d = 0; d < c; ++d) {
                const double along = columns.col(d).dot(columns.col(c));
                factor(d, c) += along;
                columns.col(c) -= along * columns.col(d);
            }
        const double length = columns.col(c).norm();
        const bool is_new = length > dependent * before;
        factor(c, c) = is_new ? length : 0;
        if (is_new)
            columns.col(c) /= length;
        else
            columns.col(c).setZero();
    }
}

// Returns a flag for each owned node: whether it has no part in the coarse level, as those of `is_apart` and those that
// are coupled with no other node, on any rank. Smoothing is enough for them.
template <int B>
std::vector<std::uint8_t> with_uncoupled(const LevelMatrix<B>& matrix, const LowerBlocks& lower,
                                         std::vector<std::uint8_t> is_apart) {
    std::vector<std::int64_t> couplings(matrix.node_count());
    for (std::int32_t n = 0; n < matrix.node_count(); ++n) {
        const std::int64_t above = matrix.share.first[n + 1] - matrix.share.first[n] - 1;
        couplings[n] = above + lower.first[n + 1] - lower.first[n];
    }
    matrix.ownership.sum_to_owners(std::span(couplings), 1);
    for (std::int32_t n = 0; n < matrix.owned; ++n)
        if (couplings[n] == 0) is_apart[n] = 1;
    return is_apart;
}

template <int B>
class Coarsening {
 public:
    Coarsening(MpiRanks& ranks, const LevelMatrix<B>& fine, const ChebyshevSmoother<B>& smoother,
               const std::vector<std::uint8_t>& is_apart)
        : ranks_(ranks),
          fine_(fine),
          smoother_(smoother),
          lower_(lower_blocks_of(fine.share)),
          aggregates_(aggregate(fine.share, lower_, fine.owned, with_uncoupled(fine, lower_, is_apart))) {
        starts_.push_back(0);
        for (const std::int32_t count : all_gather(ranks, aggregates_.count)) starts_.push_back(starts_.back() + count);
    }

    CoarserLevel<B> make(const NearNullSpace& motions) {
        make_tentative(motions);
        make_prolongation();
        take_rows_of_ghosts();
        number_coarse_nodes();
        made_.matrix.owned = aggregates_.count;
        made_.matrix.ownership = Ownership::of_numbers(ranks_, starts_, ghosts_);
        make_product();
        result_.first.resize(fine_.owned + 1);  // those of ghosts have served
        result_.columns.resize(result_.first.back());
        result_.values.resize(Prolongation<B>::block_size * result_.first.back());
        result_.columns.shrink_to_fit();
        result_.values.shrink_to_fit();
        made_.prolongation = std::move(result_);
        return std::move(made_);
    }

 private:
    using Block = RowMajorBlock<B, rigid_motions>;
    static constexpr int block_size = Prolongation<B>::block_size;
    static constexpr std::size_t motion_block_size = rigid_motions * rigid_motions;

    std::int64_t first_own() const { return starts_[ranks_.rank()]; }
    Eigen::Map<const Block> tentative(std::int32_t n) const {
        return Eigen::Map<const Block>(&tentative_[block_size * n]);
    }
    // Calls visit(m, A_nm) for all blocks of this rank in a row.
    template <class Visit>
    void visit_row(std::int32_t n, Visit visit) const {
        const SymmetricBlocks<B>& a = fine_.share;
        for (std::int64_t i = lower_.first[n]; i < lower_.first[n + 1]; ++i)
            visit(lower_.rows[i], typename SymmetricBlocks<B>::Block(a.block(lower_.at[i]).transpose()));
        for (std::int64_t i = a.first[n]; i < a.first[n + 1]; ++i)
            visit(a.columns[i], typename SymmetricBlocks<B>::Block(a.block(i)));
    }

    // Returns the blocks of the rows row_of(n) of all nodes that a neighbour shares.
    template <class RowOf>
    std::vector<SentBlock<B>> sent_rows(const Ownership::Neighbour& neighbour, const RowOf& row_of) const {
        std::vector<SentBlock<B>> all;
        for (std::size_t place = 0; place < neighbour.items.size(); ++place) {
            const SparseRow<B>& row = row_of(neighbour.items[place]);
            for (std::size_t i = 0; i < row.ids.size(); ++i) {
                SentBlock<B>& sent = all.emplace_back();
                sent.place = place;
                sent.id = row.ids[i];
                std::copy_n(row.blocks[i].data(), block_size, sent.block.begin());
            }
        }
        return all;
    }

    void make_tentative(const NearNullSpace& motions);
    void multiply_tentative(std::int32_t n, SparseRow<B>& row) const;
    void append_row(const SparseRow<B>& row);
    void make_prolongation();
    void take_rows_of_ghosts();
    void number_coarse_nodes();
    void make_pattern();
    void make_product();

    MpiRanks& ranks_;
    const LevelMatrix<B>& fine_;
    const ChebyshevSmoother<B>& smoother_;
    LowerBlocks lower_;
    Aggregates aggregates_;
    std::vector<std::int64_t> starts_;        // of the aggregates of each rank, among all
    std::vector<std::int64_t> aggregate_of_;  // of each local node, among all; negative: none
    std::vector<double> tentative_;           // a block for each local node
    Prolongation<B> result_;                  // of all local nodes
    std::vector<std::int64_t> ids_;           // global numbers of its columns
    std::vector<std::int64_t> ghosts_;        // aggregates of other ranks, ascending
    CoarserLevel<B> made_;
};

template <int B>
void Coarsening<B>::make_tentative(const NearNullSpace& motions) {
    std::vector<std::int32_t> first(aggregates_.count + 1, 0);
    for (const std::int32_t a : aggregates_.of_node)
        if (a >= 0) ++first[a + 1];
    for (std::int32_t a = 0; a < aggregates_.count; ++a) first[a + 1] += first[a];
    std::vector<std::int32_t> members(first.back()), next(first.begin(), first.end() - 1);
    for (std::int32_t n = 0; n < fine_.owned; ++n)
        if (const std::int32_t a = aggregates_.of_node[n]; a >= 0) members[next[a]++] = n;
    tentative_.assign(static_cast<std::size_t>(block_size) * fine_.node_count(), 0);
    aggregate_of_.assign(fine_.node_count(), Aggregates::none);
    made_.motions.resize(motion_block_size * aggregates_.count);
    Eigen::MatrixXd columns;
    for (std::int32_t a = 0; a < aggregates_.count; ++a) {
        columns.resize(B * (first[a + 1] - first[a]), rigid_motions);
        for (std::int32_t i = first[a]; i < first[a + 1]; ++i)
            columns.middleRows<B>(B * (i - first[a])) = Eigen::Map<const Block>(&motions[block_size * members[i]]);
        Eigen::Map<MotionBlock> factor(&made_.motions[motion_block_size * a]);
        MotionBlock found;
        orthonormalise(columns, found);
        factor = found;
        for (std::int32_t i = first[a]; i < first[a + 1]; ++i) {
            Eigen::Map<Block>{&tentative_[block_size * members[i]]} = columns.middleRows<B>(B * (i - first[a]));
            aggregate_of_[members[i]] = first_own() + a;
        }
    }
    fine_.ownership.from_owners(std::span(aggregate_of_), 1);
    fine_.ownership.from_owners(std::span(tentative_), block_size);
}

template <int B>
void Coarsening<B>::multiply_tentative(std::int32_t n, SparseRow<B>& row) const {
    visit_row(n, [&](std::int32_t m, const auto& a) {
        if (aggregate_of_[m] >= 0) row.at(aggregate_of_[m]).noalias() += a * tentative(m);
    });
}

template <int B>
void Coarsening<B>::append_row(const SparseRow<B>& row) {
    ids_.insert(ids_.end(), row.ids.begin(), row.ids.end());
    for (const Block& block : row.blocks)
        for (Eigen::Index i = 0; i < block_size; ++i) result_.values.push_back(block.data()[i]);
    result_.first.push_back(std::ssize(ids_));
}

// Makes the rows of owned nodes; the owner of a node adds the rows that other ranks have for it, in their order.
template <int B>
void Coarsening<B>::make_prolongation() {
    SparseRow<B> row;
    const auto received = fine_.ownership.lists_to_owners([&](const Ownership::Neighbour& neighbour) {
        return sent_rows(neighbour, [&](std::int32_t n) -> const SparseRow<B>& {
            row.clear();
            multiply_tentative(n, row);
            return row;
        });
    });
    std::vector<std::vector<const SentBlock<B>*>> added(fine_.owned);
    for (std::size_t r = 0; r < received.size(); ++r)
        for (const SentBlock<B>& sent : received[r])
            added[fine_.ownership.owned()[r].items[sent.place]].push_back(&sent);
    const double damping = 4 / (3 * smoother_.largest_eigenvalue());
    for (std::int32_t n = 0; n < fine_.owned; ++n) {
        row.clear();
        if (aggregate_of_[n] >= 0) {
            multiply_tentative(n, row);
            for (const SentBlock<B>* sent : added[n]) row.at(sent->id) += Eigen::Map<const Block>(sent->block.data());
            for (Block& block : row.blocks) block = -damping * (smoother_.inverse(n) * block).eval();
            row.at(aggregate_of_[n]) += tentative(n);
        }
        append_row(row);
    }
    tentative_ = {};
}

template <int B>
void Coarsening<B>::take_rows_of_ghosts() {
    SparseRow<B> row;
    const auto received = fine_.ownership.lists_from_owners([&](const Ownership::Neighbour& neighbour) {
        return sent_rows(neighbour, [&](std::int32_t n) -> const SparseRow<B>& {
            row.clear();
            for (std::int64_t i = result_.first[n]; i < result_.first[n + 1]; ++i) row.at(ids_[i]) = result_.block(i);
            return row;
        });
    });
    std::vector<SparseRow<B>> rows(fine_.node_count() - fine_.owned);
    for (std::size_t r = 0; r < received.size(); ++r)
        for (const SentBlock<B>& sent : received[r])
            rows[fine_.ownership.ghosts()[r].items[sent.place] - fine_.owned].at(sent.id) +=
                Eigen::Map<const Block>(sent.block.data());
    for (const SparseRow<B>& of_ghost : rows) append_row(of_ghost);
}

// Numbers the coarse nodes of this rank, then those of others.
template <int B>
void Coarsening<B>::number_coarse_nodes() {
    const std::int64_t begin = first_own(), end = begin + aggregates_.count;
    for (const std::int64_t id : ids_)
        if (id < begin || id >= end) ghosts_.push_back(id);
    std::sort(ghosts_.begin(), ghosts_.end());
    ghosts_.erase(std::unique(ghosts_.begin(), ghosts_.end()), ghosts_.end());
    result_.columns.reserve(ids_.size());
    for (const std::int64_t id : ids_)
        result_.columns.push_back(id >= begin && id < end
                                      ? id - begin
                                      : aggregates_.count +
                                            (std::lower_bound(ghosts_.begin(), ghosts_.end(), id) - ghosts_.begin()));
    ids_ = {};
}

// Makes the pattern of P^T A P: coarse nodes that meet in a row of A P.
template <int B>
void Coarsening<B>::make_pattern() {
    const std::int32_t coarse = aggregates_.count + count_of(ghosts_);
    std::vector<std::vector<std::int32_t>> rows(coarse);
    for (std::int32_t c = 0; c < coarse; ++c) rows[c] = {c};
    std::vector<std::int32_t> seen_by(coarse, -1), met;
    const auto meet = [&](std::int32_t n, std::int32_t m) {
        for (std::int64_t i = result_.first[m]; i < result_.first[m + 1]; ++i)
            if (const std::int32_t c = result_.columns[i]; seen_by[c] != n) {
                seen_by[c] = n;
                met.push_back(c);
            }
    };
    const SymmetricBlocks<B>& a = fine_.share;
    for (std::int32_t n = 0; n < fine_.node_count(); ++n) {
        if (result_.first[n] == result_.first[n + 1]) continue;
        met.clear();
        for (std::int64_t i = lower_.first[n]; i < lower_.first[n + 1]; ++i) meet(n, lower_.rows[i]);
        for (std::int64_t i = a.first[n]; i < a.first[n + 1]; ++i) meet(n, a.columns[i]);
        for (std::int64_t i = result_.first[n]; i < result_.first[n + 1]; ++i) {
            std::vector<std::int32_t>& row = rows[result_.columns[i]];
            for (const std::int32_t c : met) {
                if (c <= row.front()) continue;
                const auto place = std::lower_bound(row.begin(), row.end(), c);
                if (place == row.end() || *place != c) row.insert(place, c);
            }
        }
    }
    SymmetricBlocks<rigid_motions>& product = made_.matrix.share;
    product.first.push_back(0);
    for (const std::vector<std::int32_t>& row : rows) {
        product.columns.insert(product.columns.end(), row.begin(), row.end());
        product.first.push_back(std::ssize(product.columns));
    }
    product.columns.shrink_to_fit();
    product.values.assign(motion_block_size * product.columns.size(), 0);
}

template <int B>
void Coarsening<B>::make_product() {
    make_pattern();
    SymmetricBlocks<rigid_motions>& product = made_.matrix.share;
    SparseRow<B> row;  // of A P
    std::vector<std::int32_t> place(product.row_count(), -1);
    for (std::int32_t n = 0; n < fine_.node_count(); ++n) {
        if (result_.first[n] == result_.first[n + 1]) continue;
        row.clear();
        visit_row(n, [&](std::int32_t m, const auto& a) {
            for (std::int64_t i = result_.first[m]; i < result_.first[m + 1]; ++i) {
                std::int32_t& at = place[result_.columns[i]];
                if (at < 0) {
                    at = count_of(row.ids);
                    row.ids.push_back(result_.columns[i]);
                    row.blocks.emplace_back(Block::Zero());
                }
                row.blocks[at].noalias() += a * result_.block(i);
            }
        });
        for (const std::int64_t id : row.ids) place[id] = -1;
        for (std::int64_t i = result_.first[n]; i < result_.first[n + 1]; ++i) {
            const std::int32_t c = result_.columns[i];
            const Block of_fine = result_.block(i);
            const auto begin = product.columns.begin() + product.first[c],
                       end = product.columns.begin() + product.first[c + 1];
            for (std::size_t k = 0; k < row.ids.size(); ++k)
                if (row.ids[k] >= c)
                    product.block(std::lower_bound(begin, end, row.ids[k]) - product.columns.begin()).noalias() +=
                        of_fine.transpose() * row.blocks[k];
        }
    }
}

}  // namespace

template <int B>
CoarserLevel<B> coarsen(MpiRanks& ranks, const LevelMatrix<B>& fine, const ChebyshevSmoother<B>& smoother,
                        const NearNullSpace& motions, const std::vector<std::uint8_t>& is_apart) {
    return Coarsening<B>(ranks, fine, smoother, is_apart).make(motions);
}

template CoarserLevel<3> coarsen(MpiRanks&, const LevelMatrix<3>&, const ChebyshevSmoother<3>&, const NearNullSpace&,
                                 const std::vector<std::uint8_t>&);
template CoarserLevel<6> coarsen(MpiRanks&, const LevelMatrix<6>&, const ChebyshevSmoother<6>&, const NearNullSpace&,
                                 const std::vector<std::uint8_t>&);

}  // namespace kerf

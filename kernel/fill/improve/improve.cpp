// Rounds over the bad cells, by a queue with the worst first. For each, the operations are tried in the order of their
// cost: an edge is removed, a corner is moved, a vertex is added. Cells that an operation leaves bad, or makes so, come
// back in the same round; a cell that nothing helps waits for the next one, because its neighbours may have changed by
// then. An entry of the queue is stale if its cell has another badness by now. A vertex is "settled" if no move has
// helped it since the cells around it changed. Work is counted by evaluations of new cells, never by a clock, so that
// the result is the same everywhere; vertices for cells that are not useless anyway may take only a share of that
// budget. All comparisons are of badness, which is a squared cotangent: constants are given in degrees and converted
// once.
#include "fill/improve/improve.h"

#include <array>
#include <queue>

#include "base/core/check.h"
#include "base/core/error.h"
#include "fill/improve/inside/best_place.h"
#include "fill/improve/inside/edge_removal.h"
#include "fill/improve/inside/vertex_insertion.h"

namespace kerf {

namespace {

constexpr double least_gain_of_a_move = 0.1;         // gain of a move, in squared sines: a degree and a half at 25
constexpr double angle_for_a_vertex_deg = 20;        // cells with a smaller one are worth a new vertex, ...
constexpr double angle_where_sizes_differ_deg = 12;  // ... and here with this one, because vertices crowd
constexpr int first_round_with_vertices = 2;         // before, much is mended without
constexpr double first_least_made_deg = 8, later_least_made_deg = 3;  // least angle of cells around a new vertex
constexpr double much_better = 3;  // gain of a vertex for a cell that is worse, as a ratio of squared cotangents
constexpr double share_for_vertices = 0.25;        // share of all evaluations; more only for ...
constexpr double angle_of_a_useless_cell_deg = 3;  // ... cells with a smaller angle
constexpr double angle_of_no_volume_deg = 0.01;    // angle of cells whose volume is lost in rounding
// Depths at which a vertex under a facet may begin, in lengths of an edge: the first one for useless cells, all for
// cells without volume, which long facets of a thin body may have.
constexpr std::array depths_below_facets = {0.3, 0.1, 0.03};
constexpr double least_share_of_a_round = 0.1;  // share of the bad cells that a round must mend, or it is the last
constexpr std::int64_t evaluations_of_any_mesh = 1000;  // beside those for each of its cells
constexpr int cells_between_questions = 1024;           // number of cells between questions whether it is cancelled

class Improver {
 public:
    Improver(TetMesh& mesh, const ImproveOptions& options, Improvement& improvement)
        : evaluation_budget_(evaluation_budget_of(mesh, options)),
          is_settled_(mesh.vertices.size(), 0),
          mesh_(std::move(mesh), options.frozen_cells, options.max_size,
                [&](const CellShape& shape) { improvement.smallest_before.add(degrees_from_square(shape.sharpest)); }),
          options_(&options),
          result_(&improvement),
          bad_(square_from_degrees(options.threshold_deg)),
          bad_enough_for_a_vertex_(std::max(bad_, square_from_degrees(worth_a_vertex_deg(options)))),
          without_volume_(square_from_degrees(angle_of_no_volume_deg)),
          useless_(square_from_degrees(angle_of_a_useless_cell_deg)) {}

    void run() {
        for (const CellId cell : mesh_.cells())
            if (is_bad(cell)) waiting_.push_back(cell);
        result_->bad_cells_before = waiting_count();
        while (!waiting_.empty() && result_->rounds < options_->most_rounds && !is_spent()) {
            const std::int64_t before = waiting_count();
            if (!run_round()) break;
            if (options_->adds_vertices && result_->rounds < first_round_with_vertices) continue;
            const std::int64_t gained = before - waiting_count();
            if (gained < least_share_of_a_round * before) break;
        }
        for (const CellId cell : mesh_.cells()) result_->bad_cells_after += is_bad(cell);
    }
    bool is_cancelled() const { return is_cancelled_; }
    TetMesh finish() { return mesh_.finish(); }

 private:
    struct Entry {
        double badness;
        CellId cell;
        bool operator<(const Entry& other) const {
            return badness != other.badness ? badness < other.badness : cell > other.cell;
        }
    };

    static double worth_a_vertex_deg(const ImproveOptions& options) {
        return options.max_size.is_constant() ? angle_for_a_vertex_deg : angle_where_sizes_differ_deg;
    }
    static std::int64_t evaluation_budget_of(const TetMesh& mesh, const ImproveOptions& options) {
        const auto cells = std::ssize(mesh.tets) - options.frozen_cells;
        return evaluations_of_any_mesh + static_cast<std::int64_t>(options.evaluation_budget * cells);
    }
    bool is_spent() const { return mesh_.evaluations() >= evaluation_budget_; }
    bool is_bad(CellId cell) const {
        return !mesh_.is_removed(cell) && !mesh_.is_frozen(cell) && mesh_.badness(cell) > bad_;
    }
    std::int64_t waiting_count() const { return std::ssize(waiting_); }
    void push(CellId cell) {
        if (is_bad(cell)) queue_.push({mesh_.badness(cell), cell});
    }

    // Queues cells that have changed; their vertices may move again.
    void requeue(std::span<const CellId> cells) {
        for (const CellId cell : cells) {
            for (const std::int32_t v : mesh_.corners(cell)) is_settled_[v] = 0;
            push(cell);
        }
    }

    // Works on all cells that wait. Afterwards those wait that nothing has helped. Returns false if cancelled. The
    // queue is not empty if the budget is spent.
    bool run_round() {
        ++result_->rounds;
        for (const CellId cell : waiting_) push(cell);
        waiting_.clear();
        for (int until_question = 0; !queue_.empty() && !is_spent(); --until_question) {
            if (until_question == 0) {
                is_cancelled_ = options_->is_cancelled && options_->is_cancelled();
                if (is_cancelled_) return false;
                until_question = cells_between_questions;
            }
            const auto [badness, cell] = queue_.top();
            queue_.pop();
            if (!is_bad(cell) || mesh_.badness(cell) != badness) continue;
            if (!remove_an_edge(cell) && !move_a_corner(cell) && !insert_a_vertex(cell)) waiting_.push_back(cell);
        }
        std::sort(waiting_.begin(), waiting_.end());  // one may come twice, if its neighbours have changed it
        waiting_.erase(std::unique(waiting_.begin(), waiting_.end()), waiting_.end());
        std::erase_if(waiting_, [&](CellId cell) { return !is_bad(cell); });
        return true;
    }

    // Removes the edge without which the worst of the cells around it is best; false if none can be removed.
    bool remove_an_edge(CellId cell) {
        double best = std::numeric_limits<double>::infinity();
        for (int i = 0; i < 4; ++i)
            for (int j = i + 1; j < 4; ++j) {
                if (!mesh_.find_ring(cell, i, j, ring_)) continue;
                double limit = -std::numeric_limits<double>::infinity();
                for (const CellId at : ring_.cells) limit = std::max(limit, mesh_.badness(at));
                if (!edge_.find(mesh_, ring_, std::min(limit, best))) continue;
                best = edge_.badness();
                best_ring_.swap(ring_.cells);
                best_cells_ = edge_.cells();
            }
        if (best == std::numeric_limits<double>::infinity()) return false;
        requeue(mesh_.replace(best_ring_, best_cells_));
        ++result_->removed_edges;
        return true;
    }

    bool move_a_corner(CellId cell) {
        for (int i = 0; i < 4; ++i) {
            const std::int32_t vertex = mesh_.corners(cell)[i];
            if (is_settled_[vertex] || !mesh_.find_star(cell, i, star_)) continue;
            if (move_to_best_place(vertex)) {
                requeue(star_);
                ++result_->moved_vertices;
                return true;
            }
            is_settled_[vertex] = 1;
        }
        return false;
    }

    // Moves a vertex among the cells around it, star_, if that makes the worst of them better by a share.
    bool move_to_best_place(std::int32_t vertex) {
        places_.clear();
        double worst = -std::numeric_limits<double>::infinity();
        for (const CellId cell : star_) {
            const Triangle face = mesh_.face(cell, index_of(mesh_.corners(cell), vertex));
            places_.add({mesh_.point(face[0]), mesh_.point(face[1]), mesh_.point(face[2])});
            worst = std::max(worst, mesh_.badness(cell));
        }
        const BestPlace::Place best =
            places_.search(mesh_, {mesh_.point(vertex), worst}, mesh_.most_excess(star_), vertex);
        return best.badness < worst - least_gain_of_a_move * (1 + std::abs(worst)) &&
               mesh_.move(vertex, best.at, star_);
    }

    bool insert_a_vertex(CellId cell) {
        const double badness = mesh_.badness(cell);
        const bool may_be = options_->adds_vertices && result_->rounds >= first_round_with_vertices;
        if (!may_be || badness < bad_enough_for_a_vertex_) return false;
        if (badness < useless_ && evaluations_for_vertices_ > share_for_vertices * evaluation_budget_) return false;
        // A sliver between facets is better replaced by cells that are still bad, but whose vertex can be moved.
        const double least_made_deg =
            result_->rounds == first_round_with_vertices ? first_least_made_deg : later_least_made_deg;
        // Anything is better than a cell whose volume is lost in rounding.
        const double limit = badness > without_volume_
                                 ? badness
                                 : std::min(badness - least_gain_of_a_move * (1 + badness),
                                            std::max(square_from_degrees(least_made_deg), badness / much_better));
        evaluations_for_vertices_ -= mesh_.evaluations();
        std::span<const double> depths = depths_below_facets;
        if (badness <= without_volume_) depths = depths.first(badness > useless_ ? 1 : 0);
        const std::span<const CellId> cavity = insertion_.insert(mesh_, cell, limit, depths);
        evaluations_for_vertices_ += mesh_.evaluations();
        if (cavity.empty()) return false;
        is_settled_.push_back(0);
        requeue(mesh_.replace(cavity, insertion_.cells()));
        ++result_->new_vertices;
        return true;
    }

    std::int64_t evaluation_budget_;
    std::vector<char> is_settled_;  // #V; whether the cells around a vertex are those that no move has helped
    ImprovedMesh mesh_;
    const ImproveOptions* options_;
    Improvement* result_;
    double bad_, bad_enough_for_a_vertex_, without_volume_, useless_;
    std::int64_t evaluations_for_vertices_ = 0;
    bool is_cancelled_ = false;
    std::priority_queue<Entry> queue_;
    std::vector<CellId> waiting_;  // bad cells that are not in the queue; ascending between rounds
    EdgeRemoval edge_;
    BestPlace places_;
    VertexInsertion insertion_;
    EdgeRing ring_;
    std::vector<CellId> best_ring_, star_;
    std::vector<Tetrahedron> best_cells_;
};

}  // namespace

void Improvement::add_operations(const Improvement& again) {
    removed_edges += again.removed_edges;
    moved_vertices += again.moved_vertices;
    new_vertices += again.new_vertices;
}

void Improvement::add(const Improvement& other) {
    add_operations(other);
    bad_cells_before += other.bad_cells_before;
    bad_cells_after += other.bad_cells_after;
    rounds = std::max(rounds, other.rounds);
    if (is_empty())
        smallest_before = other.smallest_before;
    else if (!other.is_empty())
        smallest_before.add(other.smallest_before);
}

Improvement improve(TetMesh& mesh, const ImproveOptions& options) {
    KERF_CHECK(options.threshold_deg > 0 && options.threshold_deg < 70);
    Improvement improvement;
    improvement.smallest_before = Distribution(Distribution::Scale::linear, 0, 180);
    Improver improver(mesh, options, improvement);
    improver.run();
    mesh = improver.finish();
    if (improver.is_cancelled()) throw Error(ErrorCode::cancelled, "The improvement of the mesh was cancelled.");
    return improvement;
}

}  // namespace kerf

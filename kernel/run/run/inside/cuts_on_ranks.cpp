// The first thread of a rank talks to the other ranks and sleeps in between, while other threads cut. A half that
// arrives is cut at once, on a thread of its own.
//
// A leaf is accounted for on a rank if it is there, or if it is known to belong to a part that stays whole on another
// rank. A rank is done when all leaves of its range are accounted for and the halves for others are sent. It tells the
// first rank, which tells all when the last of them is done: no rank leaves before, so that no message goes to one that
// has left. The first error goes the same way and stops all. A rank that cannot tell of its error, because that fails,
// leaves the communicator, and the others learn of it when they poll.
#include "run/run/inside/cuts_on_ranks.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <future>
#include <iterator>
#include <list>
#include <mutex>
#include <utility>

#include "base/core/check.h"
#include "base/parallel/patience.h"
#include "base/parallel/shares.h"
#include "run/run/inside/range_of_rank.h"

namespace kerf {

namespace {

constexpr int first_rank = 0;

// A branch on its way. Edges keep their partners, which the facets alone do not tell where a surface touches itself.
struct TravellingBranch {
    Branch branch;
    SurfaceArrays arrays;
    std::vector<std::int32_t> partner;  // as Surface::build() takes it

    template <class Archive>
    void archive(Archive& a) {
        a(branch, arrays, partner);
    }
};

std::vector<std::int32_t> partners_of(const Surface& surface) {
    const auto corners = static_cast<std::size_t>(3) * static_cast<std::size_t>(surface.facet_count());
    Array<HalfEdge, std::int32_t> corner_of(corners);
    for (const Facet f : surface.facets()) {
        const std::array<HalfEdge, 3> h = surface.half_edges(f);
        for (std::int32_t i = 0; i < 3; ++i) corner_of[h[i]] = 3 * f.value() + i;
    }
    std::vector<std::int32_t> partner(corners);
    for (const HalfEdge h : corner_of.ids()) partner[corner_of[h]] = corner_of[Surface::opposite(h)];
    return partner;
}

Surface surface_of(TravellingBranch& travelled) {
    auto built = Surface::build(std::move(travelled.arrays), std::move(travelled.partner));
    KERF_CHECK(std::holds_alternative<Surface>(built));
    return std::get<Surface>(std::move(built));
}

// A message that ranks post to each other.
struct CutNote {
    enum class Kind : std::int32_t {
        done,       // to the first rank: this one has nothing left to do
        failed,     // to the first rank: this one has met an error
        stop,       // from the first rank: one has
        end,        // from the first rank: all are done
        accounted,  // so many leaves of the range belong to a part of another rank
    };
    Kind kind = Kind::done;
    std::int32_t leaves = 0;

    template <class Archive>
    void archive(Archive& a) {
        a(kind, leaves);
    }
};

class CutsOnRanks final : public OtherRanges, public CutListener {
 public:
    CutsOnRanks(Communicator& ranks, const DecomposeOptions& options, CutListener* next)
        : ranks_(ranks), options_(options), range_(range_of_rank(options.parts, ranks)), next_(next) {}

    Decomposition cut(Complex& complex);

 private:
    using Kind = CutNote::Kind;
    struct Half {
        Branch branch;
        Surface surface;
    };

    void take(const Branch& half, Surface surface) override;
    void are_one_part(const LeafRange& leaves) override;
    void on_cut(const Surface& parent, const Cut& cut) override;
    bool wants_cuts() const override { return next_ && next_->wants_cuts(); }
    bool cancelled() const override { return is_stopped_ || (next_ && next_->cancelled()); }

    void begin(Complex& complex);
    void begin(std::function<Decomposition()> work) {
        jobs_.push_back(std::async(std::launch::async, std::move(work)));
    }
    bool step();
    void hear(const CutNote& note);
    void cut_arrived(Bytes message);
    bool collect();
    bool pass_on();
    void tell_of_whole_part(const LeafRange& leaves);
    void fail();
    void tell(int rank, Kind kind, std::int32_t leaves = 0);
    void tell_others(Kind kind);
    Decomposition in_order();

    Communicator& ranks_;
    const DecomposeOptions& options_;
    const LeafRange range_;
    CutListener* next_;
    std::mutex listener_mutex_, halves_mutex_;
    std::list<Half> halves_;              // for other ranks
    std::vector<LeafRange> whole_parts_;  // of several leaves each, some of which other ranks wait for
    std::atomic<bool> is_stopped_ = false;
    std::list<std::future<Decomposition>> jobs_;
    std::vector<Decomposition> finished_;
    std::int32_t accounted_ = 0;  // leaves of the range that are accounted for
    int ranks_done_ = 0;          // as the first rank knows
    bool is_done_ = false, has_ended_ = false;
    StageStatus status_;
};

void CutsOnRanks::take(const Branch& half, Surface surface) {
    const std::lock_guard lock(halves_mutex_);
    halves_.push_back({half, std::move(surface)});
}

void CutsOnRanks::are_one_part(const LeafRange& leaves) {
    const std::lock_guard lock(halves_mutex_);
    whole_parts_.push_back(leaves);
}

// Branches are cut independently, but calls come one at a time.
void CutsOnRanks::on_cut(const Surface& parent, const Cut& cut) {
    const std::lock_guard lock(listener_mutex_);
    next_->on_cut(parent, cut);
}

void CutsOnRanks::tell(int rank, Kind kind, std::int32_t leaves) {
    if (rank == ranks_.rank())
        hear({kind, leaves});
    else
        tell_or_leave(ranks_, status_, [&] { ranks_.post(rank, to_bytes(CutNote{kind, leaves})); });
}

void CutsOnRanks::tell_others(Kind kind) {
    for (int rank = first_rank + 1; rank < ranks_.size(); ++rank) tell(rank, kind);
}

void CutsOnRanks::hear(const CutNote& note) {
    switch (note.kind) {
        case Kind::done:
            if (++ranks_done_ < ranks_.size()) return;
            tell_others(Kind::end);
            has_ended_ = true;
            return;
        case Kind::failed:
            if (!is_stopped_.exchange(true)) tell_others(Kind::stop);
            return;
        case Kind::stop:
            is_stopped_ = true;
            return;
        case Kind::end:
            has_ended_ = true;
            return;
        case Kind::accounted:
            accounted_ += note.leaves;
            return;
    }
}

// Tells the ranks that wait for leaves of a part that stays whole here.
void CutsOnRanks::tell_of_whole_part(const LeafRange& leaves) {
    for (std::int32_t leaf = range_.last; leaf < leaves.last;) {
        const int rank = rank_in_range(options_.parts, leaf, ranks_);
        const std::int32_t end = std::min(leaves.last, range_of_rank(options_.parts, rank, ranks_).last);
        tell(rank, Kind::accounted, end - leaf);
        leaf = end;
    }
}

void CutsOnRanks::begin(Complex& complex) {
    if (complex.region_count() > 1) {
        begin([this, &complex] { return decompose_regions(complex, options_, range_, *this, this); });
        return;
    }
    if (ranks_.rank() != first_rank) return;
    const Branch whole{root_node, 0, options_.parts, {}};
    if (!range_.contains(0))
        return take(whole, complex.take_only_region());  // of fewer parts than ranks, this rank may have none
    begin([this, whole, surface = complex.take_only_region()]() mutable {
        return decompose_branch(std::move(surface), whole, options_, range_, *this, this);
    });
}

void CutsOnRanks::cut_arrived(Bytes message) {
    begin([this, bytes = std::move(message)]() mutable {
        auto travelled = from_bytes<TravellingBranch>(std::exchange(bytes, {}));
        Surface surface = surface_of(travelled);
        return decompose_branch(std::move(surface), travelled.branch, options_, range_, *this, this);
    });
}

// Takes the result of a job that has ended; false if none has.
bool CutsOnRanks::collect() {
    const auto ended = std::find_if(jobs_.begin(), jobs_.end(), [](std::future<Decomposition>& job) {
        return job.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    });
    if (ended == jobs_.end()) return false;
    std::future<Decomposition> job = std::move(*ended);
    jobs_.erase(ended);
    finished_.push_back(job.get());
    for (const Leaf& leaf : finished_.back().leaves)
        accounted_ += std::min(leaf.first_leaf + leaf.leaves, range_.last) - leaf.first_leaf;
    return true;
}

// Sends halves and notes to other ranks; false if there were no halves.
bool CutsOnRanks::pass_on() {
    std::list<Half> halves;
    std::vector<LeafRange> whole_parts;
    {
        const std::lock_guard lock(halves_mutex_);
        halves.swap(halves_);
        whole_parts.swap(whole_parts_);
    }
    if (is_stopped_) return false;
    for (const LeafRange& leaves : whole_parts) tell_of_whole_part(leaves);
    for (Half& half : halves) {
        TravellingBranch leaving{half.branch, half.surface.arrays(), partners_of(half.surface)};
        half.surface = Surface();
        Bytes message = to_bytes(std::exchange(leaving, {}));
        ranks_.send(rank_in_range(options_.parts, half.branch.first_leaf, ranks_), std::move(message));
    }
    return !halves.empty();
}

// Does everything that can be done now; false if there was nothing to do.
bool CutsOnRanks::step() {
    bool was_busy = false;
    while (const std::optional<Bytes> note = ranks_.poll()) hear(from_bytes<CutNote>(*note));
    if (std::optional<Bytes> message = ranks_.receive_any()) {
        was_busy = true;
        if (!is_stopped_) cut_arrived(std::move(*message));
    }
    was_busy |= collect();
    was_busy |= pass_on();
    if (is_done_) return was_busy;
    if (next_ && next_->cancelled() && !is_stopped_) throw Error(ErrorCode::cancelled, "The run was cancelled.");
    const bool has_all = is_stopped_ || accounted_ == range_.last - range_.first;
    if (has_all && jobs_.empty() && !was_busy) {
        is_done_ = true;
        tell(first_rank, Kind::done);
    }
    return was_busy;
}

void CutsOnRanks::fail() {
    if (status_.code == 0) status_ = status_of_exception();
    if (is_stopped_) return;
    if (ranks_.rank() != first_rank) is_stopped_ = true;
    tell(first_rank, Kind::failed);
}

// Brings the branches, which were cut in any order, into the order of the tree.
Decomposition CutsOnRanks::in_order() {
    Decomposition whole;
    for (Decomposition& branch : finished_) {
        std::move(branch.nodes.begin(), branch.nodes.end(), std::back_inserter(whole.nodes));
        std::move(branch.leaves.begin(), branch.leaves.end(), std::back_inserter(whole.leaves));
        if (!branch.contacts.empty()) whole.contacts = std::move(branch.contacts);
    }
    const auto depth_first = [](const auto& a, const auto& b) {
        return std::pair(a.first_leaf, -a.leaves) < std::pair(b.first_leaf, -b.leaves);
    };
    std::sort(whole.nodes.begin(), whole.nodes.end(), depth_first);
    std::sort(whole.leaves.begin(), whole.leaves.end(), depth_first);
    return whole;
}

Decomposition CutsOnRanks::cut(Complex& complex) {
    const auto guarded = [this](const auto& body) {
        try {
            return body();
        } catch (const RankHasLeft&) {
            is_stopped_ = true;  // nobody takes the branches that are being cut
            throw;
        } catch (const std::exception&) {
            fail();
            return true;
        }
    };
    guarded([&] {
        begin(complex);
        return true;
    });
    for (Patience patience; !has_ended_;)
        if (guarded([&] { return step(); }))
            patience.reset();
        else
            patience.pause();
    ranks_.drop_messages();  // the note of a rank that has failed at the very end may still be on its way
    throw_first_error(ranks_, status_);
    return in_order();
}

}  // namespace

Decomposition decompose_on_ranks(Communicator& ranks, Complex& complex, const DecomposeOptions& options,
                                 CutListener* listener) {
    KERF_CHECK(ranks.size() > 1);
    return CutsOnRanks(ranks, options, listener).cut(complex);
}

}  // namespace kerf

#include "run/volume_stage.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <numeric>

#include <fmt/format.h>

#include "core/stopwatch.h"
#include "io/checked_file.h"
#include "run/forecast.h"
#include "work/failed_part.h"
#include "work/journal.h"

namespace kerf {

namespace {

constexpr int root = 0;
// How long a rank sleeps before it looks for messages and signals. Those with workers wake when one ends.
constexpr double busy_seconds = 0.02, idle_seconds = 0.005;

void remove_file(const std::string& path) {
    std::error_code error;
    std::filesystem::remove(path, error);
    if (error)
        throw Error(ErrorCode::io, fmt::format("Cannot remove {}: {}. Check the permissions of the output folder.",
                                               path, error.message()));
}

// What others are told of a part.
PartReport without_quality(PartReport part) {
    part.result.quality = PartQuality();
    part.result.improvement.smallest_before = Distribution();
    return part;
}

}  // namespace

// What ranks tell each other while they mesh.
struct VolumeStage::Message {
    enum class Kind : char { wish, assignment, part_done, all_done, stop };
    Kind kind = Kind::stop;
    std::int32_t number = 0;       // of the rank that wishes for a part; of the part that is assigned, in their order
    std::vector<PartReport> part;  // the one that is done

    template <class Archive>
    void archive(Archive& a) {
        a(kind, number, part);
    }
};

// Each part goes to one rank: the root rank knows which is next, the others ask it.
class VolumeStage::HandOut {
 public:
    // `on_taken` gets the places of the parts that this rank takes.
    HandOut(Communicator& ranks, std::size_t parts, PartQueue& queue, std::function<void(std::size_t)> on_taken)
        : ranks_(ranks), parts_(static_cast<std::int32_t>(parts)), queue_(queue), on_taken_(std::move(on_taken)) {}

    // A part for each worker that is free, now or when the answer comes.
    void fill() {
        if (ranks_.rank() == root) {
            for (; queue_.free_workers() > 0 && next_ < parts_; ++next_) take(next_);
            return;
        }
        for (; next_ < parts_ && wishes_ < queue_.free_workers(); ++wishes_)
            ranks_.post(root, to_bytes(Message{Message::Kind::wish, ranks_.rank(), {}}));
    }
    // On the root rank. Beyond the last part the number says that there is none.
    void answer(const Message& wish) {
        ranks_.post(wish.number, to_bytes(Message{Message::Kind::assignment, next_, {}}));
        if (next_ < parts_) ++next_;
    }
    // On the others.
    void receive(const Message& assignment) {
        --wishes_;
        next_ = assignment.number;
        if (next_ < parts_) take(next_);
    }
    bool is_waiting() const { return wishes_ > 0; }

 private:
    void take(std::int32_t part) {
        on_taken_(static_cast<std::size_t>(part));
        queue_.add(static_cast<std::size_t>(part));
    }

    Communicator& ranks_;
    std::int32_t parts_ = 0, next_ = 0;
    std::size_t wishes_ = 0;  // without an answer
    PartQueue& queue_;
    std::function<void(std::size_t)> on_taken_;
};

// What the root rank knows about all parts.
class VolumeStage::Tally {
 public:
    Tally(const std::vector<PartReport>& parts, const RunOptions& options, int ranks, RunListener* listener)
        : listener_(listener), forecast_(parts, options, ranks), total_(parts.size()) {
        for (const PartReport& part : parts) load_ += part.load;
        if (listener_) listener_->on_progress("volume", 0, total_);
        for (const PartReport& part : parts)
            if (part.resumed) add(part);
    }
    void add(const PartReport& part) {
        ++done_;
        load_done_ += part.load;
        tets_ += part.result.tets;
        forecast_.add(part);
        if (!listener_) return;
        listener_->on_part({&part, done_, total_, load_ > 0 ? std::min(1.0, load_done_ / load_) : 1, tets_,
                            forecast_.tets(), forecast_.seconds_left(stopwatch_.seconds())});
        listener_->on_progress("volume", done_, total_);
    }
    bool all_done() const { return done_ == total_; }

 private:
    RunListener* listener_;
    RunningForecast forecast_;
    Stopwatch stopwatch_;
    std::size_t done_ = 0, total_ = 0;
    double load_ = 0, load_done_ = 0;
    std::int64_t tets_ = 0;
};

void VolumeStage::hand_over(const PartJob& job, PartReport& part) {
    const std::string journal = folder_.journal_file(part.id), file = folder_.stored_part_file(part.id);
    if (plan_.options.transient) return write_job(folder_.job_file(part.id), job);
    const std::string vtu_file = folder_.part_file(part.id);
    MesherOptions mesher = plan_.options.mesher;
    mesher.size = plan_.options.decompose.region_sizes.of(part.region, mesher.size).within(part.box());
    part.job_hash = hash_of_job(job, mesher, plan_.options.attempts, plan_.worker_hash);
    std::error_code ignored;
    if (std::filesystem::exists(journal, ignored) && !std::filesystem::exists(file, ignored))
        restore_stored_part(file, vtu_file, job);
    remove_file(vtu_file);
    if (const auto outcome = find_finished_part(journal, file, part.job_hash, plan_.options.timeout_seconds)) {
        static_cast<PartOutcome&>(part) = *outcome;
        part.resumed = true;
        add_quality(part.result);
        part = without_quality(std::move(part));
        return;
    }
    for (const std::string& stale : {journal, file}) remove_file(stale);
    write_job(folder_.job_file(part.id), job);
}

void VolumeStage::add_quality(const PartResult& result) {
    own_.quality.add(result.quality);
    own_.improvement.add(result.improvement);
}

std::vector<std::size_t> VolumeStage::waiting_parts(const std::vector<PartReport>& parts) const {
    std::vector<std::size_t> order(parts.size());
    std::iota(order.begin(), order.end(), 0);
    std::erase_if(order, [&](std::size_t i) { return parts[i].resumed; });
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return parts[a].load > parts[b].load; });
    return order;
}

void VolumeStage::keep_outcome(const PartReport& part) const {
    const auto code = static_cast<ErrorCode>(part.result.code);
    if (code == ErrorCode::io) throw Error(code, part.result.message);
    const std::string job_file = folder_.job_file(part.id);
    if (plan_.options.transient) return remove_file(job_file);
    if (part.result.code)
        write_failed_part(folder_.file("failed"), part.id, read_job(job_file).surface, plan_.options.mesher,
                          part.result.message);
    else
        write_journal_entry(folder_.journal_file(part.id),
                            {part.job_hash, part.timed_out ? plan_.options.timeout_seconds : 0, part});
    remove_file(job_file);
}

void VolumeStage::post_to_others(const Message& message) {
    const Bytes bytes = to_bytes(message);
    for (int rank = 0; rank < ranks_.size(); ++rank)
        if (rank != ranks_.rank()) ranks_.post(rank, bytes);
}

PartQueue VolumeStage::queue_of(const std::vector<PartReport>& parts, const std::vector<std::size_t>& order) const {
    std::vector<QueuedPart> queued;
    for (const std::size_t i : order)
        queued.push_back({folder_.job_file(parts[i].id), folder_.stored_part_file(parts[i].id), parts[i].box()});
    return {std::move(queued),
            {plan_.options.worker_program, plan_.options.mesher, plan_.options.workers, plan_.options.timeout_seconds,
             plan_.options.memory_mb, plan_.options.attempts, !plan_.options.transient}};
}

VolumeStage::HandOut VolumeStage::hand_out_to(PartQueue& queue, const std::vector<PartReport>& parts,
                                              const std::vector<std::size_t>& order) const {
    return {ranks_, order.size(), queue, [&](std::size_t place) {
                if (!plan_.options.transient) CheckedFile(folder_.begun_file(parts[order[place]].id), "wb").close();
            }};
}

// Returns whether all parts are done.
bool VolumeStage::take_messages(HandOut& hand_out, Tally* tally, bool& was_told_to_stop) {
    while (const std::optional<Bytes> bytes = ranks_.poll()) {
        const auto message = from_bytes<Message>(*bytes);
        switch (message.kind) {
            case Message::Kind::wish:
                hand_out.answer(message);
                break;
            case Message::Kind::assignment:
                hand_out.receive(message);
                break;
            case Message::Kind::part_done:
                tally->add(message.part.front());
                break;
            case Message::Kind::all_done:
                return true;
            case Message::Kind::stop:
                was_told_to_stop = true;
                throw Error(ErrorCode::cancelled, "The run was cancelled.");  // or an error of the sender says why
        }
    }
    if (!tally || !tally->all_done()) return false;
    post_to_others({Message::Kind::all_done, 0, {}});
    return true;
}

void VolumeStage::keep_finished(PartReport part, Tally* tally) {
    keep_outcome(part);
    if (tally)
        tally->add(part);
    else
        ranks_.post(root, to_bytes(Message{Message::Kind::part_done, 0, {without_quality(part)}}));
    if (part.result.tets > 0) add_quality(part.result);
    own_.parts.push_back(without_quality(std::move(part)));
}

MeshedParts VolumeStage::mesh(const std::vector<PartReport>& parts) {
    bool was_told_to_stop = false;
    const auto mesh_share = [&] {
        std::optional<Tally> tally;  // on the root rank
        if (ranks_.rank() == root) tally.emplace(parts, plan_.options, ranks_.size(), listener_);
        const std::vector<std::size_t> order = waiting_parts(parts);
        PartQueue queue = queue_of(parts, order);
        HandOut hand_out = hand_out_to(queue, parts, order);
        for (;;) {
            end_if_cancelled(listener_);
            if (take_messages(hand_out, tally ? &*tally : nullptr, was_told_to_stop)) return;
            hand_out.fill();
            auto finished = queue.step(queue.empty() || hand_out.is_waiting() ? idle_seconds : busy_seconds);
            // A signal to all processes of a terminal or a job ends workers, too: that is no failure of their parts.
            if (!finished || (listener_ && listener_->cancelled())) continue;
            PartReport part = parts[order[finished->part]];
            static_cast<PartOutcome&>(part) = std::move(finished->outcome);
            part.rank = ranks_.rank();
            keep_finished(std::move(part), tally ? &*tally : nullptr);
        }
    };
    try {
        in_agreement(ranks_, [&] {
            try {
                mesh_share();
            } catch (...) {
                if (!was_told_to_stop) post_to_others({Message::Kind::stop, 0, {}});
                throw;
            }
        });
    } catch (const Error&) {
        ranks_.drop_messages();
        throw;
    }
    ranks_.drop_messages();
    return gather(parts);
}

MeshedParts VolumeStage::gather(std::vector<PartReport> parts) {
    MeshedParts all{std::move(parts), PartQuality(length_scale_), {}};
    std::map<NodeId, PartReport*> by_id;
    for (PartReport& part : all.parts) by_id[part.id] = &part;
    for (std::vector<PartReport>& of_rank : all_gather(ranks_, own_.parts))
        for (PartReport& part : of_rank) *by_id[part.id] = std::move(part);
    for (const PartQuality& of_rank : all_gather(ranks_, own_.quality)) all.quality.add(of_rank);
    for (const Improvement& of_rank : all_gather(ranks_, own_.improvement)) all.improvement.add(of_rank);
    return all;
}

}  // namespace kerf

// Each rank runs one loop: it looks for messages, asks the root rank for a part for each worker that is free, and lets
// its PartQueue step; in between it sleeps. The root rank has the tickets and the tally; it tells all ranks `all_done`
// when every part has ended. No rank waits for a message. A rank that fails posts `stop`, and the agreement in which
// the stage ends carries its error; messages that are still on their way then are dropped, so that no later stage reads
// them. A place is the number of a part in the list of those that wait, in descending load: tickets, messages and the
// queue name parts by it.
//
// A part that was filled gets an entry in the journal (run/work/journal.h), with the hash of its job, before its job is
// removed; a failed part leaves a reproducer. The entry is all that resuming needs: hand_over() takes a part as
// finished where an entry has the hash of the job that it would write, for the same build of the worker, and the stored
// part is there.
#include "run/run/inside/volume_stage.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <numeric>

#include <fmt/format.h>

#include "base/core/host_name.h"
#include "base/core/ids.h"
#include "base/core/stopwatch.h"
#include "files/io/checked_file.h"
#include "run/run/inside/forecast.h"
#include "run/work/failed_part.h"
#include "run/work/journal.h"

namespace kerf {

namespace {

constexpr int root = 0;
// Sleep of a rank between looks for messages and signals. Those with workers wake when one ends. A worker is
// idle between a wish and its answer.
constexpr double seconds_between_looks = 0.02, seconds_between_answers = 0.002;

void remove_file(const std::string& path) {
    std::error_code error;
    std::filesystem::remove(path, error);
    if (error)
        throw Error(ErrorCode::io, fmt::format("Cannot remove {}: {}. Check the permissions of the output folder.",
                                               path, error.message()));
}

// Returns the sum over the ranks, on every rank. No rank holds more than two summands at a time.
template <class T>
T add_up(Communicator& ranks, T own) {
    const int size = ranks.size();
    for (int step = 1; step < size; step *= 2) {
        std::vector<Bytes> out(size);
        if (ranks.rank() % (2 * step) == step) out[ranks.rank() - step] = to_bytes(own);
        for (const Bytes& bytes : ranks.exchange(std::move(out)))
            if (!bytes.empty()) own.add(from_bytes<T>(bytes));
    }
    return from_bytes<T>(ranks.broadcast(to_bytes(own), root));
}

// The number of each rank's host.
std::vector<std::int32_t> number_hosts(Communicator& ranks) {
    std::map<std::string, std::int32_t> numbers;
    std::vector<std::int32_t> of_rank;
    for (const std::string& host : all_gather(ranks, host_name()))
        of_rank.push_back(numbers.try_emplace(host, count_of(numbers)).first->second);
    return of_rank;
}

// A part as others are told of it.
PartReport without_quality(PartReport part) {
    part.result.quality = PartQuality();
    part.result.improvement.smallest_before = Distribution();
    return part;
}

}  // namespace

// Counts the parts that have ended, on the root rank, and tells the listener.
class VolumeStage::Tally {
 public:
    Tally(const std::vector<PartReport>& parts, const RunPlan& plan, int ranks, RunListener* listener)
        : listener_(listener),
          forecast_(parts, plan.mesher(), ranks * plan.request().workers.count),
          total_(parts.size()) {
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
    if (plan_.request().transient) return write_job(folder_.job_file(part.id), job);
    const std::string vtu_file = folder_.part_file(part.id);
    const MesherOptions mesher(plan_.request().mesher, plan_.size_in(part.region).within(part.box));
    part.job_hash = hash_of_job(job, mesher, plan_.request().workers.attempts, plan_.worker_hash);
    std::error_code ignored;
    if (std::filesystem::exists(journal, ignored) && !std::filesystem::exists(file, ignored))
        restore_stored_part(file, vtu_file, job);
    remove_file(vtu_file);
    if (const auto outcome =
            find_finished_part(journal, file, part.job_hash, plan_.request().workers.timeout_seconds)) {
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
    if (plan_.request().transient) return remove_file(job_file);
    if (part.result.code)
        write_failed_part(folder_.file("failed"), part.id, read_job(job_file).surface, plan_.mesher(),
                          part.result.message);
    else
        write_journal_entry(folder_.journal_file(part.id),
                            {part.job_hash, part.timed_out ? plan_.request().workers.timeout_seconds : 0, part});
    remove_file(job_file);
}

void VolumeStage::post_to_others(const VolumeMessage& message) {
    const Bytes bytes = to_bytes(message);
    for (int rank = 0; rank < ranks_.size(); ++rank)
        if (rank != ranks_.rank()) ranks_.post(rank, bytes);
}

PartQueue VolumeStage::queue_of(const std::vector<PartReport>& parts, const std::vector<std::size_t>& order) const {
    std::vector<QueuedPart> queued;
    for (const std::size_t i : order)
        queued.push_back({folder_.job_file(parts[i].id), folder_.stored_part_file(parts[i].id),
                          plan_.size_in(parts[i].region), parts[i].box});
    const WorkerOptions& workers = plan_.request().workers;
    return {std::move(queued),
            {workers.program, plan_.mesher(), workers.count, workers.timeout_seconds, workers.memory_mb,
             workers.attempts, !plan_.request().transient}};
}

PartHandOut VolumeStage::hand_out_to(PartQueue& queue, const std::vector<PartReport>& parts,
                                     const std::vector<std::size_t>& order,
                                     const std::vector<std::int32_t>& host_of_rank) const {
    std::vector<WaitingPart> waiting;
    for (const std::size_t i : order) waiting.push_back({parts[i].load, host_of_rank[parts[i].rank]});
    return {ranks_, std::move(waiting), host_of_rank, [&](std::size_t place) {
                if (!plan_.request().transient) CheckedFile(folder_.begun_file(parts[order[place]].id), "wb").close();
                queue.add(place);
            }};
}

// Returns whether all parts are done.
bool VolumeStage::take_messages(PartHandOut& hand_out, Tally* tally, bool& was_told_to_stop) {
    while (const std::optional<Bytes> bytes = ranks_.poll()) {
        const auto message = from_bytes<VolumeMessage>(*bytes);
        switch (message.kind) {
            case VolumeMessage::Kind::wish:
                hand_out.answer(message);
                break;
            case VolumeMessage::Kind::assignment:
                hand_out.receive(message);
                break;
            case VolumeMessage::Kind::part_done:
                tally->add(message.part.front());
                break;
            case VolumeMessage::Kind::all_done:
                return true;
            case VolumeMessage::Kind::stop:
                was_told_to_stop = true;
                throw Error(ErrorCode::cancelled, "The run was cancelled.");  // or an error of the sender says why
        }
    }
    if (!tally || !tally->all_done()) return false;
    post_to_others({VolumeMessage::Kind::all_done, -1, {}});
    return true;
}

void VolumeStage::keep_finished(PartReport part, Tally* tally) {
    keep_outcome(part);
    if (tally)
        tally->add(part);
    else
        ranks_.post(root, to_bytes(VolumeMessage{VolumeMessage::Kind::part_done, -1, {without_quality(part)}}));
    if (part.result.tets > 0) add_quality(part.result);
    own_.parts.push_back(without_quality(std::move(part)));
}

MeshedParts VolumeStage::mesh(const std::vector<PartReport>& parts) {
    bool was_told_to_stop = false;
    const std::vector<std::int32_t> host_of_rank = number_hosts(ranks_);
    const auto mesh_share = [&] {
        std::optional<Tally> tally;  // on the root rank
        if (ranks_.rank() == root) tally.emplace(parts, plan_, ranks_.size(), listener_);
        const std::vector<std::size_t> order = waiting_parts(parts);
        PartQueue queue = queue_of(parts, order);
        PartHandOut hand_out = hand_out_to(queue, parts, order, host_of_rank);
        for (;;) {
            end_if_cancelled(listener_);
            if (take_messages(hand_out, tally ? &*tally : nullptr, was_told_to_stop)) return;
            hand_out.fill(queue.free_workers());
            const bool somebody_waits = hand_out.is_waiting() || (tally && ranks_.size() > 1);
            auto finished = queue.step(somebody_waits ? seconds_between_answers : seconds_between_looks);
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
                const auto stop_others = [&] { post_to_others({VolumeMessage::Kind::stop, -1, {}}); };
                if (!was_told_to_stop) tell_or_leave(ranks_, status_of_exception(), stop_others);
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
    MeshedParts all{std::move(parts), add_up(ranks_, std::move(own_.quality)),
                    add_up(ranks_, std::move(own_.improvement))};
    std::map<NodeId, PartReport*> by_id;
    for (PartReport& part : all.parts) by_id[part.id] = &part;
    for (std::vector<PartReport>& of_rank : all_gather(ranks_, own_.parts))
        for (PartReport& part : of_rank) *by_id[part.id] = std::move(part);
    return all;
}

}  // namespace kerf

#include "run/run/inside/part_hand_out.h"

#include <utility>

namespace kerf {

namespace {

constexpr int rank_of_tickets = 0;

}  // namespace

PartHandOut::PartHandOut(Communicator& ranks, std::vector<WaitingPart> waiting, std::vector<std::int32_t> host_of_rank,
                         std::function<void(std::size_t)> on_taken)
    : ranks_(ranks),
      tickets_(ranks.rank() == rank_of_tickets ? std::move(waiting) : std::vector<WaitingPart>()),
      host_of_rank_(std::move(host_of_rank)),
      on_taken_(std::move(on_taken)) {}

void PartHandOut::fill(std::size_t free_workers) {
    if (ranks_.rank() != rank_of_tickets) {
        for (; is_anything_left_ && wishes_ < free_workers; ++wishes_)
            ranks_.post(rank_of_tickets, to_bytes(VolumeMessage{VolumeMessage::Kind::wish, ranks_.rank(), {}}));
        return;
    }
    for (; is_anything_left_ && free_workers > 0; --free_workers) {
        const std::optional<std::size_t> part = tickets_.take(host_of_rank_[rank_of_tickets]);
        is_anything_left_ = part.has_value();
        if (part) on_taken_(*part);
    }
}

void PartHandOut::answer(const VolumeMessage& wish) {
    const std::optional<std::size_t> part = tickets_.take(host_of_rank_[wish.number]);
    ranks_.post(wish.number, to_bytes(VolumeMessage{
                                 VolumeMessage::Kind::assignment, part ? static_cast<std::int32_t>(*part) : -1, {}}));
}

void PartHandOut::receive(const VolumeMessage& assignment) {
    --wishes_;
    is_anything_left_ = assignment.number >= 0;
    if (is_anything_left_) on_taken_(assignment.number);
}

}  // namespace kerf

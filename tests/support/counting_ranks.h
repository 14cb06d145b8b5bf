// What ranks tell each other, counted.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/parallel/communicator.h"

namespace kerf::test {

/// What leaves a rank for others, or is passed on, and what comes to it.
struct Traffic {
    std::int64_t sent_bytes = 0, received_bytes = 0;
    std::int64_t messages = 0;  ///< that leave it

    std::int64_t bytes() const { return sent_bytes + received_bytes; }
};

/// A communicator that counts for its rank what a network would carry for it: where everything goes to everyone, along
/// a ring; a broadcast and a sum along a tree; an exchange straight, with the sizes of all messages before it, and no
/// message where there is nothing to say.
class CountingRanks : public Communicator {
 public:
    explicit CountingRanks(Communicator& ranks) : ranks_(ranks) {}
    const Traffic& traffic() const { return traffic_; }

    int rank() const override { return ranks_.rank(); }
    int size() const override { return ranks_.size(); }
    std::vector<Bytes> all_gather(const Bytes& contribution) override {
        std::vector<Bytes> all = ranks_.all_gather(contribution);
        std::int64_t of_others = -std::ssize(contribution);
        for (const Bytes& bytes : all) of_others += std::ssize(bytes);
        count(of_others, of_others, size() - 1);
        return all;
    }
    Bytes broadcast(Bytes of_root, int root) override {
        Bytes bytes = ranks_.broadcast(std::move(of_root), root);
        const bool is_root = rank() == root;
        count(size() > 1 ? std::ssize(bytes) : 0, is_root ? 0 : std::ssize(bytes), depth());
        return bytes;
    }
    std::vector<Bytes> exchange(std::vector<Bytes> to_rank) override {
        const std::int64_t sizes = 8 * (size() - 1);
        count(sizes, sizes, depth());
        for (int r = 0; r < size(); ++r)
            if (const std::int64_t bytes = std::ssize(to_rank[static_cast<std::size_t>(r)]); r != rank() && bytes > 0)
                count(bytes, 0, 1);
        std::vector<Bytes> got = ranks_.exchange(std::move(to_rank));
        for (int r = 0; r < size(); ++r)
            if (r != rank()) count(0, std::ssize(got[static_cast<std::size_t>(r)]), 0);
        return got;
    }
    void sum(std::span<std::uint64_t> words) override {
        const std::int64_t bytes = depth() * static_cast<std::int64_t>(words.size_bytes());
        count(bytes, bytes, depth());
        ranks_.sum(words);
    }
    void send(int rank, Bytes message) override {
        count(std::ssize(message), 0, 1);
        ranks_.send(rank, std::move(message));
    }
    Bytes receive(int rank) override {
        Bytes message = ranks_.receive(rank);
        count(0, std::ssize(message), 0);
        return message;
    }
    std::optional<Bytes> receive_any() override { return counted(ranks_.receive_any()); }
    void post(int rank, const Bytes& message) override {
        count(std::ssize(message), 0, 1);
        ranks_.post(rank, message);
    }
    std::optional<Bytes> poll() override { return counted(ranks_.poll()); }
    void drop_messages() override { ranks_.drop_messages(); }
    void leave(const StageStatus& why) override { ranks_.leave(why); }

 private:
    std::optional<Bytes> counted(std::optional<Bytes> message) {
        if (message) count(0, std::ssize(*message), 0);
        return message;
    }
    // Of a tree of all ranks.
    std::int64_t depth() const { return std::bit_width(static_cast<unsigned>(size() - 1)); }
    void count(std::int64_t sent, std::int64_t received, std::int64_t messages) {
        traffic_.sent_bytes += sent;
        traffic_.received_bytes += received;
        traffic_.messages += messages;
    }

    Communicator& ranks_;
    Traffic traffic_;
};

}  // namespace kerf::test

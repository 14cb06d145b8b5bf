// What every communicator promises, whatever carries its messages.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "base/core/mixed_bits.h"
#include "base/parallel/on_root.h"

namespace kerf::test {

/// What one rank says to another one: so many bytes that nobody else says.
inline Bytes words_of(int from, int to, std::size_t size) {
    Bytes bytes(size);
    const std::uint64_t first = mixed_bits(static_cast<std::uint64_t>(1000 * from + to + 1));
    for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<char>((first + i * 0x9e3779b97f4a7c15) >> 56);
    return bytes;
}

/// Collective: each kind of message, of which the largest has this size. Sizes of the ranks differ, and some are 0.
inline void expect_collectives(Communicator& ranks, std::size_t largest) {
    const int size = ranks.size(), own = ranks.rank();
    const auto size_of = [&](int from, int to) {
        const std::uint64_t chance = mixed_bits(static_cast<std::uint64_t>(from * size + to)) % 4;
        return chance == 0 ? 0 : largest / chance;
    };
    const std::vector<Bytes> gathered = ranks.all_gather(words_of(own, own, size_of(own, own)));
    ASSERT_EQ(std::ssize(gathered), size);
    for (int r = 0; r < size; ++r) EXPECT_EQ(gathered[r], words_of(r, r, size_of(r, r))) << "gathered from " << r;
    std::vector<Bytes> to_rank;
    for (int r = 0; r < size; ++r) {
        EXPECT_EQ(ranks.broadcast(words_of(own, r, own == r ? largest : 3), r), words_of(r, r, largest)) << r;
        to_rank.push_back(words_of(own, r, size_of(own, r)));
    }
    const std::vector<Bytes> got = ranks.exchange(std::move(to_rank));
    ASSERT_EQ(std::ssize(got), size);
    for (int r = 0; r < size; ++r) EXPECT_EQ(got[r], words_of(r, own, size_of(r, own))) << "exchanged with " << r;
    if (size < 2) return;
    const int next = (own + 1) % size, before = (own + size - 1) % size;
    for (const std::size_t message : {largest, std::size_t{0}, std::size_t{7}}) {  // nobody waits for himself
        if (own == 0) ranks.send(next, words_of(own, next, message));
        EXPECT_EQ(ranks.receive(before), words_of(before, own, message));
        if (own != 0) ranks.send(next, words_of(own, next, message));
    }
    if (own != 0) return ranks.send(0, words_of(own, 0, largest));
    std::vector<Bytes> of_others;
    while (std::ssize(of_others) < size - 1)
        if (std::optional<Bytes> message = ranks.receive_any()) of_others.push_back(*std::move(message));
    for (int r = 1; r < size; ++r)
        EXPECT_EQ(std::count(of_others.begin(), of_others.end(), words_of(r, 0, largest)), 1) << "of " << r;
}

/// Collective: sums of none, one and many words.
inline void expect_sums(Communicator& ranks) {
    const auto size = static_cast<std::uint64_t>(ranks.size()), own = static_cast<std::uint64_t>(ranks.rank());
    const std::uint64_t all = size * (size - 1) / 2;
    for (const std::size_t count : {0, 1, 2, 1001}) {
        std::vector<std::uint64_t> words(count), expected(count);
        for (std::size_t i = 0; i < count; ++i) words[i] = own * i - 1, expected[i] = all * i - size;
        ranks.sum(words);
        EXPECT_EQ(words, expected);
    }
    EXPECT_EQ(sum_of(ranks, std::numeric_limits<std::int64_t>::min() / ranks.size()),
              std::numeric_limits<std::int64_t>::min() / ranks.size() * ranks.size());
    EXPECT_EQ(sum_of(ranks, ranks.rank() == 0), true);
}

/// Collective: items to owners and to one rank.
inline void expect_exchanged_items(Communicator& ranks) {
    const int size = ranks.size(), own = ranks.rank();
    std::vector<std::vector<std::string>> items(static_cast<std::size_t>(size));
    for (int r = 0; r < size; ++r)
        items[r].assign(static_cast<std::size_t>((own + r) % 3), std::to_string(100 * own + r));
    const auto got = exchange_items(ranks, std::move(items));
    for (int r = 0; r < size; ++r)
        EXPECT_EQ(got[r],
                  std::vector<std::string>(static_cast<std::size_t>((own + r) % 3), std::to_string(100 * r + own)));
    std::vector<int> expected;
    for (int r = 0; r < size; ++r) expected.insert(expected.end(), static_cast<std::size_t>(r % 3), r);
    const int root = size - 1;
    const std::vector<int> gathered =
        gather_items_to(ranks, root, std::vector<int>(static_cast<std::size_t>(own % 3), own));
    EXPECT_EQ(gathered, own == root ? expected : std::vector<int>());
}

/// Collective: messages that nobody waits for arrive in their order, until they are dropped.
inline void expect_posts(Communicator& ranks) {
    const int size = ranks.size(), own = ranks.rank(), next = (own + 1) % size;
    if (size == 1) return;
    for (const int i : {0, 1, 2}) ranks.post(next, to_bytes(10 * own + i));
    for (int i = 0; i < 3; ++i) {
        std::optional<Bytes> message;
        while (!message) message = ranks.poll();
        EXPECT_EQ(from_bytes<int>(*message), 10 * ((own + size - 1) % size) + i);
    }
    ranks.drop_messages();  // of others, which may be ahead, nothing else comes before that
    ranks.post(next, to_bytes(7));
    ranks.drop_messages();
    EXPECT_FALSE(ranks.poll());
}

/// What a rank may be at when another one, the last, leaves.
struct Waiting {
    const char* name;
    std::function<void(Communicator&)> wait;
};

template <class HasCome>
void wait_until(HasCome has_come) {
    for (Patience patience; !has_come();) patience.pause();
}

inline std::vector<Waiting> ways_to_wait() {
    const auto large = [] { return Bytes(std::size_t{1} << 18, 'a'); };
    return {{"all_gather", [=](Communicator& ranks) { ranks.all_gather(large()); }},
            {"broadcast", [=](Communicator& ranks) { ranks.broadcast(large(), 0); }},
            {"exchange",
             [=](Communicator& ranks) {
                 ranks.exchange(std::vector<Bytes>(static_cast<std::size_t>(ranks.size()), large()));
             }},
            {"sum", [](Communicator& ranks) { sum_of(ranks, 1); }},
            {"agreement", [](Communicator& ranks) { in_agreement(ranks, [] {}); }},
            {"drop_messages", [](Communicator& ranks) { ranks.drop_messages(); }},
            {"receive", [](Communicator& ranks) { ranks.receive(ranks.size() - 1); }},
            {"receive_any", [](Communicator& ranks) { wait_until([&] { return ranks.receive_any().has_value(); }); }},
            {"poll", [](Communicator& ranks) { wait_until([&] { return ranks.poll().has_value(); }); }},
            {"bytes_of_root",
             [](Communicator& ranks) {
                 bytes_of_root(
                     ranks, [] { return Bytes(1); }, [] {});
             }},
            {"send",
             [=](Communicator& ranks) {
                 ranks.send(ranks.size() - 1, large());
                 sum_of(ranks, 1);  // of messages that nobody has to wait for
             }},
            {"various", [=](Communicator& ranks) {
                 if (ranks.rank() % 2 == 0)
                     ranks.receive(ranks.size() - 1);
                 else
                     ranks.all_gather(large());
             }}};
}

/// Collective, on ranks that are good for nothing else afterwards.
inline void expect_that_leaving_ends_all(Communicator& ranks, const Waiting& waiting) {
    const bool is_last = ranks.rank() == ranks.size() - 1;
    try {
        run_together(ranks, [&] {
            if (is_last) throw Error(ErrorCode::io, "The disk is full.", {{ElementKind::facet, {7}, {}, {}}});
            waiting.wait(ranks);
        });
        ADD_FAILURE() << waiting.name << ": nothing was thrown";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::io) << waiting.name;
        EXPECT_STREQ(error.what(), "The disk is full.") << waiting.name;
    }
    ranks.leave({static_cast<int>(ErrorCode::internal), "This has happened already."});
    ranks.post(0, Bytes(1));
    ranks.drop_messages();
    const auto expect_end = [&](const char* call, const auto& look) {
        try {
            look();
            ADD_FAILURE() << call << " after " << waiting.name << ": nothing was thrown";
        } catch (const RankHasLeft& error) {
            EXPECT_EQ(error.code(), ErrorCode::io) << call << " after " << waiting.name;
            EXPECT_STREQ(error.what(), "The disk is full.") << call << " after " << waiting.name;
        }
    };
    expect_end("sum", [&] { sum_of(ranks, 1); });
    expect_end("poll", [&] { ranks.poll(); });
    expect_end("receive_any", [&] { ranks.receive_any(); });
    expect_end("receive", [&] { ranks.receive(0); });
    expect_end("send", [&] { ranks.send(0, Bytes(1)); });
}

}  // namespace kerf::test

// The ranks of one run, without MPI: the kernel sees messages only.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <exception>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/core/bytes.h"
#include "base/core/error.h"

namespace kerf {

/// The end of a stage on one rank.
struct StageStatus {
    int code = 0;  ///< value of ErrorCode, 0: good
    std::string message;
    std::vector<ErrorElements> elements = {};

    /// Returns the error that other ranks throw for it.
    Error error() const { return {static_cast<ErrorCode>(code), message, elements}; }

    template <class Archive>
    void archive(Archive& a) {
        a(code, message, elements);
    }
};

/// Returns the status of the exception that is being handled; where there is no memory for its words, that of memory
/// that has run out.
StageStatus status_of_exception() noexcept;

/// The error of a rank that has left: from now on the ranks agree on nothing else.
class RankHasLeft : public Error {
 public:
    using Error::Error;
};

/// Ranks that run the same stages in the same order. If one has no memory for a collective, it throws std::bad_alloc on
/// all ranks, which run_together() turns into Error(memory). Where a rank has left, every call that waits for others or
/// looks for their messages throws RankHasLeft, again and again.
class Communicator {
 public:
    virtual ~Communicator() = default;
    virtual int rank() const = 0;
    virtual int size() const = 0;
    /// Collective: returns the contributions of all ranks, in the order of ranks, on every rank.
    virtual std::vector<Bytes> all_gather(const Bytes& contribution) = 0;
    /// Collective: returns the bytes of the rank `root` on every rank; those that others give do not matter.
    virtual Bytes broadcast(Bytes of_root, int root) = 0;
    /// Collective: sends to_rank[r] to rank r, and returns the bytes that each rank has for this one, by rank. Memory
    /// and messages of a rank follow the bytes that it sends and gets, but for eight bytes a rank.
    virtual std::vector<Bytes> exchange(std::vector<Bytes> to_rank) = 0;
    /// Collective: replaces each of these words, of which every rank gives as many, by its sum over the ranks, modulo
    /// 2^64.
    virtual void sum(std::span<std::uint64_t> words) = 0;

    /// Sends another rank a message of any size, and waits until it is taken there. Not collective; but if a rank
    /// leaves meanwhile, its error is thrown here, as in receive().
    virtual void send(int rank, Bytes message) = 0;
    /// Returns the next message that the other rank sends to this one, and waits for it. Throws std::bad_alloc where
    /// there is no memory for it: the message is lost then, and its sender goes on.
    virtual Bytes receive(int rank) = 0;
    /// Returns the next message that some rank sends to this one; nothing if none is on its way. Throws as receive().
    virtual std::optional<Bytes> receive_any() = 0;

    /// Sends a message of a few kilobytes to another rank and does not wait for it to arrive. Without effect where a
    /// rank has left.
    virtual void post(int rank, const Bytes& message) = 0;
    /// Returns a message that was posted to this rank, those of one sender in their order; nothing if none has arrived
    /// yet. Throws RankHasLeft where no message will come because a rank has left: a loop that polls until one comes
    /// ends with it.
    virtual std::optional<Bytes> poll() = 0;
    /// Collective: takes all messages out of the way that were posted before and not polled. Without effect where a
    /// rank has left: then there are none.
    virtual void drop_messages() = 0;

    /// Tells the others of an error of this rank that they may know nothing of: their next collective, and every call
    /// in which they wait, throws it, without its elements. Returns when all know. Without effect where a rank has left
    /// already.
    virtual void leave(const StageStatus& why) = 0;
};

/// One rank alone.
class SingleRank : public Communicator {
 public:
    int rank() const override { return 0; }
    int size() const override { return 1; }
    std::vector<Bytes> all_gather(const Bytes& contribution) override { return {contribution}; }
    Bytes broadcast(Bytes of_root, int) override { return of_root; }
    std::vector<Bytes> exchange(std::vector<Bytes> to_rank) override { return to_rank; }
    void sum(std::span<std::uint64_t>) override {}
    void send(int, Bytes) override {}  // there is no other rank
    Bytes receive(int) override { return {}; }
    std::optional<Bytes> receive_any() override { return {}; }
    void post(int, const Bytes&) override {}  // there is no other rank
    std::optional<Bytes> poll() override { return {}; }
    void drop_messages() override {}
    void leave(const StageStatus&) override {}
};

/// Gathers one value of every rank, in the order of ranks.
template <class T>
std::vector<T> all_gather(Communicator& ranks, const T& value) {
    std::vector<T> values;
    for (const Bytes& bytes : ranks.all_gather(to_bytes(value))) values.push_back(from_bytes<T>(bytes));
    return values;
}

/// Gathers the items of every rank into one list, in the order of ranks.
template <class T>
std::vector<T> gather_items(Communicator& ranks, const std::vector<T>& own) {
    std::vector<T> all;
    for (std::vector<T>& of_rank : all_gather(ranks, own))
        std::move(of_rank.begin(), of_rank.end(), std::back_inserter(all));
    return all;
}

/// Collective: sends items[r] to rank r, and returns the items that each rank has for this one, by rank.
template <class T>
std::vector<std::vector<T>> exchange_items(Communicator& ranks, std::vector<std::vector<T>> items) {
    if (ranks.size() == 1) return items;
    std::vector<Bytes> to_rank;
    for (std::vector<T>& of_rank : items)
        to_rank.push_back(of_rank.empty() ? Bytes() : to_bytes(std::exchange(of_rank, {})));
    std::vector<Bytes> got = ranks.exchange(std::move(to_rank));
    for (std::size_t r = 0; r < items.size(); ++r)
        if (const Bytes bytes = std::exchange(got[r], {}); !bytes.empty()) items[r] = from_bytes<std::vector<T>>(bytes);
    return items;
}

/// Collective: returns the items of every rank in one list, in the order of ranks, on the rank `root`; nothing on the
/// others.
template <class T>
std::vector<T> gather_items_to(Communicator& ranks, int root, std::vector<T> own) {
    std::vector<std::vector<T>> items(ranks.size());
    items[root] = std::move(own);
    std::vector<T> all;
    for (std::vector<T>& of_rank : exchange_items(ranks, std::move(items)))
        std::move(of_rank.begin(), of_rank.end(), std::back_inserter(all));
    return all;
}

/// Collective: returns the sum of one number of each rank.
template <std::integral Number>
Number sum_of(Communicator& ranks, Number own) {
    std::uint64_t word = own;
    ranks.sum(std::span(&word, 1));
    return word;
}

/// Throws the error of the first rank that has one, on every rank. A rank that was cancelled counts only where there is
/// no other error, of which that may be the consequence. Without any error the cost is a sum of two numbers.
void throw_first_error(Communicator& ranks, const StageStatus& own);

/// Runs a stage on every rank and returns its value; if it fails on any rank, the error of the first such rank is
/// thrown on all of them, so that none waits in a later collective. The stage itself must not be collective.
template <class Stage>
auto in_agreement(Communicator& ranks, Stage stage) -> std::invoke_result_t<Stage> {
    StageStatus status;
    using Value = std::invoke_result_t<Stage>;
    const auto guarded = [&](auto&& body) {
        try {
            body();
        } catch (const std::exception&) {
            status = status_of_exception();
        }
    };
    if constexpr (std::is_void_v<Value>) {
        guarded([&] { stage(); });
        throw_first_error(ranks, status);
    } else {
        std::vector<Value> value;  // empty or one element
        guarded([&] { value.push_back(stage()); });
        throw_first_error(ranks, status);
        return std::move(value.front());
    }
}

/// Calls tell(), which posts messages that other ranks wait for or have to know. Where it throws, they would wait for
/// ever: this rank leaves then, because of `why`, or of the exception where `why` is good. Returns in any case.
template <class Tell>
void tell_or_leave(Communicator& ranks, const StageStatus& why, Tell tell) {
    StageStatus untold;
    try {
        return tell();
    } catch (const std::exception&) {
        untold = status_of_exception();
    }
    ranks.leave(why.code != 0 ? why : untold);
}

/// Runs a body that all ranks run, with its collectives and agreements. An exception that leaves it on one rank ends
/// all of them: each throws it as an Error. The outermost frame of a program of several ranks.
template <class Body>
auto run_together(Communicator& ranks, Body body) -> std::invoke_result_t<Body> {
    StageStatus why;
    try {
        return body();
    } catch (const std::exception&) {
        why = status_of_exception();
    }
    ranks.leave(why);
    throw why.error();
}

}  // namespace kerf

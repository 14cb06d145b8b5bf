// The order in which workers get the parts that wait.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace kerf {

/// A part that no worker has begun.
struct WaitingPart {
    double load = 0;        ///< predicted work
    std::int32_t host = 0;  ///< the host that its files were written on, and whose memory may still hold them
};

/// Gives each part of a list to one worker, the longest first: so the last ones to end are short. Among parts that are
/// nearly as long as the longest one left, a host gets its own.
class PartTickets {
 public:
    /// `parts`: in descending order of load; hosts from 0 on. O(parts).
    explicit PartTickets(std::vector<WaitingPart> parts);

    /// Returns the place in the list of the part that a worker of the host takes now; nothing if none is left. A host
    /// without parts may have any number. O(1), amortised over all.
    std::optional<std::size_t> take(std::int32_t host);

    /// The least load of a host's own part, as a share of that of the longest one, with which it is taken first.
    static constexpr double nearly_as_long = 0.75;

 private:
    // Places in ascending order, of which those before `next` are taken.
    struct Line {
        std::vector<std::size_t> places;
        std::size_t next = 0;
    };
    std::optional<std::size_t> first_of(Line& line) const;

    std::vector<WaitingPart> parts_;
    std::vector<char> is_taken_;
    Line all_;
    std::vector<Line> of_host_;
};

}  // namespace kerf

#include "run/work/part_tickets.h"

#include <algorithm>
#include <utility>

#include "base/core/check.h"
#include "base/core/ids.h"

namespace kerf {

PartTickets::PartTickets(std::vector<WaitingPart> parts) : parts_(std::move(parts)), is_taken_(parts_.size(), 0) {
    KERF_CHECK(std::is_sorted(parts_.begin(), parts_.end(),
                              [](const WaitingPart& a, const WaitingPart& b) { return a.load > b.load; }));
    for (std::size_t place = 0; place < parts_.size(); ++place) {
        const std::int32_t host = parts_[place].host;
        if (host >= count_of(of_host_)) of_host_.resize(host + 1);
        all_.places.push_back(place);
        of_host_[host].places.push_back(place);
    }
}

std::optional<std::size_t> PartTickets::first_of(Line& line) const {
    while (line.next < line.places.size() && is_taken_[line.places[line.next]]) ++line.next;
    if (line.next == line.places.size()) return {};
    return line.places[line.next];
}

std::optional<std::size_t> PartTickets::take(std::int32_t host) {
    std::optional<std::size_t> part = first_of(all_);
    if (!part) return {};
    if (static_cast<std::size_t>(host) < of_host_.size())
        if (const auto own = first_of(of_host_[host]); own && parts_[*own].load >= nearly_as_long * parts_[*part].load)
            part = own;
    is_taken_[*part] = 1;
    return part;
}

}  // namespace kerf

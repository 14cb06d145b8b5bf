// A radix sort of the upper bits, from the lowest of these to the highest; each pass keeps the order of equal digits,
// in blocks on threads whose digits are counted first. It leaves short runs of items whose upper bits are equal, which
// are sorted by comparison.
#include "base/geometry/morton_order.h"

#include <utility>

namespace kerf {

namespace {

constexpr int digit_bits = 11, digit_count = 3, lowest_digit = 63 - digit_count * digit_bits;
constexpr std::size_t digit_values = std::size_t{1} << digit_bits;
using DigitCounts = std::array<std::size_t, digit_values>;

// The order is the same for all ranges; many would take long to add up.
std::size_t grain_of(std::size_t count) { return std::max(std::size_t{1} << 15, (count + 31) / 32); }

void sort_by_digit(const std::vector<MortonItem>& from, std::vector<MortonItem>& to, int shift) {
    const auto digit_of = [&](const MortonItem& item) { return (item.code >> shift) % digit_values; };
    const std::size_t grain = grain_of(from.size());
    std::vector<DigitCounts> places = values_of_ranges(from.size(), grain, [&](const IndexRange& range) {
        DigitCounts counts{};
        for (std::size_t i = range.first; i < range.last; ++i) ++counts[digit_of(from[i])];
        return counts;
    });
    std::size_t place = 0;
    for (std::size_t digit = 0; digit < digit_values; ++digit)
        for (DigitCounts& of_range : places) place += std::exchange(of_range[digit], place);
    for_ranges_on_threads(from.size(), grain, [&](const IndexRange& range) {
        DigitCounts& next = places[range.first / grain];
        for (std::size_t i = range.first; i < range.last; ++i) to[next[digit_of(from[i])]++] = from[i];
    });
}

bool comes_first(const MortonItem& a, const MortonItem& b) {
    return a.code != b.code ? a.code < b.code : a.item < b.item;
}

}  // namespace

void sort_by_code(std::vector<MortonItem>& items) {
    constexpr std::size_t few = 4096;
    if (items.size() < few) return std::sort(items.begin(), items.end(), comes_first);
    std::vector<MortonItem> other(items.size());
    for (int digit = 0; digit < digit_count; ++digit) {
        sort_by_digit(items, other, lowest_digit + digit * digit_bits);
        items.swap(other);
    }
    other = {};
    const auto upper = [&](std::size_t i) { return items[i].code >> lowest_digit; };
    const std::size_t grain = grain_of(items.size());
    std::vector<std::size_t> starts;  // of ranges of whole runs
    for (std::size_t i = 0; i < items.size(); i = std::max(i, starts.back() + grain)) {
        while (i > 0 && i < items.size() && upper(i) == upper(i - 1)) ++i;
        starts.push_back(i);
    }
    starts.push_back(items.size());
    for_each_on_threads(starts.size() - 1, [&](std::size_t range) {
        for (std::size_t first = starts[range], last = first; first < starts[range + 1]; first = last) {
            while (last < starts[range + 1] && upper(last) == upper(first)) ++last;
            const auto at = [&](std::size_t i) { return items.begin() + i; };
            if (last - first > 1) std::sort(at(first), at(last), comes_first);
        }
    });
}

}  // namespace kerf

// Sums whose terms are computed on threads and added in order. Rounded sums depend on the order of their terms, and
// planes depend on the last bits of such sums.
#pragma once

#include <cmath>

#include "base/core/threads.h"

namespace kerf {

/// The number of items that a thread should take at once, if each costs some 10 ns.
inline constexpr std::size_t items_of_thread = std::size_t{1} << 14;

/// Calls add(term_of(i)) for each i below `count`, ascending: term_of() on threads, add() on the caller's thread alone.
/// Keeps one block of terms at a time.
template <class TermOf, class Add>
void add_in_order(std::size_t count, const TermOf& term_of, const Add& add) {
    constexpr std::size_t block = 16 * items_of_thread;
    std::vector<decltype(term_of(std::size_t{0}))> terms(std::min(count, block));
    for (std::size_t first = 0; first < count; first += block) {
        const std::size_t size = std::min(block, count - first);
        for_ranges_on_threads(size, items_of_thread, [&](const IndexRange& range) {
            for (std::size_t i = range.first; i < range.last; ++i) terms[i] = term_of(first + i);
        });
        for (std::size_t i = 0; i < size; ++i) add(terms[i]);
    }
}

/// Returns the lowest and the highest value_of(i) for i below `count`, which must not be zero.
template <class ValueOf>
std::pair<double, double> bounds_on_threads(std::size_t count, const ValueOf& value_of) {
    std::pair<double, double> bounds = {INFINITY, -INFINITY};
    const auto extend = [](std::pair<double, double>& to, double low, double high) {
        to = {std::min(to.first, low), std::max(to.second, high)};
    };
    for (const auto& [low, high] : values_of_ranges(count, items_of_thread, [&](const IndexRange& range) {
             std::pair<double, double> own = {INFINITY, -INFINITY};
             for (std::size_t i = range.first; i < range.last; ++i) {
                 const double value = value_of(i);
                 extend(own, value, value);
             }
             return own;
         }))
        extend(bounds, low, high);
    return bounds;
}

/// Returns the items that select(i, items) appends for each i below `count`, in the order of i.
template <class Item, class Select>
std::vector<Item> selected_on_threads(std::size_t count, const Select& select) {
    std::vector<Item> all;
    for (const std::vector<Item>& items : values_of_ranges(count, items_of_thread, [&](const IndexRange& range) {
             std::vector<Item> own;
             for (std::size_t i = range.first; i < range.last; ++i) select(i, own);
             return own;
         }))
        all.insert(all.end(), items.begin(), items.end());
    return all;
}

}  // namespace kerf

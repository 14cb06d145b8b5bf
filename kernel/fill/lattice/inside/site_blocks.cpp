// A block's key has 21 bits for each coordinate, z first, counted from one below the lowest, so that a step of one in
// any of them neither borrows nor carries. The three blocks along x around a place have consecutive keys; so the 27
// blocks around a block are found by nine cursors, one for each step in y and z, which only move on. A padded row has
// 10 bits: the last site of the row before, the eight of its own, and the first of the row behind.
#include "fill/lattice/inside/site_blocks.h"

#include <algorithm>
#include <limits>

#include "base/core/error.h"

namespace kerf {

BlockIndex::Key BlockIndex::key(const BlockCoordinates& block) const {
    Key key = 0;
    for (int axis = 2; axis >= 0; --axis) key = key << bits | (block[axis] - base_[axis]);
    return key;
}

void BlockIndex::append(const BlockCoordinates& block) {
    KERF_CHECK(keys_.empty() || keys_.back() < key(block));
    if (keys_.empty()) lowest_ = highest_ = block;
    for (int axis = 0; axis < 3; ++axis) {
        lowest_[axis] = std::min(lowest_[axis], block[axis]);
        highest_[axis] = std::max(highest_[axis], block[axis]);
    }
    keys_.push_back(key(block));
}

BlockCoordinates BlockIndex::coordinates(std::int32_t block) const {
    constexpr Key mask = (Key{1} << bits) - 1;
    BlockCoordinates coordinates;
    for (int axis = 0; axis < 3; ++axis)
        coordinates[axis] = static_cast<std::int32_t>(keys_[block] >> (bits * axis) & mask) + base_[axis];
    return coordinates;
}

LatticeSite BlockIndex::lowest_site(std::int32_t block) const {
    const auto [x, y, z] = coordinates(block);
    return {2 * block_edge * x, 2 * block_edge * y, 2 * block_edge * z};
}

std::int32_t BlockIndex::lower_bound(const BlockCoordinates& block) const {
    return std::lower_bound(keys_.begin(), keys_.end(), key(block)) - keys_.begin();
}

void BlockSurroundings::move_to(std::int32_t block) {
    const std::vector<BlockIndex::Key>& keys = blocks_->keys_;
    const std::int32_t count = blocks_->size();
    for (int row = 0; row < 9; ++row) {
        // Coordinates are at least 1, so that nothing is borrowed.
        const BlockIndex::Key y = BlockIndex::Key{1} << BlockIndex::bits, z = y << BlockIndex::bits;
        const BlockIndex::Key middle = keys[block] + row / 3 * z - z + row % 3 * y - y;
        std::int32_t& cursor = cursor_[row];
        while (cursor < count && keys[cursor] < middle - 1) ++cursor;
        for (int i = 0, next = cursor; i < 3; ++i) {
            const bool is_there = next < count && keys[next] == middle + i - 1;
            around_[3 * row + i] = is_there ? next++ : none;
        }
    }
}

PaddedRows::PaddedRows(const SiteBits& bits, const BlockSurroundings& around) {
    static constexpr SiteRows empty = {};
    const auto rows_at = [&](int dx, int dy, int dz) -> const SiteRows& {
        const std::int32_t block = around.at(dx, dy, dz);
        return block == BlockSurroundings::none ? empty : bits[block];
    };
    const auto beside = [](int i) { return i < 0 ? -1 : i < block_edge ? 0 : 1; };
    for (int z = -1; z <= block_edge; ++z)
        for (int y = -1; y <= block_edge; ++y) {
            const SiteRows &before = rows_at(-1, beside(y), beside(z)), &here = rows_at(0, beside(y), beside(z)),
                           &after = rows_at(1, beside(y), beside(z));
            for (int parity = 0; parity < 2; ++parity) {
                const int row = row_number(parity, y & (block_edge - 1), z & (block_edge - 1));
                rows_[parity][z + 1][y + 1] = before[row] >> 7 | here[row] << 1 | (after[row] & 1) << 9;
            }
        }
}

SiteNumbers::SiteNumbers(const SiteBits& bits) {
    std::int64_t count = 0;
    first_.reserve(bits.size());
    before_row_.reserve(bits.size());
    for (const SiteRows& rows : bits) {
        first_.push_back(count);
        auto& before = before_row_.emplace_back();
        std::uint16_t in_block = 0;
        for (int row = 0; row < rows_per_block; ++row) {
            before[row] = in_block;
            in_block += bit_count(rows[row]);
        }
        count += in_block;
        if (count > std::numeric_limits<std::int32_t>::max())
            throw Error(ErrorCode::memory,
                        "A part has more than 2147483647 points of the lattice, more than can be numbered. Choose more "
                        "parts or a larger volume bound.");
    }
    count_ = count;
}

}  // namespace kerf

// Sets of sites of a lattice, a bit each, in blocks of 8 x 8 x 8 cubes: those blocks alone that hold some.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "base/core/ids.h"
#include "fill/lattice/inside/bcc_lattice.h"

namespace kerf {

inline constexpr int block_edge = 8;  ///< edge of a block, in cubes
inline constexpr int rows_per_block = 2 * block_edge * block_edge;

/// A set of sites of a block: bit x of row_number(parity, y, z) is site 2 * (x, y, z) + parity, counted from the
/// block's lowest cube.
using SiteRows = std::array<std::uint8_t, rows_per_block>;

constexpr int row_number(int parity, int y, int z) { return (parity * block_edge + z) * block_edge + y; }

/// The place of a block among all, along x, then y, then z.
using BlockCoordinates = std::array<std::int32_t, 3>;

/// The blocks that hold sites, by their coordinates. They are numbered in the order of z, then y, then x. 8 bytes a
/// block.
class BlockIndex {
 public:
    /// Most blocks along each axis.
    static constexpr std::int32_t most_blocks = (1 << 21) - 4;

    BlockIndex() = default;
    /// Takes the least of all coordinates that will come: these are between `lowest` and most_blocks more.
    explicit BlockIndex(const BlockCoordinates& lowest) : base_{lowest[0] - 1, lowest[1] - 1, lowest[2] - 1} {}

    /// Appends a block, which must come after the last one in the order.
    void append(const BlockCoordinates& block);

    std::int32_t size() const { return count_of(keys_); }
    BlockCoordinates coordinates(std::int32_t block) const;
    /// Returns the site with parity 0 of a block's lowest cube.
    LatticeSite lowest_site(std::int32_t block) const;
    /// The corners of the smallest box of coordinates that holds all blocks. Requires some.
    const BlockCoordinates& lowest() const { return lowest_; }
    const BlockCoordinates& highest() const { return highest_; }
    std::size_t bytes() const { return keys_.capacity() * sizeof(Key); }
    /// Returns the number of the first block that does not come before this one. O(log n).
    std::int32_t lower_bound(const BlockCoordinates& block) const;

 private:
    friend class BlockSurroundings;
    using Key = std::uint64_t;  // 21 bits a coordinate, z first: the order of keys is that of the blocks
    static constexpr int bits = 21;

    Key key(const BlockCoordinates& block) const;

    BlockCoordinates base_ = {}, lowest_ = {}, highest_ = {};
    std::vector<Key> keys_;
};

/// Goes through all blocks in order and knows the numbers of those around: O(1) a step on average, because the blocks
/// beside come in the same order.
class BlockSurroundings {
 public:
    static constexpr std::int32_t none = -1;

    explicit BlockSurroundings(const BlockIndex& blocks) : blocks_(&blocks) {}

    /// Moves to a block. Blocks must come in ascending order.
    void move_to(std::int32_t block);
    /// Returns the number of the block at this distance, each of -1, 0 and 1; `none` if there is none.
    std::int32_t at(int dx, int dy, int dz) const { return around_[(dz * 3 + dy) * 3 + dx + 13]; }

 private:
    const BlockIndex* blocks_;
    std::array<std::int32_t, 9> cursor_ = {};
    std::array<std::int32_t, 27> around_ = {};
};

/// A set of sites: rows by block.
using SiteBits = std::vector<SiteRows>;

/// A step from a site to another one, in cubes.
struct SiteStep {
    int parity;  ///< parity of the other site
    int dx, dy, dz;

    /// Takes a step in half edges, from a site of this parity.
    constexpr SiteStep(int from_parity, const LatticeSite& step)
        : parity((from_parity + step[0]) & 1), dx(0), dy(0), dz(0) {
        dx = (from_parity + step[0] - parity) / 2;
        dy = (from_parity + step[1] - parity) / 2;
        dz = (from_parity + step[2] - parity) / 2;
    }
};

/// The part of a set of sites that lies in a block and in the cubes around it.
class PaddedRows {
 public:
    PaddedRows(const SiteBits& bits, const BlockSurroundings& around);

    /// Returns a row in which bit x is the site that is a step away from site x of the row (y, z).
    std::uint8_t row(const SiteStep& step, int y, int z) const {
        return static_cast<std::uint8_t>(rows_[step.parity][z + 1 + step.dz][y + 1 + step.dy] >> (1 + step.dx));
    }
    std::uint8_t row(int parity, int y, int z) const {
        return static_cast<std::uint8_t>(rows_[parity][z + 1][y + 1] >> 1);
    }

 private:
    std::uint16_t rows_[2][block_edge + 2][block_edge + 2] = {};
};

/// The numbers of the sites of a set, without gaps, in the order of blocks, rows and bits. 260 bytes a block.
class SiteNumbers {
 public:
    SiteNumbers() = default;
    /// Numbers the sites. Throws Error(memory) if there are 2^31 or more.
    explicit SiteNumbers(const SiteBits& bits);

    std::int32_t count() const { return count_; }
    std::size_t bytes() const {
        return first_.capacity() * sizeof first_[0] + before_row_.capacity() * sizeof before_row_[0];
    }
    /// Returns the number of the first site in a row that is in the set.
    std::int32_t first_of_row(std::int32_t block, int row) const { return first_[block] + before_row_[block][row]; }

 private:
    std::int32_t count_ = 0;
    std::vector<std::int32_t> first_;
    std::vector<std::array<std::uint16_t, rows_per_block>> before_row_;
};

/// Returns the number of bits that are set.
constexpr int bit_count(std::uint8_t bits) {
    const unsigned pairs = bits - (bits >> 1 & 0x55U), fours = (pairs & 0x33U) + (pairs >> 2 & 0x33U);
    return (fours + (fours >> 4)) & 0xfU;
}

/// Calls visit(x) for each bit that is set, lowest first.
template <class Visit>
void for_each_bit(unsigned bits, const Visit& visit) {
    for (; bits != 0; bits &= bits - 1) visit(std::countr_zero(bits));
}

/// Calls visit(site) for the sites of a set in the order of their numbers.
template <class Visit>
void for_each_site(const BlockIndex& blocks, const SiteBits& bits, const Visit& visit) {
    for (std::int32_t block = 0; block < blocks.size(); ++block) {
        const LatticeSite lowest = blocks.lowest_site(block);
        for (int parity = 0; parity < 2; ++parity)
            for (int z = 0; z < block_edge; ++z)
                for (int y = 0; y < block_edge; ++y)
                    for_each_bit(bits[block][row_number(parity, y, z)], [&](int x) {
                        visit(lowest + LatticeSite{2 * x + parity, 2 * y + parity, 2 * z + parity});
                    });
    }
}

}  // namespace kerf

// All is done on rows of eight sites, a byte each, in blocks padded by their neighbours (PaddedRows): the row of sites
// a step away is a shift, and sets are combined by bits. With K the kept sites, deep sites are the AND of K over the 14
// steps to neighbours, boundary sites those of K that are not deep and have a deep neighbour, and free sites the rest
// of K. Every cell is counted at one even site, as one of 12: it belongs to the core if all corners are deep or
// boundary and one is deep. A face of the boundary is found from the deep site opposite to it, where its three corners
// are not deep and neither is the site mirrored at it; all of its corners are boundary sites then.
//
// Numbers of sites are unpacked, block by block, into an array with a margin of one, in which a corner is a constant
// distance away. Places of sites that are not in the set keep old numbers there; no cell names one.
#include "fill/lattice/lattice_core.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/core/error.h"
#include "fill/lattice/inside/clearance.h"
#include "fill/lattice/inside/sites_inside.h"

namespace kerf {

namespace {

using NeighbourSteps = std::array<SiteStep, lattice_neighbours.size()>;

template <std::size_t... i>
constexpr NeighbourSteps make_neighbour_steps(int parity, std::index_sequence<i...>) {
    return {SiteStep(parity, lattice_neighbours[i])...};
}

// The steps to all neighbours, from a site of each parity.
constexpr std::array<NeighbourSteps, 2> neighbour_steps = {
    make_neighbour_steps(0, std::make_index_sequence<lattice_neighbours.size()>()),
    make_neighbour_steps(1, std::make_index_sequence<lattice_neighbours.size()>())};

struct CellSteps {
    std::array<SiteStep, 3> corners;
    SiteStep mirrored;
};

constexpr CellSteps steps_of(int parity, const LatticeCell& cell) {
    return {{SiteStep(parity, cell.corners[0]), SiteStep(parity, cell.corners[1]), SiteStep(parity, cell.corners[2])},
            SiteStep(parity, cell.mirrored)};
}

template <std::size_t... i>
constexpr std::array<CellSteps, lattice_cells.size()> make_cell_steps(int parity, std::index_sequence<i...>) {
    return {steps_of(parity, lattice_cells[i])...};
}

constexpr std::array<std::array<CellSteps, lattice_cells.size()>, 2> cell_steps = {
    make_cell_steps(0, std::make_index_sequence<lattice_cells.size()>()),
    make_cell_steps(1, std::make_index_sequence<lattice_cells.size()>())};

// Calls visit(parity, y, z) for all rows of a block.
template <class Visit>
void for_each_row(const Visit& visit) {
    for (int parity = 0; parity < 2; ++parity)
        for (int z = 0; z < block_edge; ++z)
            for (int y = 0; y < block_edge; ++y) visit(parity, y, z);
}

constexpr unsigned full_row = (1U << block_edge) - 1;

// Calls visit(y, z, i, mask) for the cells of a block that belong to the core: bit x of the mask is lattice_cells[i]
// at the even site x of the row.
template <class Visit>
void for_each_core_cell(const PaddedRows& deep, const PaddedRows& boundary, const Visit& visit) {
    for (int z = 0; z < block_edge; ++z)
        for (int y = 0; y < block_edge; ++y) {
            const unsigned deep_site = deep.row(0, y, z), site = deep_site | boundary.row(0, y, z);
            if (site == 0) continue;
            for (int i = 0; i < cells_per_cube; ++i) {
                unsigned all = site, any_deep = deep_site;
                for (const SiteStep& step : cell_steps[0][i].corners) {
                    const unsigned deep_corner = deep.row(step, y, z);
                    all &= deep_corner | boundary.row(step, y, z);
                    any_deep |= deep_corner;
                }
                if ((all & any_deep) != 0) visit(y, z, i, all & any_deep);
            }
        }
}

// The numbers of the sites in a block and beside it.
class PaddedNumbers {
 public:
    static constexpr int width = block_edge + 2;

    static constexpr int place(int parity, int x, int y, int z) {
        return ((parity * width + z + 1) * width + y + 1) * width + x + 1;
    }
    // Returns the number that a step adds to the place of a site with parity `from`.
    static constexpr int distance(int from, const SiteStep& step) {
        return place(step.parity, step.dx, step.dy, step.dz) - place(from, 0, 0, 0);
    }

    std::int32_t at(int place) const { return number_[place]; }

    // Sets the numbers of the sites in the set; the others keep theirs.
    void set(const SiteBits& bits, const SiteNumbers& numbers, const BlockSurroundings& around, std::int32_t first) {
        for (int dz = -1; dz <= 1; ++dz)
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx) {
                    const std::int32_t block = around.at(dx, dy, dz);
                    if (block == BlockSurroundings::none) continue;
                    const auto [first_y, last_y] = part_of(dy);
                    const auto [first_z, last_z] = part_of(dz);
                    for (int parity = 0; parity < 2; ++parity)
                        for (int z = first_z; z <= last_z; ++z)
                            for (int y = first_y; y <= last_y; ++y)
                                set_row(bits[block][row_number(parity, y, z)], dx,
                                        first + numbers.first_of_row(block, row_number(parity, y, z)),
                                        place(parity, block_edge * dx, y + block_edge * dy, z + block_edge * dz));
                }
    }

 private:
    struct Part {
        int first, last;
    };
    // Returns the rows of a block at this distance that lie beside the middle block.
    static constexpr Part part_of(int d) {
        return d < 0 ? Part{block_edge - 1, block_edge - 1} : d > 0 ? Part{0, 0} : Part{0, block_edge - 1};
    }

    void set_row(std::uint8_t row, int dx, std::int32_t number, int place) {
        constexpr int last = block_edge - 1;
        if (dx > 0) {
            if ((row & 1) != 0) number_[place] = number;
        } else if (dx < 0) {
            if (row >> last != 0) number_[place + last] = number + bit_count(row) - 1;
        } else {
            for_each_bit(row, [&](int x) { number_[place + x] = number++; });
        }
    }

    std::array<std::int32_t, 2 * width * width * width> number_;
};

void require_numbers(std::int64_t first, std::int64_t count) {
    if (first + count > std::numeric_limits<std::int32_t>::max())
        throw Error(ErrorCode::memory, "A part has more than 2147483647 vertices. Choose more parts.");
}

std::vector<Vec3> points_of(const BccLattice& lattice, const BlockIndex& blocks, const SiteBits& bits) {
    std::vector<Vec3> points;
    for_each_site(blocks, bits, [&](const LatticeSite& site) { points.push_back(lattice.point(site)); });
    return points;
}

}  // namespace

LatticeCore::LatticeCore(const SurfaceArrays& surface, double edge) : lattice_(edge) {
    SiteSet kept = sites_inside(surface, lattice_);
    remove_sites_near(surface, lattice_, kept);
    blocks_ = std::move(kept.blocks);
    find_deep_sites(kept.bits);
    find_boundary_sites(std::move(kept.bits));
    interior_number_ = SiteNumbers(deep_);
    boundary_number_ = SiteNumbers(boundary_);
    count_cells();
}

void LatticeCore::find_deep_sites(const SiteBits& kept) {
    deep_.resize(blocks_.size());
    BlockSurroundings around(blocks_);
    for (std::int32_t block = 0; block < blocks_.size(); ++block) {
        around.move_to(block);
        const PaddedRows rows(kept, around);
        for_each_row([&](int parity, int y, int z) {
            std::uint8_t row = rows.row(parity, y, z);
            if (row == 0) return;
            for (const SiteStep& step : neighbour_steps[parity]) row &= rows.row(step, y, z);
            deep_[block][row_number(parity, y, z)] = row;
        });
    }
}

void LatticeCore::find_boundary_sites(SiteBits kept) {
    boundary_.resize(blocks_.size());
    free_ = std::move(kept);
    BlockSurroundings around(blocks_);
    for (std::int32_t block = 0; block < blocks_.size(); ++block) {
        around.move_to(block);
        const PaddedRows rows(deep_, around);
        for_each_row([&](int parity, int y, int z) {
            const std::uint8_t deep = rows.row(parity, y, z);
            std::uint8_t& free = free_[block][row_number(parity, y, z)];
            if (free == deep) {
                free = 0;
                return;
            }
            std::uint8_t beside = 0;
            for (const SiteStep& step : neighbour_steps[parity]) beside |= rows.row(step, y, z);
            boundary_[block][row_number(parity, y, z)] = beside & ~deep;
            free &= ~beside & ~deep;
        });
    }
}

void LatticeCore::count_cells() {
    BlockSurroundings around(blocks_);
    for (std::int32_t block = 0; block < blocks_.size(); ++block) {
        around.move_to(block);
        for_each_core_cell(PaddedRows(deep_, around), PaddedRows(boundary_, around),
                           [&](int, int, int, unsigned mask) { cell_count_ += bit_count(mask); });
    }
}

std::size_t LatticeCore::bytes() const {
    return blocks_.bytes() + interior_number_.bytes() + boundary_number_.bytes() +
           (deep_.capacity() + boundary_.capacity() + free_.capacity()) * sizeof(SiteRows);
}

std::vector<Vec3> LatticeCore::boundary_points() const { return points_of(lattice_, blocks_, boundary_); }

std::vector<Vec3> LatticeCore::free_points() const { return points_of(lattice_, blocks_, free_); }

void LatticeCore::append_interior_points(std::vector<Vec3>& points) const {
    points.reserve(points.size() + interior_point_count());
    for_each_site(blocks_, deep_, [&](const LatticeSite& site) { points.push_back(lattice_.point(site)); });
}

std::vector<Triangle> LatticeCore::boundary_faces() const {
    std::vector<Triangle> faces;
    BlockSurroundings around(blocks_);
    PaddedNumbers numbers;
    for (std::int32_t block = 0; block < blocks_.size(); ++block) {
        around.move_to(block);
        const PaddedRows deep(deep_, around);
        bool has_numbers = false;
        for_each_row([&](int parity, int y, int z) {
            const unsigned site = deep.row(parity, y, z);
            if (site == 0) return;
            for (const CellSteps& cell : cell_steps[parity]) {
                unsigned mask = site & ~deep.row(cell.mirrored, y, z);
                for (const SiteStep& step : cell.corners) mask &= ~deep.row(step, y, z);
                if (mask == 0) continue;
                if (!has_numbers) numbers.set(boundary_, boundary_number_, around, 0);
                has_numbers = true;
                for_each_bit(mask, [&](int x) {
                    const int place = PaddedNumbers::place(parity, x, y, z);
                    Triangle& face = faces.emplace_back();
                    for (int i = 0; i < 3; ++i)
                        face[i] = numbers.at(place + PaddedNumbers::distance(parity, cell.corners[i]));
                });
            }
        });
    }
    return faces;
}

void LatticeCore::append_cells(std::int32_t first_boundary, std::int32_t first_interior,
                               std::vector<Tetrahedron>& cells) const {
    require_numbers(first_boundary, boundary_point_count());
    require_numbers(first_interior, interior_point_count());
    const std::size_t old_size = cells.size();
    cells.resize(old_size + cell_count_);
    Tetrahedron* next = cells.data() + old_size;
    BlockSurroundings around(blocks_);
    PaddedNumbers numbers;
    for (std::int32_t block = 0; block < blocks_.size(); ++block) {
        around.move_to(block);
        numbers.set(boundary_, boundary_number_, around, first_boundary);
        numbers.set(deep_, interior_number_, around, first_interior);
        const PaddedRows deep(deep_, around), boundary(boundary_, around);
        for_each_core_cell(deep, boundary, [&](int y, int z, int i, unsigned mask) {
            const auto& corners = cell_steps[0][i].corners;
            const int place = PaddedNumbers::place(0, 0, y, z), p = place + PaddedNumbers::distance(0, corners[0]),
                      q = place + PaddedNumbers::distance(0, corners[1]),
                      r = place + PaddedNumbers::distance(0, corners[2]);
            const auto stamp = [&](int x) {
                *next++ = {numbers.at(place + x), numbers.at(p + x), numbers.at(q + x), numbers.at(r + x)};
            };
            if (mask == full_row)
                for (int x = 0; x < block_edge; ++x) stamp(x);
            else
                for_each_bit(mask, stamp);
        });
    }
    KERF_CHECK(next == cells.data() + cells.size());
}

}  // namespace kerf

// Damage as surfaces suffer it on their way, by a seed: for what repairs must do with any of it.
#pragma once

#include <array>

#include "support/seeded_numbers.h"
#include "surface/soup/soup.h"

namespace kerf::test {

/// What can happen to a surface.
enum class SurfaceDamage {
    deleted,     ///< facets around a place are gone
    duplicated,  ///< facets are there twice, with the same vertices or with others in the same places, turned or not
    flipped,     ///< facets are turned over
    moved,       ///< vertices are beside their places, by less than their edges are long
    crossed,     ///< a vertex is pushed through the facets beside it
    cut,         ///< a piece has vertices of its own along its rim, and lies beside its place
    shifted      ///< another body has been pushed into this one
};
inline constexpr std::array<SurfaceDamage, 7> all_surface_damages = {
    SurfaceDamage::deleted, SurfaceDamage::duplicated, SurfaceDamage::flipped, SurfaceDamage::moved,
    SurfaceDamage::crossed, SurfaceDamage::cut,        SurfaceDamage::shifted};
const char* name(SurfaceDamage damage);

/// A body that gets one damage after another.
class DamagedBody {
 public:
    /// `whole`: closed, facets with common vertices.
    DamagedBody(Soup whole, std::uint64_t seed);

    /// At so few places that less than a hundredth of the facets of the whole is touched, also by all calls together,
    /// and that the volume differs by less than a thousandth of that of the whole, by all calls together, once holes
    /// are filled and what is inside is gone. `gap`: how far a piece that is cut out is shifted at most.
    void suffer(SurfaceDamage damage, double gap);

    const Soup& soup() const { return soup_; }

 private:
    int below(std::size_t end) { return numbers_.integer(0, static_cast<int>(end) - 1); }
    /// So many facets around a vertex by common vertices, or fewer where damage was done before.
    std::vector<std::int32_t> patch(std::size_t count);
    /// The number of facets that may be damaged at one place.
    std::size_t some_facets(std::size_t most);
    /// How far a vertex of the facets may be moved without that too much volume changes, at most `wish`.
    double affordable_move(const std::vector<std::int32_t>& facets, double wish);
    std::vector<std::int32_t> facets_at(std::int32_t vertex) const;
    double edge_at(std::int32_t vertex) const;
    Vec3 direction();

    void erase();
    void duplicate();
    void flip();
    void move();
    void cross();
    void cut(double gap);
    void push_in_a_body();

    Soup soup_;
    SeededNumbers numbers_;
    std::size_t facets_left_;  // that may be damaged
    double volume_left_;       // that may change
};

}  // namespace kerf::test

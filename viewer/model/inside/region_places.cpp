// One pass over facets finds the box of each region, and counts its facets and its walls with each other region; facets
// that a cut has made within a region do not count. A region is held by another one if more than half of its facets are
// walls with that one, whose box contains its own and is larger by volume; the latter excludes cycles, so that the walk
// from holder to holder ends. The outermost holder moves by the vector from the centre of all to its own centre, and
// each link of the chain adds a move through the nearest side of the holder's box, as long as that box is there; of
// equally near sides the upper one is taken first.
#include "viewer/model/inside/region_places.h"

#include <limits>
#include <map>
#include <utility>

#include "viewer/model/inside/part_files.h"

namespace kerf::view {

namespace {

// The facts that facets tell of the regions that they bound.
class RegionSurvey {
 public:
    explicit RegionSurvey(std::size_t count) : boxes_(count), facets_(count) {}

    // A facet of a region, and the region beyond it or none.
    void add(RegionIndex region, RegionIndex beyond, const std::vector<Vec3>& vertices, const Triangle& facet) {
        if (!region.is_valid() || region >= RegionIndex(boxes_.size())) return;
        for (const std::int32_t v : facet) boxes_[region].extend(vertices[v]);
        ++facets_[region];
        if (beyond.is_valid()) ++walls_[{region, beyond}];
    }

    Array<RegionIndex, RegionPlace> places() const {
        Array<RegionIndex, RegionPlace> places(boxes_.size());
        for (const RegionIndex r : places.ids()) places[r].box = boxes_[r];
        for (const auto& [pair, walls] : walls_) {
            const auto [region, beyond] = pair;
            if (beyond >= RegionIndex(boxes_.size()) || 2 * walls <= facets_[region]) continue;
            const bool is_smaller = boxes_[region].volume() < boxes_[beyond].volume();
            if (is_smaller && boxes_[beyond].contains(boxes_[region])) places[region].holder = beyond;
        }
        return places;
    }

 private:
    Array<RegionIndex, Eigen::AlignedBox3d> boxes_;
    Array<RegionIndex, std::int64_t> facets_;
    std::map<std::pair<RegionIndex, RegionIndex>, std::int64_t> walls_;
};

// The move through the side of the holder that is nearest to the same side of the region inside; of equally near sides
// the upper one is taken first.
Vec3 way_out(const Eigen::AlignedBox3d& inside, const Eigen::AlignedBox3d& holder) {
    double least = std::numeric_limits<double>::infinity();
    Vec3 way = Vec3::Zero();
    for (const int axis : {2, 0, 1})
        for (const double sign : {1., -1.}) {
            const double gap =
                sign > 0 ? holder.max()[axis] - inside.max()[axis] : inside.min()[axis] - holder.min()[axis];
            if (!(gap < least)) continue;
            least = gap;
            way = sign * holder.sizes()[axis] * Vec3::Unit(axis);
        }
    return way;
}

}  // namespace

Array<RegionIndex, RegionPlace> region_places(const Trace& trace) {
    RegionSurvey survey(trace.region_names.size());
    for (std::size_t f = 0; f < trace.sides.size(); ++f) {
        const FacetSides& sides = trace.sides[f];
        survey.add(sides.back, sides.front, trace.surface.vertices, trace.surface.facets[f]);
        survey.add(sides.front, sides.back, trace.surface.vertices, trace.surface.facets[f]);
    }
    return survey.places();
}

Array<RegionIndex, RegionPlace> region_places(const std::string& folder, const Tree& tree, std::size_t count) {
    RegionSurvey survey(count);
    for (const NodeId part : tree.parts_below(root_node)) {
        const NodeSurface surface = read_part_surface(folder, part);
        const RegionIndex region = tree.find(part)->region;
        for (std::size_t f = 0; f < surface.facets.size(); ++f) {
            const TreeRow* neighbour = surface.neighbour[f].is_valid() ? tree.find(surface.neighbour[f]) : nullptr;
            if (neighbour && neighbour->region == region) continue;  // a cut has made it
            survey.add(region, neighbour ? neighbour->region : RegionIndex::none(), surface.vertices,
                       surface.facets[f]);
        }
    }
    return survey.places();
}

Array<RegionIndex, Vec3> moves_apart(const Array<RegionIndex, RegionPlace>& places) {
    Eigen::AlignedBox3d all;
    for (const RegionPlace& place : places) all.extend(place.box);
    Array<RegionIndex, Vec3> moves(places.size(), Vec3::Zero());
    for (const RegionIndex r : places.ids()) {
        if (places[r].box.isEmpty()) continue;
        RegionIndex outermost = r;  // holders are larger than the regions inside of them
        for (; places[outermost].holder.is_valid(); outermost = places[outermost].holder)
            moves[r] += way_out(places[outermost].box, places[places[outermost].holder].box);
        moves[r] += places[outermost].box.center() - all.center();
    }
    return moves;
}

}  // namespace kerf::view

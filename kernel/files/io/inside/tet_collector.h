// Collects the tetrahedra of a file, with their volumes and the values at their nodes.
#pragma once

#include <algorithm>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/core/error.h"
#include "base/core/ids.h"
#include "files/io/inside/region_facets.h"
#include "surface/soup/soup.h"

namespace kerf {

/// A scalar at the vertices of a file.
struct NodeScalar {
    std::string name;
    std::vector<double> values;  ///< #V; NaN where the file has none
};

class TetCollector {
 public:
    /// Takes the path of the file, for messages, and the soup whose vertices the corners are. Volumes are kept if
    /// `has_volumes`.
    TetCollector(const std::string& path, const Soup& soup, bool has_volumes)
        : path_(path), soup_(soup), has_volumes_(has_volumes) {}

    bool empty() const { return tets_.empty(); }
    std::int64_t count() const { return std::ssize(tets_); }

    /// Adds a tetrahedron of any orientation, in the volume with this number from volume(). Calls `fail(message)`,
    /// which must throw, for a corner that is no vertex so far.
    template <class Fail>
    void add(std::span<const std::int64_t> corners, const Fail& fail, std::int32_t volume = 0) {
        const auto vertices = std::ssize(soup_.vertices);
        Tetrahedron tet{};
        for (std::size_t i = 0; i < tet.size(); ++i) {
            if (corners[i] < 0 || corners[i] >= vertices)
                fail("a tetrahedron names vertex number " + std::to_string(corners[i]) +
                     " (counted from 0), but there are " + std::to_string(vertices) +
                     " vertices. Correct it or save the mesh again.");
            tet[i] = corners[i];
        }
        if (tets_.size() == std::numeric_limits<std::int32_t>::max())
            throw Error(ErrorCode::input, path_ + ": the file has more than 2^31 - 1 tetrahedra. Split the mesh.");
        tets_.push_back(tet);
        if (has_volumes_) volume_of_tet_.push_back(volume);
    }

    /// Returns the number of a volume, a new one when the key comes first.
    std::int32_t volume(const VolumeKey& key) {
        return number_of_volume_.try_emplace(key, count_of(number_of_volume_)).first->second;
    }
    std::size_t volume_count() const { return number_of_volume_.size(); }
    /// Names the volumes by `name(key)`, and makes regions of those of one name. Without any volume() all tetrahedra
    /// are of the region "body".
    template <class Name>
    void name_volumes(const Name& name) {
        if (!number_of_volume_.empty()) regions_ = regions_of(number_of_volume_, name);
    }
    const std::vector<std::string>& region_names() const { return regions_.names; }
    /// Returns the region of each tetrahedron, once the volumes are named; empty if all are of one region.
    std::vector<RegionIndex> regions_of_tets() const {
        if (regions_.names.size() == 1) return {};
        std::vector<RegionIndex> regions;
        regions.reserve(volume_of_tet_.size());
        for (const std::int32_t volume : volume_of_tet_) regions.push_back(regions_.region_of_volume[volume]);
        return regions;
    }
    /// Returns the faces at which regions end, once the volumes are named. Throws Error(input) if tetrahedra of two
    /// regions overlap.
    std::vector<RegionFace> faces_of_regions() const {
        RegionFaces found = region_faces(soup_.vertices, tets_, regions_of_tets());
        if (found.overlap) refuse_overlap(soup_, *found.overlap, regions_.names, path_);
        return std::move(found.faces);
    }

    /// Returns the values of this name, one for each vertex so far.
    std::vector<double>& scalar(std::string_view name) {
        const auto of_name = [&](const NodeScalar& scalar) { return scalar.name == name; };
        auto found = std::find_if(scalars_.begin(), scalars_.end(), of_name);
        if (found == scalars_.end()) found = scalars_.insert(found, {std::string(name), {}});
        found->values.resize(soup_.vertices.size(), std::numeric_limits<double>::quiet_NaN());
        return found->values;
    }

    /// Returns the tetrahedra; throws Error(input) if there are none.
    Array<CellId, Tetrahedron> finish() {
        if (tets_.empty())
            throw Error(ErrorCode::input, path_ + ": the file holds no tetrahedra. Name a file of a volume mesh.");
        return std::move(tets_);
    }
    std::vector<NodeScalar> finish_scalars() {
        for (NodeScalar& s : scalars_) scalar(s.name);
        return std::move(scalars_);
    }

 private:
    const std::string& path_;
    const Soup& soup_;
    bool has_volumes_;
    Array<CellId, Tetrahedron> tets_;
    std::vector<std::int32_t> volume_of_tet_;
    std::map<VolumeKey, std::int32_t> number_of_volume_;
    VolumeRegions regions_{{}, {"body"}};
    std::vector<NodeScalar> scalars_;
};

}  // namespace kerf

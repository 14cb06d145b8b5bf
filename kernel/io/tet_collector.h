// Collects the tetrahedra that a file says, with their volumes and the numbers at their vertices.
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"
#include "io/tet_skin.h"
#include "surface/soup.h"

namespace kerf {

/// Numbers at the vertices of a file.
struct NodeScalar {
    std::string name;
    std::vector<double> values;  ///< #V; NaN where the file has none
};

class TetCollector {
 public:
    /// Corners are vertices of `soup`. `path` only serves messages. Volumes are kept if `has_volumes`.
    TetCollector(const std::string& path, const Soup& soup, bool has_volumes)
        : path_(path), soup_(soup), has_volumes_(has_volumes) {}

    bool empty() const { return tets_.empty(); }
    std::int64_t count() const { return static_cast<std::int64_t>(tets_.size()); }

    /// Takes a tetrahedron of any orientation, in a volume: any number from 0 on. Calls `fail(message)`, which must
    /// throw, for a corner that is no vertex so far.
    template <class Fail>
    void add(std::span<const std::int64_t> corners, const Fail& fail, std::int32_t volume = 0) {
        const auto vertices = static_cast<std::int64_t>(soup_.vertices.size());
        Tetrahedron tet{};
        for (std::size_t i = 0; i < tet.size(); ++i) {
            if (corners[i] < 0 || corners[i] >= vertices)
                fail("a tetrahedron names vertex number " + std::to_string(corners[i]) +
                     " (counted from 0), but there are " + std::to_string(vertices) +
                     " vertices. Correct it or save the mesh again.");
            tet[i] = static_cast<std::int32_t>(corners[i]);
        }
        if (tets_.size() == std::numeric_limits<std::int32_t>::max())
            throw Error(ErrorCode::input, path_ + ": the file has more than 2^31 - 1 tetrahedra. Split the mesh.");
        tets_.push_back(tet);
        if (has_volumes_) volume_of_tet_.push_back(volume);
    }

    /// Names of the volumes, by their numbers.
    void name_volumes(std::vector<std::string> names) { volume_names_ = std::move(names); }
    const std::vector<std::string>& volume_names() const { return volume_names_; }
    /// Throws Error(input): a surface has one side inside, and these volumes are on both sides of it.
    [[noreturn]] void refuse_wall(const std::string& volume, const std::string& other, const Vec3& where) const {
        throw Error(ErrorCode::input, path_ + ": " + tell_wall(volume, other, where));
    }
    /// Does that for the first facet of the soup between two volumes.
    void refuse_walls() const {
        const auto wall = find_wall(soup_.vertices.size(), tets_, volume_of_tet_, soup_.facets);
        if (!wall) return;
        const Triangle& t = soup_.facets[static_cast<std::size_t>(wall->facet)];
        const auto& p = soup_.vertices;
        refuse_wall(volume_names_[wall->volumes[0]], volume_names_[wall->volumes[1]],
                    (p[t[0]] + p[t[1]] + p[t[2]]) / 3);
    }
    std::vector<Triangle> skin() const { return skin_of(soup_.vertices, tets_); }

    /// The values of this name, one for each vertex so far.
    std::vector<double>& scalar(std::string_view name) {
        const auto of_name = [&](const NodeScalar& scalar) { return scalar.name == name; };
        auto found = std::find_if(scalars_.begin(), scalars_.end(), of_name);
        if (found == scalars_.end()) found = scalars_.insert(found, {std::string(name), {}});
        found->values.resize(soup_.vertices.size(), std::numeric_limits<double>::quiet_NaN());
        return found->values;
    }

    /// The tetrahedra; throws Error(input) if there are none.
    std::vector<Tetrahedron> finish() {
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
    std::vector<Tetrahedron> tets_;
    std::vector<std::int32_t> volume_of_tet_;
    std::vector<std::string> volume_names_;
    std::vector<NodeScalar> scalars_;
};

}  // namespace kerf

// Space is divided into small cubes, and all corners in a cube move to the first one that was met there; triangles that
// lose a corner are left out. That takes one pass over the corners, needs no neighbours and knows any kind of layer.
// Cubes are the same for all layers, so that faces that touch still do.
#include "viewer/scene/stand_in.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace kerf::view {

namespace {

constexpr std::size_t large = 20000;  // triangles of a layer
constexpr int cubes = 200;            // along each axis of draw coordinates, from -1 to 1

class Joiner {
 public:
    Joiner() : places_(std::size_t{cubes} * cubes * cubes) {}

    void join(Layer& layer) {
        auto coarse = std::make_shared<Geometry>();
        coarse->has_normals = layer.geometry->has_normals;
        for (Range& range : layer.ranges) {
            const auto first = static_cast<std::uint32_t>(coarse->triangle_count());
            const auto begin = layer.geometry->corners.begin() + 3 * std::ptrdiff_t{range.first};
            for (auto corner = begin; corner != begin + 3 * std::ptrdiff_t{range.count}; corner += 3)
                add(&*corner, *coarse);
            range.first = first;
            range.count = static_cast<std::uint32_t>(coarse->triangle_count()) - first;
        }
        layer.geometry = std::move(coarse);
        layer.patch = nullptr;
        layer.edges = false;
    }

 private:
    static std::size_t cube_of(const std::array<float, 3>& p) {
        const auto along = [&](std::size_t axis) {
            const float place = std::isfinite(p[axis]) ? std::clamp((p[axis] + 1) * (cubes / 2), 0.f, cubes - 1.f) : 0;
            return static_cast<std::size_t>(place);
        };
        return (along(0) * cubes + along(1)) * cubes + along(2);
    }

    void add(const Corner* corners, Geometry& coarse) {
        std::array<std::size_t, 3> cube;
        for (std::size_t k = 0; k < 3; ++k) cube[k] = cube_of(corners[k].position);
        if (cube[0] == cube[1] || cube[1] == cube[2] || cube[2] == cube[0]) return;
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint32_t& place = places_[cube[k]];
            if (place == 0) {
                met_.push_back(corners[k].position);
                place = static_cast<std::uint32_t>(met_.size());
            }
            Corner moved = corners[k];
            moved.position = met_[place - 1];
            coarse.corners.push_back(moved);
        }
    }

    std::vector<std::uint32_t> places_;  // index in met_ of the corner met in a cube, and 1 more; 0: none yet
    std::vector<std::array<float, 3>> met_;
};

}  // namespace

Scene stand_in_for(const Scene& scene) {
    Scene coarse = scene;
    coarse.occlusion = 0;
    const auto is_large = [](const Layer& layer) { return layer.geometry && layer.geometry->triangle_count() > large; };
    if (std::none_of(coarse.layers.begin(), coarse.layers.end(), is_large)) return coarse;
    Joiner joiner;
    for (Layer& layer : coarse.layers)
        if (is_large(layer)) joiner.join(layer);
    return coarse;
}

}  // namespace kerf::view

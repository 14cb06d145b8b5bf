// The distance to the nearest pixel of another number, along rows and columns, by a pass over the rows in each
// direction (Rosenfeld and Pfaltz 1966, rosenfeld1966).
#include "viewer/render/inside/widest_places.h"

#include <algorithm>
#include <map>

namespace kerf::view {

namespace {

class Distances {
 public:
    Distances(std::span<const std::int32_t> image, int width, int height)
        : image_(image), width_(width), height_(height), distance_(image.size(), 0) {
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) at(x, y) = 1 + std::min(from(x, y, x - 1, y), from(x, y, x, y - 1));
        for (int y = height - 1; y >= 0; --y)
            for (int x = width - 1; x >= 0; --x)
                at(x, y) = std::min(at(x, y), 1 + std::min(from(x, y, x + 1, y), from(x, y, x, y + 1)));
    }
    int& at(int x, int y) { return distance_[index(x, y)]; }

 private:
    std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * width_ + x; }
    // The distance of a neighbour; 0 if it has another number or lies outside.
    int from(int x, int y, int nx, int ny) const {
        const bool is_inside = nx >= 0 && ny >= 0 && nx < width_ && ny < height_;
        return is_inside && image_[index(nx, ny)] == image_[index(x, y)] ? distance_[index(nx, ny)] : 0;
    }

    std::span<const std::int32_t> image_;
    int width_, height_;
    std::vector<int> distance_;
};

}  // namespace

std::vector<NumberPlace> widest_places(std::span<const std::int32_t> image, int width, int height) {
    Distances distances(image, width, height);
    std::map<std::int32_t, std::vector<NumberPlace>> widest;  // by number, all pixels with the most room
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const std::int32_t number = image[static_cast<std::size_t>(y) * width + x];
            if (number < 0) continue;
            std::vector<NumberPlace>& of_number = widest[number];
            const int room = distances.at(x, y);
            if (!of_number.empty() && room < of_number.front().room) continue;
            if (!of_number.empty() && room > of_number.front().room) of_number.clear();
            of_number.push_back({number, x, y, room});
        }
    std::vector<NumberPlace> places;
    for (const auto& [number, of_number] : widest) places.push_back(of_number[of_number.size() / 2]);
    return places;
}

}  // namespace kerf::view

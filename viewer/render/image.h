// Pictures in memory and as PNG.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace kerf::view {

struct Image {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;  ///< 3 bytes per pixel, row by row from the top

    const std::uint8_t* pixel(int x, int y) const { return &rgb[3 * (static_cast<std::size_t>(y) * width + x)]; }
};

/// Smaller by a factor: the mean of factor x factor pixels, which must divide the size.
Image averaged(const Image& image, int factor);

/// Throws Error(io) naming the file if it cannot be read or is none.
Image read_png(const std::string& path);

/// Throws Error(io) naming the file if it cannot be written; an older file is replaced only by a complete one.
void write_png(const std::string& path, const Image& image);

}  // namespace kerf::view

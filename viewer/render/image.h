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

/// Returns the image smaller by a factor: each pixel is the mean of factor x factor pixels. The factor must divide the
/// size.
Image averaged(const Image& image, int factor);

/// Reads a PNG file. Throws Error(io) naming the file if it cannot be read or is none.
Image read_png(const std::string& path);

/// Writes a PNG file; an older file is replaced only by a complete one. Throws Error(io) naming the file if it cannot
/// be written.
void write_png(const std::string& path, const Image& image);

}  // namespace kerf::view

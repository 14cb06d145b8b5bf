// PNG files by stb_image and stb_image_write, compiled here alone and as static functions. Compression is zlib's best,
// which makes files a quarter smaller than stb's own; stb frees the result, so that it must come from malloc(). A
// written file has a text chunk "Software: Kerf" behind its header, by which files/io/output_kind.h knows that it may
// be written over. Pixels are RGB, 8 bits, without alpha.
#include "viewer/render/image.h"

#include <cstdlib>
#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <zlib.h>

#include "base/core/error.h"
#include "base/core/ids.h"
#include "files/io/file_bytes.h"
#include "files/io/output_file.h"

namespace {

// Compresses for stb, which frees the result. zlib's best makes files a quarter smaller than stb's own compression.
unsigned char* compress_best(unsigned char* data, int size, int* compressed_size, int /*quality*/) {
    uLongf length = compressBound(size);
    auto* bytes = static_cast<unsigned char*>(std::malloc(length));
    if (bytes == nullptr || compress2(bytes, &length, data, size, Z_BEST_COMPRESSION) != Z_OK) {
        std::free(bytes);
        return nullptr;
    }
    *compressed_size = static_cast<int>(length);
    return bytes;
}

}  // namespace

// Static: programs that link Debian's libstb have these functions a second time.
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#define STBIW_ZLIB_COMPRESS compress_best
#include <stb_image_write.h>

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#include <stb_image.h>

namespace kerf::view {

namespace {

struct Free {
    void operator()(void* memory) const { std::free(memory); }
};
using Bytes = std::unique_ptr<unsigned char, Free>;

// The PNG with a chunk behind its header that says whose picture it is (files/io/output_kind.h).
std::string marked(std::string png) {
    using namespace std::string_literals;
    constexpr std::size_t end_of_header = 33;
    const std::string chunk = "tEXtSoftware\0Kerf"s;
    const auto number = [](std::size_t n) {  // big-endian
        std::string bytes;
        for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(n >> shift);
        return bytes;
    };
    const auto check = crc32(0, reinterpret_cast<const Bytef*>(chunk.data()), chunk.size());
    return png.insert(end_of_header, number(chunk.size() - 4) + chunk + number(check));
}

}  // namespace

Image averaged(const Image& image, int factor) {
    if (factor == 1) return image;
    Image small{image.width / factor, image.height / factor, {}};
    small.rgb.reserve(image.rgb.size() / (factor * factor));
    for (int y = 0; y < small.height; ++y)
        for (int x = 0; x < small.width; ++x)
            for (int channel = 0; channel < 3; ++channel) {
                int sum = 0;
                for (int j = 0; j < factor; ++j)
                    for (int i = 0; i < factor; ++i) sum += image.pixel(factor * x + i, factor * y + j)[channel];
                small.rgb.push_back(static_cast<std::uint8_t>((sum + factor * factor / 2) / (factor * factor)));
            }
    return small;
}

Image read_png(const std::string& path) {
    const std::string file = read_file(path);
    Image image;
    const bool is_small = std::in_range<int>(file.size());
    const Bytes pixels(is_small ? stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(file.data()), count_of(file),
                                                        &image.width, &image.height, nullptr, 3)
                                : nullptr);
    if (!pixels) throw Error(ErrorCode::io, fmt::format("{} is no PNG.", path));
    image.rgb.assign(pixels.get(), pixels.get() + std::size_t{3} * image.width * image.height);
    return image;
}

void write_png(const std::string& path, const Image& image) {
    int size = 0;
    const Bytes png(stbi_write_png_to_mem(image.rgb.data(), 3 * image.width, image.width, image.height, 3, &size));
    if (!png) throw Error(ErrorCode::memory, fmt::format("There is not enough memory to compress {}.", path));
    write_output_file(path, marked(std::string(reinterpret_cast<const char*>(png.get()), size)));
}

}  // namespace kerf::view

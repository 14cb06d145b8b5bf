#include "files/io/inside/image_formats.h"

#include <array>

#include <fmt/format.h>

namespace kerf {

namespace {

using namespace std::string_view_literals;

// The bytes by which a format is known, at a place of the file.
struct Signature {
    const char* what;
    std::size_t place;
    std::string_view bytes;
};

constexpr std::array signatures = {
    Signature{"an image (NRRD)", 0, "NRRD00"sv},        Signature{"an image (NIfTI)", 344, "n+1\0"sv},
    Signature{"an image (NIfTI)", 344, "ni1\0"sv},      Signature{"an image (NIfTI)", 4, "n+2\0\r\n\x1a\n"sv},
    Signature{"an image (DICOM)", 128, "DICM"sv},       Signature{"an image (MetaImage)", 0, "ObjectType = Image"sv},
    Signature{"an image (MetaImage)", 0, "NDims = "sv}, Signature{"an image (TIFF)", 0, "II*\0"sv},
    Signature{"an image (TIFF)", 0, "MM\0*"sv},         Signature{"an image (PNG)", 0, "\x89PNG\r\n"sv}};

}  // namespace

std::string_view image_format_of(std::string_view bytes) {
    for (const auto& [what, place, signature] : signatures)
        if (bytes.size() > place && bytes.substr(place).starts_with(signature)) return what;
    return {};
}

std::string image_refusal(std::string_view what) {
    return fmt::format(
        "this is {}, and Kerf reads no images yet. Make a surface of it first, for example with 3D Slicer "
        "or the marching cubes of VTK, and give that.",
        what);
}

}  // namespace kerf

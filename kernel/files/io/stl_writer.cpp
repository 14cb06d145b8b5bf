// See stl_reader.cpp for the format. The header must not begin with "solid": readers would take the file for text.
#include "files/io/stl_writer.h"

#include <array>
#include <limits>

#include <Eigen/Geometry>

#include "base/core/check.h"
#include "base/core/elements.h"
#include "base/geometry/triangle.h"
#include "files/io/inside/stl_format.h"
#include "files/io/output_file.h"

namespace kerf {

namespace {

constexpr std::string_view header_text = "Binary STL of Kerf";

template <class T>
void append(std::string& bytes, const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void append_point(std::string& bytes, const Vec3& p) { append(bytes, Eigen::Vector3f(p.cast<float>())); }

}  // namespace

void write_stl(const std::string& path, const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets) {
    KERF_CHECK(facets.size() <= std::numeric_limits<std::uint32_t>::max());
    KERF_CHECK(are_in_range(facets, vertices.size()));
    std::string bytes(header_text);
    bytes.reserve(stl_header_size + stl_facet_size * facets.size());
    bytes.resize(stl_header_size - sizeof(std::uint32_t), ' ');
    append(bytes, static_cast<std::uint32_t>(facets.size()));
    for (const Triangle& t : facets) {
        append_point(bytes, doubled_area_vector(vertices, t).stableNormalized());
        for (const std::int32_t v : t) append_point(bytes, vertices[v]);
        append(bytes, std::uint16_t{0});
    }
    write_output_file(path, bytes);
}

}  // namespace kerf

// One reader by itself, KERF_READER, on any bytes.
#include <algorithm>
#include <string>
#include <string_view>

#include "files/io/compressed.h"
#include "files/io/surface_reader.h"
#include "files/io/tet_mesh_reader.h"
#include "fuzzed.h"

namespace kerf {

namespace {

[[maybe_unused]] Soup read_archive(std::string_view bytes, const std::string& path) {
    decompress(std::string(bytes), path);
    return {};
}

// Tetrahedra as the faces that they have.
[[maybe_unused]] Soup read_tets(std::string_view bytes, const std::string& path) {
    const TetFile file = read_tet_bytes(std::string(bytes), path);
    if (file.is_interface.size() != file.facets.size() || file.mesh.tets.empty()) std::abort();
    Soup faces{file.mesh.vertices, file.facets, {}, {"all"}};
    for (const auto& [a, b, c, d] : file.mesh.tets) faces.facets.insert(faces.facets.end(), {{a, b, c}, {b, c, d}});
    faces.patch.assign(faces.facets.size(), 0);
    return faces;
}

// Touches what the reader promises, so that the address sanitizer sees indices out of range.
void use(const Soup& soup) {
    Vec3 sum = Vec3::Zero();
    for (const Triangle& t : soup.facets)
        for (const std::int32_t v : t) sum += soup.vertices[v];
    std::size_t length = static_cast<std::size_t>(!sum.hasNaN());
    for (const std::int32_t p : soup.patch) length += soup.patch_names[p].size();
    if (soup.patch.size() != soup.facets.size() || length > (std::size_t{1} << 40)) std::abort();
}

}  // namespace

}  // namespace kerf

extern "C" int LLVMFuzzerTestOneInput(const char* data, std::size_t size) {
    kerf::test::run_fuzzed([&] { kerf::use(kerf::KERF_READER(std::string_view(data, size), "fuzzed")); });
    return 0;
}

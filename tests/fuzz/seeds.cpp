// fuzz_seeds FOLDER SURFACE...: small files to begin with, in a folder for each fuzzer: shapes by formula and the first
// facets of each surface, in every format.
#include <filesystem>
#include <fstream>
#include <iostream>

#include "files/io/surface_reader.h"
#include "support/archives.h"
#include "support/shapes.h"
#include "support/surface_files.h"

namespace kerf {

namespace {

namespace fs = std::filesystem;

Soup first_facets(const std::string& path, std::size_t count) {
    Soup soup = read_surface(path);
    soup.facets.resize(std::min(count, soup.facets.size()));
    soup.patch.resize(soup.facets.size());
    drop_unused_vertices(soup);
    return soup;
}

std::string fuzzer_of(const std::string& name) {
    const std::string ending = fs::path(name).extension().string().substr(1);
    if (ending == "msh") return "gmsh";
    if (ending == "mesh") return "medit";
    if (ending == "vtp") return "vtu";
    return ending == "smesh" || ending == "poly" ? "tetgen" : ending;
}

void write(const fs::path& folder, const std::string& name, const std::string& bytes) {
    fs::create_directories(folder);
    std::ofstream(folder / name, std::ios::binary) << bytes;
}

void write_seeds(const fs::path& folder, const Soup& soup, const std::string& name) {
    for (const test::SurfaceFile& file : test::to_all_formats(soup)) {
        const std::string seed = name + "_" + file.name;
        write(folder / fuzzer_of(file.name), seed, file.bytes);
        write(folder / "check", seed, file.bytes);
    }
    const std::vector<Tetrahedron> tets = {{0, 1, 2, 3}};
    for (const test::SurfaceFile& file : test::to_all_mesh_formats(soup, tets))
        write(folder / "tets", name + "_" + file.name, file.bytes);
    const std::string text = test::to_off(soup);
    for (const char* fuzzer : {"archive", "check"}) {
        write(folder / fuzzer, name + ".gz", test::gzip(text));
        write(folder / fuzzer, name + ".zst", test::zstd(text));
    }
}

}  // namespace

}  // namespace kerf

int main(int argc, char** argv) {
    if (argc < 2) {
        std::cerr << "usage: fuzz_seeds FOLDER SURFACE...\n";
        return 2;
    }
    kerf::write_seeds(argv[1], kerf::test::tetrahedron(), "tetrahedron");
    kerf::write_seeds(argv[1], kerf::test::nested_boxes(2), "nested_boxes");
    for (int i = 2; i < argc; ++i)
        kerf::write_seeds(argv[1], kerf::first_facets(argv[i], 12), std::filesystem::path(argv[i]).stem());
}

// Includes may only follow the arrows that kernel/README.md draws.
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "support/places.h"

namespace kerf {
namespace {

namespace fs = std::filesystem;

using Arrows = std::map<std::string, std::set<std::string>>;  // folder -> folders it may include

const fs::path root = test::source_folder();

// The fenced block "arrows": lines "folder -> folder folder".
Arrows read_arrows(std::istream& text) {
    Arrows arrows;
    std::string line;
    while (std::getline(text, line) && line != "```arrows") continue;
    while (std::getline(text, line) && line != "```") {
        std::istringstream words(line);
        std::string folder, arrow, target;
        words >> folder >> arrow;
        EXPECT_EQ(arrow, "->") << line;
        auto& targets = arrows[folder];
        while (words >> target) targets.insert(target);
    }
    return arrows;
}

struct Include {
    fs::path file;
    std::string name;  // between the quotes or angle brackets
};

std::vector<Include> includes_of(const fs::path& folder) {
    static const std::regex directive(R"re(^\s*#\s*include\s*["<]([^">]+)[">])re");
    std::vector<Include> includes;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
        std::ifstream file(entry.path());
        std::smatch match;
        for (std::string line; std::getline(file, line);)
            if (std::regex_search(line, match, directive)) includes.push_back({entry.path(), match[1]});
    }
    return includes;
}

std::vector<Include> all_includes() {
    std::vector<Include> all = includes_of(root / "kernel");
    for (const char* folder : {"cli", "help", "viewer"})
        for (Include& include : includes_of(root / folder)) all.push_back(std::move(include));
    return all;
}

// The folders of the viewer are named with it, as includes name them.
std::string first_folder(const std::string& name) {
    constexpr std::string_view viewer = "viewer/";
    return name.substr(0, name.find('/', name.starts_with(viewer) ? viewer.size() : 0));
}
std::string folder_of(const fs::path& file) {
    const std::string path = fs::relative(file, root).string();
    return first_folder(path.starts_with("kernel/") ? path.substr(7) : path);
}

// Files below the root that include a name for which `matches` holds.
template <class Matches>
std::set<std::string> files_including(Matches matches) {
    std::set<std::string> files;
    for (const Include& include : all_includes())
        if (matches(include.name)) files.insert(fs::relative(include.file, root).string());
    return files;
}

Arrows kernel_arrows() {
    std::ifstream readme(root / "kernel/README.md");
    return read_arrows(readme);
}

TEST(IncludeMap, NamesEveryFolder) {
    const Arrows arrows = kernel_arrows();
    ASSERT_FALSE(arrows.empty()) << "kernel/README.md has no block ```arrows";
    for (const auto& entry : fs::directory_iterator(root / "kernel"))
        EXPECT_TRUE(!entry.is_directory() || arrows.contains(entry.path().filename())) << entry.path();
    for (const auto& entry : fs::directory_iterator(root / "viewer"))
        EXPECT_TRUE(!entry.is_directory() || arrows.contains(fs::relative(entry.path(), root).string()))
            << entry.path();
    for (const auto& [folder, targets] : arrows)
        for (const std::string& target : targets) EXPECT_TRUE(arrows.contains(target)) << folder << " -> " << target;
}

TEST(IncludeMap, HasNoCircle) {
    Arrows arrows = kernel_arrows();
    for (bool changed = true; changed;) {  // take away folders without arrows until none is left
        changed = false;
        for (auto it = arrows.begin(); it != arrows.end();) {
            if (!it->second.empty()) {
                ++it;
                continue;
            }
            for (auto& [folder, targets] : arrows) targets.erase(it->first);
            it = arrows.erase(it);
            changed = true;
        }
    }
    EXPECT_TRUE(arrows.empty()) << "circle through " << arrows.begin()->first;
}

TEST(IncludeMap, IncludesFollowTheArrows) {
    const Arrows arrows = kernel_arrows();
    ASSERT_FALSE(arrows.empty());
    std::int64_t own = 0;
    for (const Include& include : all_includes()) {
        const std::string target = first_folder(include.name), folder = folder_of(include.file);
        if (!arrows.contains(target)) continue;  // of a library
        ++own;
        ASSERT_TRUE(arrows.contains(folder)) << include.file;
        EXPECT_TRUE(target == folder || arrows.at(folder).contains(target))
            << include.file << " includes " << include.name;
    }
    EXPECT_GT(own, 100);
}

TEST(IncludeMap, LibrariesStayInTheirPlaces) {
    EXPECT_EQ(files_including([](const std::string& name) { return name == "mpi.h"; }),
              (std::set<std::string>{"kernel/kerf/mpi.h", "kernel/mpi/mpi_ranks.h"}));
    EXPECT_EQ(files_including([](const std::string& name) { return name.starts_with("petsc"); }),
              (std::set<std::string>{"kernel/solve/linear_system.cpp", "kernel/solve/petsc_session.cpp"}));
    EXPECT_EQ(files_including([](const std::string& name) { return name == "tetgen.h"; }),
              std::set<std::string>{"kernel/volume/tetgen_adapter.cpp"});
    EXPECT_EQ(files_including([](const std::string& name) { return first_folder(name) == "CGAL"; }),
              (std::set<std::string>{"kernel/geometry/predicates.cpp", "kernel/repair/alpha_wrap.cpp",
                                     "kernel/repair/facet_divider.cpp", "kernel/surface/hole_triangulation.cpp",
                                     "kernel/surface/intersections.cpp", "kernel/surface/planar_delaunay.cpp"}));
    const std::set<std::string> slow_parts = {"Eigen/Dense", "Eigen/Eigenvalues", "Eigen/QR",
                                              "Eigen/SVD",   "Eigen/Sparse",      "Eigen/SparseCholesky"};
    EXPECT_EQ(files_including([&](const std::string& name) { return slow_parts.contains(name); }),
              (std::set<std::string>{"kernel/geometry/sparse_factors.cpp", "kernel/geometry/symmetric_axes.cpp",
                                     "kernel/solve/dense.cpp"}));
    EXPECT_EQ(files_including([](const std::string& name) { return first_folder(name) == "toml++"; }),
              (std::set<std::string>{"kernel/request/config_file.cpp", "kernel/solve/case_table.h"}));
    EXPECT_EQ(files_including([](const std::string& name) { return name == "zlib.h" || name == "zstd.h"; }),
              (std::set<std::string>{"kernel/io/compressed.cpp", "viewer/render/image.cpp"}));
    EXPECT_EQ(files_including([](const std::string& name) { return first_folder(name) == "Model"; }),
              std::set<std::string>{"kernel/threemf/threemf_import.cpp"});
    for (const std::string& file : files_including([](const std::string& name) { return name.ends_with(".hxx"); }))
        EXPECT_TRUE(file.starts_with("kernel/cad/")) << file << " includes OpenCASCADE";
    EXPECT_EQ(files_including([](const std::string& name) { return name == "hdf5.h"; }),
              std::set<std::string>{"kernel/export/hdf5_file.cpp"});
    EXPECT_EQ(files_including([](const std::string& name) { return first_folder(name) == "GLFW"; }),
              std::set<std::string>{"viewer/render/window.cpp"});
    EXPECT_EQ(files_including([](const std::string& name) { return name == "GL/osmesa.h"; }),
              std::set<std::string>{"viewer/render/osmesa_context.cpp"});
    EXPECT_EQ(files_including([](const std::string& name) { return first_folder(name) == "EGL"; }),
              std::set<std::string>{"viewer/render/egl_context.cpp"});
    EXPECT_EQ(files_including([](const std::string& name) { return first_folder(name) == "fontconfig"; }),
              std::set<std::string>{"viewer/panels/font_file.cpp"});
    for (const std::string& file : files_including(
             [](const std::string& name) { return name.starts_with("imgui") || first_folder(name) == "GL"; }))
        EXPECT_TRUE(file.starts_with("viewer/render/") || file.starts_with("viewer/panels/") ||
                    file.starts_with("viewer/app/"))
            << file;
}

// Then a header brings nobody what takes seconds to compile.
TEST(IncludeMap, HeadersOnlyDeclareJsonAndTheCommandLine) {
    for (const std::string& file : files_including([](const std::string& name) { return name == "nlohmann/json.hpp"; }))
        EXPECT_FALSE(file.ends_with(".h")) << file << " can do with nlohmann/json_fwd.hpp";
    for (const std::string& file : files_including([](const std::string& name) { return first_folder(name) == "CLI"; }))
        EXPECT_TRUE(!file.ends_with(".h") || file == "help/number_option.h") << file << " can declare what it names";
}

// By io/json.h, so that they are compiled once.
TEST(IncludeMap, JsonIsParsedAndWrittenInOneFolder) {
    static const std::regex call(R"re([jJ]son::parse\(|\.dump\()re");
    std::int64_t own = 0;
    for (const std::string& name :
         files_including([](const std::string& name) { return name == "nlohmann/json.hpp"; })) {
        std::ifstream file(root / name);
        for (std::string line; std::getline(file, line);) {
            if (!std::regex_search(line, call)) continue;
            ++own;
            EXPECT_TRUE(name.starts_with("kernel/io/")) << name << ": " << line;
        }
    }
    EXPECT_GT(own, 3);
}

}  // namespace
}  // namespace kerf

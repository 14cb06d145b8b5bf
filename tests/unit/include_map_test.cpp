// Includes may only follow the arrows that the READMEs of the house and of its wings draw, and enter a room by its
// doors: what no other room includes lies in the folder `inside` of its room.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "support/places.h"

namespace kerf {
namespace {

namespace fs = std::filesystem;

using Arrows = std::map<std::string, std::set<std::string>>;  // wing or room -> those that it may include

const fs::path root = test::source_folder();

const std::set<std::string> wings = {"base", "surface", "cut", "fill", "files", "run", "kerf", "solve"};
const std::set<std::string> with_rooms = {"base", "surface", "cut", "fill", "files", "run", "solve", "viewer"};
const std::set<std::string> programs = {"cli", "python", "viewer/app"};  // which nothing else includes

// The folder of a wing, of the viewer or of a program: kernel/cut of cut.
fs::path folder_of(const std::string& wing) {
    return fs::is_directory(root / "kernel" / wing) ? root / "kernel" / wing : root / wing;
}

// The fenced block "arrows": lines "name -> name name".
Arrows read_arrows(const fs::path& readme) {
    std::ifstream text(readme);
    Arrows arrows;
    std::string line;
    while (std::getline(text, line) && line != "```arrows") continue;
    while (std::getline(text, line) && line != "```") {
        std::istringstream words(line);
        std::string name, arrow, target;
        words >> name >> arrow;
        EXPECT_EQ(arrow, "->") << line;
        auto& targets = arrows[name];
        while (words >> target) targets.insert(target);
    }
    EXPECT_FALSE(arrows.empty()) << readme << " has no block ```arrows";
    return arrows;
}
Arrows arrows_of_house() { return read_arrows(root / "kernel/README.md"); }
Arrows arrows_of_wing(const std::string& wing) { return read_arrows(folder_of(wing) / "README.md"); }

// Where a file of ours lies: surface, repair and inside of kernel/surface/repair/inside/rims.h.
struct Place {
    std::string wing, room;
    bool is_inside = false;

    std::string name() const { return room.empty() ? wing : wing + "/" + room; }
};
Place place_of(const std::string& path) {
    std::vector<std::string> parts;
    for (const fs::path& part : fs::path(path)) parts.push_back(part.string());
    if (parts.front() == "kernel") parts.erase(parts.begin());
    parts.pop_back();
    Place place;
    if (!parts.empty() && parts.back() == "inside") {
        place.is_inside = true;
        parts.pop_back();
    }
    if (!parts.empty()) place.wing = parts[0];
    if (parts.size() > 1) place.room = parts[1];
    return place;
}

struct Include {
    std::string file;                 // below the root
    std::string name;                 // between the quotes or angle brackets
    std::optional<std::string> ours;  // the file of that name below the root
};

std::optional<std::string> file_of_name(const std::string& name) {
    for (const std::string& path : {"kernel/" + name, name})
        if (fs::is_regular_file(root / path)) return path;
    return {};
}

std::vector<Include> read_includes() {
    static const std::regex directive(R"re(^\s*#\s*include\s*["<]([^">]+)[">])re");
    std::vector<Include> includes;
    for (const char* folder : {"kernel", "solve", "cli", "help", "viewer", "python"}) {
        for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
            if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
            std::ifstream file(entry.path());
            const std::string path = fs::relative(entry.path(), root).string();
            std::smatch match;
            for (std::string line; std::getline(file, line);)
                if (std::regex_search(line, match, directive))
                    includes.push_back({path, match[1], file_of_name(match[1])});
        }
    }
    return includes;
}
const std::vector<Include>& all_includes() {
    static const std::vector<Include> all = read_includes();
    return all;
}

std::string first_folder(const std::string& name) { return name.substr(0, name.find('/')); }

// Files below the root that include a name for which `matches` holds.
template <class Matches>
std::set<std::string> files_including(Matches matches) {
    std::set<std::string> files;
    for (const Include& include : all_includes())
        if (matches(include.name)) files.insert(include.file);
    return files;
}

void expect_every_folder(const Arrows& arrows, const fs::path& folder) {
    for (const auto& entry : fs::directory_iterator(folder))
        EXPECT_TRUE(!entry.is_directory() || arrows.contains(entry.path().filename())) << entry.path();
}
void expect_no_circle(Arrows arrows) {
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

TEST(IncludeMap, NamesEveryFolder) {
    const Arrows house = arrows_of_house();
    expect_every_folder(house, root / "kernel");
    for (const std::string& wing : wings) EXPECT_TRUE(house.contains(wing)) << wing;
    for (const std::string& wing : with_rooms) expect_every_folder(arrows_of_wing(wing), folder_of(wing));
}

TEST(IncludeMap, HasNoCircle) {
    expect_no_circle(arrows_of_house());
    for (const std::string& wing : with_rooms) expect_no_circle(arrows_of_wing(wing));
}

// Every include follows an arrow, and every arrow is that of an include.
TEST(IncludeMap, IncludesAreTheArrows) {
    Arrows house;
    std::map<std::string, Arrows> rooms;
    for (const Include& include : all_includes()) {
        if (!include.ours) continue;  // of a library
        const Place from = place_of(include.file), to = place_of(*include.ours);
        if (from.wing != to.wing)
            house[from.wing].insert(to.wing);
        else if (from.room != to.room)
            rooms[from.wing][from.room].insert(to.room);
    }
    for (const auto& [wing, targets] : arrows_of_house()) EXPECT_EQ(house[wing], targets) << wing;
    for (const std::string& wing : with_rooms)
        for (const auto& [room, targets] : arrows_of_wing(wing)) EXPECT_EQ(rooms[wing][room], targets) << wing << room;
}

TEST(IncludeMap, FewArrowsJoinTheWings) {
    std::size_t count = 0;
    for (const auto& [wing, targets] : arrows_of_house()) count += wings.contains(wing) ? targets.size() : 0;
    EXPECT_LE(count, 24U);
}

// The headers on top of a room are those that other rooms include; kerf.h and mpi.h are for programs of others.
TEST(IncludeMap, DoorsAreWhatOthersUse) {
    std::set<std::string> used = {"kernel/kerf/kerf.h", "kernel/kerf/mpi.h"}, doors;
    for (const Include& include : all_includes())
        if (include.ours && place_of(include.file).name() != place_of(*include.ours).name()) used.insert(*include.ours);
    for (const char* folder : {"kernel", "solve", "help", "viewer"}) {
        for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
            const std::string path = fs::relative(entry.path(), root).string();
            if (entry.path().extension() != ".h" || programs.contains(place_of(path).name())) continue;
            EXPECT_FALSE(place_of(path).is_inside && used.contains(path)) << path << " is used by another room";
            if (!place_of(path).is_inside) doors.insert(path);
        }
    }
    for (const std::string& door : doors) EXPECT_TRUE(used.contains(door)) << door << " belongs inside";
    EXPECT_GT(doors.size(), 100U);
}

TEST(IncludeMap, LibrariesStayInTheirPlaces) {
    EXPECT_EQ(files_including([](const std::string& name) { return name == "mpi.h"; }),
              (std::set<std::string>{"kernel/kerf/mpi.h", "kernel/base/mpi/inside/posted_messages.h",
                                     "kernel/base/mpi/mpi_ranks.h"}));
    EXPECT_EQ(files_including([](const std::string& name) { return name.starts_with("petsc"); }),
              (std::set<std::string>{"solve/equations/linear_system.cpp", "solve/equations/inside/petsc_session.cpp"}));
    EXPECT_EQ(files_including([](const std::string& name) { return name == "tetgen.h"; }),
              std::set<std::string>{"kernel/fill/volume/inside/tetgen_adapter.cpp"});
    EXPECT_EQ(files_including([](const std::string& name) { return first_folder(name) == "CGAL"; }),
              (std::set<std::string>{
                  "kernel/base/geometry/predicates.cpp", "kernel/surface/wrap/inside/alpha_wrap.cpp",
                  "kernel/surface/arrange/inside/facet_divider.cpp", "kernel/surface/openings/hole_triangulation.cpp",
                  "kernel/surface/diagnosis/intersections.cpp", "kernel/surface/soup/planar_delaunay.cpp"}));
    const std::set<std::string> slow_parts = {"Eigen/Dense", "Eigen/Eigenvalues", "Eigen/QR",
                                              "Eigen/SVD",   "Eigen/Sparse",      "Eigen/SparseCholesky"};
    EXPECT_EQ(files_including([&](const std::string& name) { return slow_parts.contains(name); }),
              (std::set<std::string>{"kernel/base/geometry/sparse_factors.cpp",
                                     "kernel/base/geometry/symmetric_axes.cpp", "solve/multigrid/dense.cpp"}));
    EXPECT_EQ(files_including([](const std::string& name) { return first_folder(name) == "toml++"; }),
              (std::set<std::string>{"kernel/run/request/config_file.cpp", "solve/case/inside/case_table.h"}));
    EXPECT_EQ(files_including([](const std::string& name) { return name == "zlib.h" || name == "zstd.h"; }),
              (std::set<std::string>{"kernel/files/io/compressed.cpp", "viewer/render/image.cpp"}));
    EXPECT_EQ(
        files_including([](const std::string& name) { return name == "pugixml.hpp"; }),
        (std::set<std::string>{"kernel/files/io/inside/vtu_structure.cpp", "kernel/files/part/inside/vtu_header.cpp"}));
    EXPECT_EQ(files_including([](const std::string& name) { return first_folder(name) == "Model"; }),
              std::set<std::string>{"kernel/files/threemf/threemf_import.cpp"});
    for (const std::string& file : files_including([](const std::string& name) { return name.ends_with(".hxx"); }))
        EXPECT_TRUE(file.starts_with("kernel/files/cad/")) << file << " includes OpenCASCADE";
    EXPECT_EQ(files_including([](const std::string& name) { return name == "hdf5.h"; }),
              std::set<std::string>{"kernel/files/export/inside/hdf5_file.cpp"});
    EXPECT_EQ(files_including([](const std::string& name) { return first_folder(name) == "GLFW"; }),
              std::set<std::string>{"viewer/render/window.cpp"});
    EXPECT_EQ(files_including([](const std::string& name) { return name == "GL/osmesa.h"; }),
              std::set<std::string>{"viewer/render/osmesa_context.cpp"});
    EXPECT_EQ(files_including([](const std::string& name) { return first_folder(name) == "EGL"; }),
              std::set<std::string>{"viewer/render/egl_context.cpp"});
    EXPECT_EQ(files_including([](const std::string& name) { return first_folder(name) == "fontconfig"; }),
              std::set<std::string>{"viewer/panels/inside/font_file.cpp"});
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

// By files/io/json.h, so that they are compiled once.
TEST(IncludeMap, JsonIsParsedAndWrittenInOneFolder) {
    static const std::regex call(R"re([jJ]son::parse\(|\.dump\()re");
    std::int64_t own = 0;
    for (const std::string& name :
         files_including([](const std::string& name) { return name == "nlohmann/json.hpp"; })) {
        std::ifstream file(root / name);
        for (std::string line; std::getline(file, line);) {
            if (!std::regex_search(line, call)) continue;
            ++own;
            EXPECT_TRUE(name.starts_with("kernel/files/io/")) << name << ": " << line;
        }
    }
    EXPECT_GT(own, 3);
}

}  // namespace
}  // namespace kerf

// Meshes of OpenFOAM as they are read back, by a reader that shares nothing with the writer.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/core/types.h"
#include "support/file_contents.h"

namespace kerf::test::openfoam {

struct Patch {
    std::string name, type;
    std::size_t faces = 0, start = 0;
    int self = -1, other = -1;
    std::string sample_region = "", sample_patch = "";
};

struct PolyMesh {
    std::vector<Vec3> points;
    std::vector<std::array<std::int32_t, 3>> faces;
    std::vector<std::int32_t> owner, neighbour;
    std::vector<Patch> patches;
    std::string note;

    // A cell may be the higher one at all of its faces.
    std::size_t cells() const {
        std::int32_t last = -1;
        for (const auto* list : {&owner, &neighbour})
            for (const std::int32_t cell : *list) last = std::max(last, cell);
        return static_cast<std::size_t>(last + 1);
    }
    const Vec3& corner(std::size_t face, std::size_t i) const {
        return points.at(static_cast<std::size_t>(faces[face].at(i)));
    }
    Vec3 area(std::size_t f) const { return 0.5 * (corner(f, 1) - corner(f, 0)).cross(corner(f, 2) - corner(f, 0)); }
    Vec3 centre(std::size_t f) const { return (corner(f, 0) + corner(f, 1) + corner(f, 2)) / 3; }
};

// What follows the header, whose entries must be these.
inline std::string body(const std::string& path, const std::string& kind, const std::string& format,
                        PolyMesh* mesh = nullptr) {
    const std::string bytes = test::bytes_of_file(path);
    const std::size_t end = bytes.find("\n}\n");
    if (!bytes.starts_with("FoamFile\n{") || end == bytes.npos) {
        ADD_FAILURE() << path << " has no header";
        return "";
    }
    std::map<std::string, std::string> entries;
    const std::string header = bytes.substr(0, end + 1);
    const std::regex entry(R"(\n\s+(\w+)\s+(?:"(.*)\"|(\S+));)");
    for (std::sregex_iterator it(header.begin(), header.end(), entry); it != std::sregex_iterator(); ++it)
        entries[(*it)[1]] = (*it)[2].str() + (*it)[3].str();
    EXPECT_EQ(entries["class"], kind) << path;
    EXPECT_EQ(entries["format"], format) << path;
    EXPECT_EQ(entries["object"], std::filesystem::path(path).filename()) << path;
    EXPECT_EQ(entries["arch"], format == "binary" ? "LSB;label=32;scalar=64" : "") << path;
    if (mesh) mesh->note = entries["note"];
    return bytes.substr(end + 3);
}

// The next list of a binary body, from where `at` stands.
template <class T>
std::vector<T> list(const std::string& body, std::size_t& at) {
    std::size_t digits = 0;
    const std::size_t count = std::stoul(body.substr(at, 40), &digits);  // skips blanks
    at += digits;
    EXPECT_EQ(body.substr(at, 2), "\n(");
    at += 2;
    std::vector<T> values(count);
    EXPECT_LE(at + count * sizeof(T) + 1, body.size());
    if (count > 0 && at + count * sizeof(T) < body.size())
        std::memcpy(static_cast<void*>(values.data()), body.data() + at, count * sizeof(T));
    at += count * sizeof(T);
    EXPECT_EQ(body.substr(at, 2), ")\n");
    at += 2;
    return values;
}

template <class T>
std::vector<T> only_list(const std::string& body) {
    std::size_t at = 0;
    std::vector<T> values = list<T>(body, at);
    EXPECT_EQ(at, body.size());
    return values;
}

inline std::vector<Patch> read_patches(const std::string& path) {
    std::string text = body(path, "polyBoundaryMesh", "ascii");
    text = std::regex_replace(text, std::regex("//[^\n]*"), "");
    std::vector<Patch> patches;
    const std::regex block(R"((\S+)\s*\{([^}]*)\})");
    for (std::sregex_iterator it(text.begin(), text.end(), block); it != std::sregex_iterator(); ++it) {
        std::map<std::string, std::string> entries;
        const std::string inner = (*it)[2];
        const std::regex entry(R"((\w+)\s+(\S+);)");
        for (std::sregex_iterator e(inner.begin(), inner.end(), entry); e != std::sregex_iterator(); ++e)
            entries[(*e)[1]] = (*e)[2];
        Patch patch{(*it)[1], entries.at("type"), std::stoul(entries.at("nFaces")),
                    std::stoul(entries.at("startFace"))};
        if (entries.contains("myProcNo")) patch.self = std::stoi(entries["myProcNo"]);
        if (entries.contains("neighbProcNo")) patch.other = std::stoi(entries["neighbProcNo"]);
        if (entries.contains("sampleRegion")) patch.sample_region = entries["sampleRegion"];
        if (entries.contains("samplePatch")) patch.sample_patch = entries["samplePatch"];
        patches.push_back(patch);
    }
    EXPECT_EQ(std::stoul(text), patches.size()) << path;
    return patches;
}

inline PolyMesh read_mesh(const std::string& folder) {
    PolyMesh mesh;
    mesh.points = only_list<Vec3>(body(folder + "points", "vectorField", "binary"));
    mesh.owner = only_list<std::int32_t>(body(folder + "owner", "labelList", "binary", &mesh));
    mesh.neighbour = only_list<std::int32_t>(body(folder + "neighbour", "labelList", "binary"));
    const std::string faces = body(folder + "faces", "faceCompactList", "binary");
    std::size_t at = 0;
    const auto offsets = list<std::int32_t>(faces, at);
    const auto corners = list<std::int32_t>(faces, at);
    EXPECT_EQ(at, faces.size());
    EXPECT_EQ(offsets.size(), mesh.owner.size() + 1);
    for (std::size_t f = 0; f < offsets.size(); ++f) EXPECT_EQ(offsets[f], 3 * f);
    EXPECT_EQ(corners.size(), 3 * mesh.owner.size());
    for (std::size_t c = 0; c + 2 < corners.size(); c += 3)
        mesh.faces.push_back({corners[c], corners[c + 1], corners[c + 2]});
    mesh.patches = read_patches(folder + "boundary");
    return mesh;
}

}  // namespace kerf::test::openfoam

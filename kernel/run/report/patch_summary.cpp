// Sums over triangles are weighted by area. Formats have rules of their own for names; most only put _ in the place of
// some characters, and patches of which this is all are told by one of them.
#include "run/report/patch_summary.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "base/geometry/triangle.h"
#include "files/export/format.h"

namespace kerf {

void PatchSummary::add(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 of_triangle = (b - a).cross(c - a) / 2;
    ++triangles;
    area += of_triangle.norm();
    centroid += of_triangle.norm() * (a + b + c) / 3;
    normal += of_triangle;
}

void PatchSummary::finish() {
    if (!(area > 0)) return;
    centroid /= area;
    normal /= area;
}

std::vector<PatchSummary> summarize_patches(const Soup& soup) {
    std::vector<PatchSummary> patches(soup.patch_names.size());
    for (std::size_t p = 0; p < patches.size(); ++p) patches[p].name = soup.patch_names[p];
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        const auto& [a, b, c] = soup.facets[f];
        patches[soup.patch[f]].add(soup.vertices[a], soup.vertices[b], soup.vertices[c]);
    }
    for (PatchSummary& patch : patches) patch.finish();
    return patches;
}

std::string to_text(const std::vector<PatchSummary>& patches) {
    std::size_t width = 0;  // of the column of faces, which only CAD files have
    for (const PatchSummary& patch : patches) width = std::max(width, patch.face.size());
    const auto face_text = [&](const std::string& face) {
        return width > 0 ? fmt::format("{:<{}}  ", face, std::max<std::size_t>(width, 4)) : std::string();
    };
    std::string text = fmt::format("{:>9} {:>12}  {:<36}  {:<24}  {}{}\n", "triangles", "area", "centroid", "normal",
                                   face_text("face"), "name");
    for (const PatchSummary& patch : patches) {
        constexpr double shown = 1e-3;
        const Vec3 &c = patch.centroid, n = (patch.normal / shown).array().round() * shown + 0.0;  // without -0
        text += fmt::format("{:>9} {:>12.6g}  {:<36}  {:<24}  {}{}\n", patch.triangles, patch.area,
                            fmt::format("({:.6g}, {:.6g}, {:.6g})", c.x(), c.y(), c.z()),
                            fmt::format("({:.3f}, {:.3f}, {:.3f})", n.x(), n.y(), n.z()), face_text(patch.face),
                            patch.name + (patch.triangles == 0 ? " (inside of the body)" : ""));
    }
    return text;
}

namespace {

// Returns the name with _ in the place of what is neither a letter nor a digit.
std::string plain(std::string name) {
    for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    return name;
}

// Returns the words in which formats spell a patch otherwise, each with the names of these formats.
std::vector<std::pair<std::string, std::string>> words_for(
    const std::string& name, std::size_t patch,
    const std::vector<std::pair<const Format*, std::vector<std::string>>>& spelled) {
    std::vector<std::pair<std::string, std::string>> words;
    for (const auto& [format, names] : spelled) {
        const std::string& spelling = names[patch];
        if (spelling == name) continue;
        const auto same =
            std::find_if(words.begin(), words.end(), [&](const auto& word) { return word.first == spelling; });
        if (same == words.end())
            words.emplace_back(spelling, format->name);
        else
            same->second += fmt::format(", {}", format->name);
    }
    return words;
}

}  // namespace

std::string spellings_text(const std::vector<std::string>& patch_names) {
    std::vector<std::pair<const Format*, std::vector<std::string>>> spelled;
    for (const Format* format : formats())
        if (format->patch_words) spelled.emplace_back(format, format->patch_words(patch_names));
    std::map<std::string, std::vector<std::string>> plain_names;  // by formats that only replace characters
    std::string text;
    for (std::size_t p = 0; p < patch_names.size(); ++p) {
        const auto words = words_for(patch_names[p], p, spelled);
        if (words.size() == 1 && words.front().first == plain(patch_names[p])) {
            plain_names[words.front().second].push_back(patch_names[p]);
            continue;
        }
        if (words.empty()) continue;
        text += fmt::format("  {}:", patch_names[p]);
        for (std::size_t i = 0; i < words.size(); ++i)
            text += fmt::format("{} {} in {}", i == 0 ? "" : ";", words[i].first, words[i].second);
        text += "\n";
    }
    for (const auto& [in, names] : plain_names)
        text += fmt::format("  {}: {}{} in {}\n", names.front(), plain(names.front()),
                            names.size() > 1 ? fmt::format(", and {} more with _ likewise", names.size() - 1) : "", in);
    return text.empty() ? "" : "Formats that do not have these names spell them:\n" + text;
}

}  // namespace kerf

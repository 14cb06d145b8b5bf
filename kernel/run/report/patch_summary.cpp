#include "run/report/patch_summary.h"

#include <algorithm>
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
    std::string text =
        fmt::format("{:>9} {:>12}  {:<36}  {:<24}  {}\n", "triangles", "area", "centroid", "normal", "name");
    for (const PatchSummary& patch : patches) {
        constexpr double shown = 1e-3;
        const Vec3 &c = patch.centroid, n = (patch.normal / shown).array().round() * shown + 0.0;  // without -0
        text += fmt::format("{:>9} {:>12.6g}  {:<36}  {:<24}  {}\n", patch.triangles, patch.area,
                            fmt::format("({:.6g}, {:.6g}, {:.6g})", c.x(), c.y(), c.z()),
                            fmt::format("({:.3f}, {:.3f}, {:.3f})", n.x(), n.y(), n.z()), patch.name);
    }
    return text;
}

std::string spellings_text(const std::vector<std::string>& patch_names) {
    std::vector<std::pair<const Format*, std::vector<std::string>>> spelled;
    for (const Format* format : formats())
        if (format->patch_words) spelled.emplace_back(format, format->patch_words(patch_names));
    std::string text;
    for (std::size_t p = 0; p < patch_names.size(); ++p) {
        std::vector<std::pair<std::string, std::string>> words;  // words, and the formats that have them
        for (const auto& [format, names] : spelled) {
            const std::string& name = names[p];
            if (name == patch_names[p]) continue;
            const auto same = std::find_if(words.begin(), words.end(), [&](const auto& w) { return w.first == name; });
            if (same == words.end())
                words.emplace_back(name, format->name);
            else
                same->second += fmt::format(", {}", format->name);
        }
        if (words.empty()) continue;
        text += fmt::format("  {}:", patch_names[p]);
        for (std::size_t i = 0; i < words.size(); ++i)
            text += fmt::format("{} {} in {}", i == 0 ? "" : ";", words[i].first, words[i].second);
        text += "\n";
    }
    return text.empty() ? "" : "Formats that do not have these names spell them:\n" + text;
}

}  // namespace kerf

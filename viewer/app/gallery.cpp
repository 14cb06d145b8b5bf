#include "viewer/app/gallery.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include <fmt/format.h>

#include "base/core/error.h"
#include "viewer/render/image.h"

namespace kerf::view {

namespace {

constexpr std::uintmax_t stl_head_bytes = 84, stl_facet_bytes = 50;

// "bearing_cap_14k" as "Bearing cap 14k".
std::string title_of_stem(std::string stem) {
    std::replace(stem.begin(), stem.end(), '_', ' ');
    if (!stem.empty()) stem.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(stem.front())));
    return stem;
}

void* picture_of(const std::filesystem::path& file, Renderer& renderer) {
    try {
        return renderer.add_picture(read_png(file.string()));
    } catch (const Error&) {
        return nullptr;  // the name is enough
    }
}

// The STL files of a folder by their names, with the pictures gallery/surfaces/NAME.png there, which the renderer
// keeps. Files that cannot be read are left out; an empty path has none.
std::vector<Example> read_examples(const std::string& folder, Renderer& renderer) {
    std::vector<Example> examples;
    std::error_code error;
    std::filesystem::directory_iterator entry(folder, error);
    for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
        const std::filesystem::path& path = entry->path();
        std::error_code no_size;
        const std::uintmax_t bytes = entry->file_size(no_size);
        if (path.extension() != ".stl" || no_size || bytes < stl_head_bytes) continue;
        const std::int64_t facets = (bytes - stl_head_bytes) / stl_facet_bytes;
        examples.push_back({title_of_stem(path.stem().string()), path.string(), facets, nullptr});
    }
    std::sort(examples.begin(), examples.end(), [](const Example& a, const Example& b) { return a.name < b.name; });
    for (Example& example : examples) {
        const std::string stem = std::filesystem::path(example.path).stem().string();
        example.picture = picture_of(fmt::format("{}/gallery/surfaces/{}.png", folder, stem), renderer);
    }
    return examples;
}

}  // namespace

const std::vector<Example>& Gallery::examples() {
    const bool is_start_page = view_.session.document().kind == Document::Kind::none && !view_.session.busy();
    if (is_start_page && !has_looked_) {
        has_looked_ = true;
        examples_ = read_examples(view_.options.example_folder, view_.renderer);
    }
    return examples_;
}

}  // namespace kerf::view

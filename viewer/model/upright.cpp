#include "viewer/model/upright.h"

#include <cctype>

namespace kerf::view {

namespace {

constexpr double clearly = 1.1;

bool is_obj(const std::string& path) {
    std::string ending = path.substr(path.size() - std::min<std::size_t>(path.size(), 4));
    for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return ending == ".obj";
}

}  // namespace

int guessed_up(const Document& document) {
    const std::string& run_of = document.options.input;
    if (document.box.isEmpty() || !is_obj(run_of.empty() ? document.path : run_of)) return 2;
    const Vec3 size = document.box.sizes();
    const bool is_tall = size.y() > clearly * std::max(size.x(), size.z());
    const bool is_flat = clearly * size.y() < std::min(size.x(), size.z());
    return is_tall || is_flat ? 1 : 2;
}

}  // namespace kerf::view

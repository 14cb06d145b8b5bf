// A soup of several regions has one facet for each face at which a region ends: between two regions, a wall, or between
// a region and the outside. FacetSides are the regions `front` and `back` of a facet, none for the outside; the smaller
// region, or the only one, is always behind. Facets that the file has keep their place, patch and polygon number; their
// face is found in a sorted table by vertices, whatever the order of their corners, and the orientation of the face
// replaces theirs. Faces that no facet of the file is come behind them. A face that is in the table twice has three
// tetrahedra or more: the mesh overlaps and is refused. finish() drops what the facets that are gone leave behind
// (patches and unfit polygons) and, for a single region, the sides.
#include "files/io/inside/region_facets.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/ids.h"
#include "surface/soup/region_patches.h"

namespace kerf {

namespace {

namespace region {

constexpr std::size_t longest_patch_name = 255;
constexpr std::int32_t no_face = -1;

Triangle sorted(Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
}

// Finds faces by their three vertices, in any order.
class FaceTable {
 public:
    explicit FaceTable(const std::vector<RegionFace>& faces) {
        for (std::size_t i = 0; i < faces.size(); ++i) entries_.emplace_back(sorted(faces[i].corners), i);
        std::sort(entries_.begin(), entries_.end());
    }
    std::int32_t find(const Triangle& corners) const {
        const std::pair<Triangle, std::int32_t> wanted(sorted(corners), 0);
        const auto found = std::lower_bound(entries_.begin(), entries_.end(), wanted);
        return found != entries_.end() && found->first == wanted.first ? found->second : no_face;
    }
    // The first face that is there twice.
    std::int32_t find_repeated() const {
        const auto found = std::adjacent_find(entries_.begin(), entries_.end(),
                                              [](const auto& a, const auto& b) { return a.first == b.first; });
        return found == entries_.end() ? no_face : found->second;
    }

 private:
    std::vector<std::pair<Triangle, std::int32_t>> entries_;
};

// Finds patches by name, and adds those that the file does not have.
class Patches {
 public:
    explicit Patches(Soup& soup) : soup_(soup) {
        for (std::size_t p = 0; p < soup.patch_names.size(); ++p) numbers_.try_emplace(soup.patch_names[p], p);
    }
    std::int32_t number(const std::string& name) {
        const auto next = count_of(soup_.patch_names);
        const auto [found, is_new] = numbers_.try_emplace(name.substr(0, longest_patch_name), next);
        if (is_new) soup_.patch_names.push_back(found->first);
        return found->second;
    }

 private:
    Soup& soup_;
    std::map<std::string, std::int32_t> numbers_;
};

void note_left_out(Soup& soup, std::int64_t count, const char* one, const char* many) {
    if (count > 0) soup.notes.push_back(fmt::format("{} {} ignored.", count, count == 1 ? one : many));
}

// Returns the face that each facet is, for the facets that stay: those that are no face, or the same as one before, are
// left out.
std::vector<std::int32_t> keep_faces(Soup& soup, const FaceTable& table, std::size_t face_count) {
    std::vector<std::int32_t> face_of_facet;
    std::vector<char> drop(soup.facets.size(), 0), is_taken(face_count, 0);
    std::int64_t others = 0, copies = 0;
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        const std::int32_t face = table.find(soup.facets[f]);
        const bool is_copy = face != no_face && is_taken[face];
        others += face == no_face;
        copies += is_copy;
        drop[f] = face == no_face || is_copy;
        if (drop[f]) continue;
        is_taken[face] = 1;
        face_of_facet.push_back(face);
    }
    drop_facets(soup, drop);
    note_left_out(soup, others, "triangle at which no region ends was", "triangles at which no region ends were");
    note_left_out(soup, copies, "triangle that the file has twice was", "triangles that the file has twice were");
    return face_of_facet;
}

// Appends the faces that are no facets yet, with numbers of polygons behind those of the file.
void append_faces(Soup& soup, std::size_t face_count, std::int32_t polygon_count,
                  std::vector<std::int32_t>& face_of_facet) {
    std::vector<char> is_taken(face_count, 0);
    for (const std::int32_t face : face_of_facet) is_taken[face] = 1;
    if (soup.polygon.empty() && polygon_count != count_of(soup.facets)) {
        soup.polygon.resize(soup.facets.size());
        std::iota(soup.polygon.begin(), soup.polygon.end(), 0);
    }
    for (std::size_t i = 0; i < face_count; ++i) {
        if (is_taken[i]) continue;
        face_of_facet.push_back(i);
        if (!soup.polygon.empty()) soup.polygon.push_back(polygon_count++);
    }
}

std::string patch_name(const FacetSides& sides, const std::vector<std::string>& names) {
    if (names.size() == 1) return "surface";
    if (!sides.is_wall()) return "outer";
    return wall_name(names, sides);
}

// Forgets unfit polygons none of whose facets is left.
void drop_unfit_polygons(Soup& soup) {
    std::vector<std::int32_t> kept = soup.polygon;
    std::sort(kept.begin(), kept.end());
    if (!soup.polygon.empty())
        std::erase_if(soup.unfit_polygons,
                      [&](std::int32_t p) { return !std::binary_search(kept.begin(), kept.end(), p); });
}

void finish(Soup& soup, const std::vector<std::string>& region_names) {
    drop_unused_patches(soup);
    drop_unfit_polygons(soup);
    if (region_names.size() == 1) {
        soup.sides.clear();
        return;
    }
    soup.region_names = region_names;
    const auto walls =
        std::count_if(soup.sides.begin(), soup.sides.end(), [](const FacetSides& s) { return s.is_wall(); });
    soup.notes.push_back(tell_regions(region_names, walls, soup.facets.size()));
}

}  // namespace region

}  // namespace

void take_region_faces(Soup& soup, const std::vector<RegionFace>& faces, const std::vector<std::string>& region_names,
                       const FileFacets& file, const std::string& path) {
    const region::FaceTable table(faces);
    if (const std::int32_t repeated = table.find_repeated(); repeated != region::no_face)
        refuse_overlap(soup, faces[repeated], region_names, path);
    std::vector<std::int32_t> face_of_facet = region::keep_faces(soup, table, faces.size());
    const std::size_t of_file = face_of_facet.size();
    region::append_faces(soup, faces.size(), file.polygon_count, face_of_facet);
    soup.facets.resize(face_of_facet.size());
    soup.patch.resize(face_of_facet.size());
    soup.sides.resize(face_of_facet.size());
    region::Patches patches(soup);
    for (std::size_t f = 0; f < face_of_facet.size(); ++f) {
        const RegionFace& face = faces[face_of_facet[f]];
        soup.facets[f] = face.corners;
        soup.sides[f] = face.sides;
        if (f >= of_file || soup.patch[f] == file.unnamed_patch)
            soup.patch[f] = patches.number(region::patch_name(face.sides, region_names));
    }
    region::finish(soup, region_names);
}

void take_region_sides(Soup& soup, std::vector<FacetSides> sides, const std::vector<std::string>& region_names) {
    soup.sides = std::move(sides);
    std::vector<char> drop(soup.facets.size(), 0);
    std::int64_t dropped = 0;
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        FacetSides& of_facet = soup.sides[f];
        drop[f] = of_facet.front == of_facet.back;
        dropped += drop[f];
        if (of_facet.back.is_valid() && (!of_facet.front.is_valid() || of_facet.back < of_facet.front)) continue;
        of_facet = of_facet.turned();
        std::swap(soup.facets[f][1], soup.facets[f][2]);
    }
    drop_facets(soup, drop);
    region::note_left_out(soup, dropped, "triangle at which no region ends was",
                          "triangles at which no region ends were");
    region::finish(soup, region_names);
}

void refuse_overlap(const Soup& soup, const RegionFace& face, const std::vector<std::string>& region_names,
                    const std::string& path) {
    const auto& [a, b, c] = face.corners;
    const Vec3 where = (soup.vertices[a] + soup.vertices[b] + soup.vertices[c]) / 3;
    const auto name = [&](RegionIndex region) { return region_names[std::max(region, RegionIndex(0)).value()]; };
    const RegionIndex other = face.sides.front.is_valid() ? face.sides.front : face.sides.back;
    throw Error(ErrorCode::input, path + ": " + tell_overlap(name(face.sides.back), name(other), where));
}

}  // namespace kerf

// Collects the surface of a file: vertices, polygons and named patches, and tetrahedra with it.
#pragma once

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/core/error.h"
#include "base/core/ids.h"
#include "files/io/inside/polygon_fan.h"
#include "files/io/inside/tet_collector.h"
#include "surface/soup/facet_triangulation.h"
#include "surface/soup/soup.h"
#include "surface/soup/vertex_table.h"

namespace kerf {

class SoupBuilder {
 public:
    enum class Wanted { surface, tets, tets_and_scalars };
    /// Takes the path of the file, for messages, and the wanted content. A reader that meets tetrahedra adds them in
    /// any case.
    explicit SoupBuilder(const std::string& path, Wanted wanted = Wanted::surface)
        : path_(path), wanted_(wanted), tets_(path, soup_, !wants_scalars()) {}
    SoupBuilder& operator=(SoupBuilder&&) = delete;  // the collector of tetrahedra refers to the soup

    bool wants_tets() const { return wanted_ == Wanted::tets || wants_scalars(); }
    bool wants_scalars() const { return wanted_ == Wanted::tets_and_scalars; }
    /// Returns the collector of tetrahedra. Where a surface is wanted, the regions of the tetrahedra decide where it
    /// runs, unless other cells fill a part of the space: see count_other_cells().
    TetCollector& tets() { return tets_; }

    std::int64_t vertex_count() const { return std::ssize(soup_.vertices); }
    const Soup& soup() const { return soup_; }

    void add_vertex(const Vec3& p) {
        if (soup_.vertices.size() == std::numeric_limits<std::int32_t>::max())
            throw Error(ErrorCode::input, path_ + ": the file has more than 2^31 - 1 vertices. Split the surface.");
        soup_.vertices.push_back(p);
    }
    /// Takes the number of facets that the file claims, before they come. Throws Error(input) if a surface cannot have
    /// so many.
    void announce_facets(std::int64_t count) const {
        if (count > most_facets - std::ssize(soup_.facets))
            throw Error(ErrorCode::input, path_ + ": the file claims to hold " + std::to_string(count) +
                                              " facets, but a surface can have " + std::to_string(most_facets) +
                                              " at most. Split it, or export it again if there are fewer.");
    }
    /// Facets that follow belong to the patch of this name; a patch without facets is not kept.
    void set_patch(std::string_view name) {
        is_unnamed_ = false;
        if (name == patch_name_) return;
        patch_name_ = name;
        patch_ = -1;
    }
    /// Facets that follow have no patch in the file, and belong to "surface": as walls between regions they get another
    /// name.
    void set_unnamed_patch() {
        set_patch("surface");
        is_unnamed_ = true;
    }
    /// Takes the sides of the facets (#F), where the file has them without tetrahedra; see take_region_sides().
    void set_sides(std::vector<FacetSides> sides, std::vector<std::string> region_names) {
        sides_ = std::move(sides);
        region_names_ = std::move(region_names);
    }
    /// Adds a polygon as a fan of triangles, in the current patch. Calls `fail(message)`, which must throw, if the
    /// polygon has less than three corners, or a corner that is no vertex so far. A polygon that no fan covers (see
    /// find_fan()) is noted.
    template <class Fail>
    void add_polygon(std::span<const std::int64_t> corners, const Fail& fail) {
        if (corners.size() < 3) fail("a facet has less than three vertices. Remove it or export the surface again.");
        check_indices(corners, fail);
        add_fan(corners, corners.size() > 3 ? find_fan(soup_.vertices, corners) : PolygonFan{});
    }
    /// Adds a facet of several polygons with holes, in the current patch, triangulated without new vertices; so is a
    /// single polygon that no fan covers. A facet of edges and vertices alone is left out. Calls `fail(message)`, which
    /// must throw, for a corner that is no vertex so far, and for a facet that triangulate_facet() refuses; a refused
    /// single polygon is noted as add_polygon() does.
    template <class Fail>
    void add_facet_of_polygons(const PolygonalFacet& facet, const Fail& fail) {
        for (const auto& polygon : facet.polygons) check_indices(polygon, fail);
        const auto has_area = [](const auto& polygon) { return polygon.size() > 2; };
        if (std::none_of(facet.polygons.begin(), facet.polygons.end(), has_area)) {
            number_polygons();
            ++polygon_count_;
            ++facets_without_area_;
            return;
        }
        const bool is_single = facet.polygons.size() == 1 && facet.holes.empty();
        const auto& first = facet.polygons.front();
        if (is_single && first.size() == 3) return add_fan(first, {});
        const PolygonFan fan = is_single ? find_fan(soup_.vertices, first) : PolygonFan{};
        if (is_single && !fan.obstacle) return add_fan(first, fan);
        const FacetTriangulation found = triangulate_facet(soup_.vertices, facet);
        if (!found.obstacle.empty() && is_single) return add_fan(first, fan);
        if (!found.obstacle.empty())
            fail("facet " + std::to_string(polygon_count_) + " (counted from 0) " + found.obstacle +
                 ". Correct it or export the surface as triangles.");
        edges_outside_ += found.outside;
        number_polygons();
        for (const Triangle& triangle : found.triangles) add_facet(triangle);
        ++polygon_count_;
    }
    /// Makes room for so many triangles of a closed surface, once the file is known to have them.
    void reserve_separate_facets(std::size_t count) {
        soup_.facets.reserve(count);
        soup_.patch.reserve(count);
        soup_.vertices.reserve(count / 2 + count / 16);  // pages that are not used are none
        table_ = VertexTable(count / 2);
    }
    /// Adds triangles by their corners, three each, in the current patch. Corners with equal coordinates are one
    /// vertex, as weld_exactly() has it, if all vertices come in this way. Fastest with some hundred corners a call.
    void add_separate_facets(std::span<const Vec3> corners) {
        hashes_.clear();
        for (const Vec3& p : corners) table_.prefetch(hashes_.emplace_back(hash_of_point(p)));
        for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
            const std::int32_t a = welded(corners[i], hashes_[i]), b = welded(corners[i + 1], hashes_[i + 1]);
            add_facet({a, b, welded(corners[i + 2], hashes_[i + 2])});
            ++polygon_count_;
        }
    }
    /// Counts a cell with nodes between its corners, straight or curved, of which only the corners are taken: that is
    /// noted.
    void count_cell_by_corners() { ++cells_by_corners_; }
    bool has_cells_by_corners() const { return cells_by_corners_ > 0; }
    bool has_facets() const { return !soup_.facets.empty(); }
    /// Adds a point in a void.
    void add_hole(const Vec3& point) { soup_.holes.push_back(point); }
    void add_seed(RegionSeed seed) { soup_.seeds.push_back(std::move(seed)); }
    void note(std::string text) { soup_.notes.push_back(std::move(text)); }
    /// Notes that so many things of the file were not used; no note if `count` is 0.
    void note_ignored(std::int64_t count, const char* one, const char* many) {
        if (count == 0) return;
        soup_.notes.push_back(std::to_string(count) + " " +
                              (count == 1 ? std::string(one) + " was" : std::string(many) + " were") + " ignored.");
    }
    /// Counts cells with a volume that are no tetrahedra. Beside them the tetrahedra of a single volume tell only where
    /// a part of the space ends, and facets of the file are taken instead, if there are any.
    void count_other_cells(std::int64_t count) { other_cells_ += count; }
    /// Returns the soup. With tetrahedra its facets are all faces at which a region ends. Throws Error(input) if there
    /// is no facet in it.
    Soup finish() {
        note_ignored(facets_without_area_, "facet of edges or points alone", "facets of edges or points alone");
        note_ignored(edges_outside_, "edge or point outside of its facet", "edges or points outside of their facets");
        note_cells_by_corners();
        const bool is_part = other_cells_ > 0 && has_facets() && tets_.volume_count() < 2;
        if (!tets_.empty() && !is_part)
            take_regions();
        else if (!sides_.empty())
            take_region_sides(soup_, std::move(sides_), region_names_);
        if (is_part) note_ignored(tets_.count(), "tetrahedron", "tetrahedra");
        if (soup_.facets.empty())
            throw Error(ErrorCode::input, path_ + ": the file holds no facets. Export the surface again.");
        return std::move(soup_);
    }
    /// Returns the soup without the tetrahedra, which may have no facets.
    Soup finish_beside_tets() {
        note_cells_by_corners();
        return std::move(soup_);
    }

 private:
    template <class Fail>
    void check_indices(std::span<const std::int64_t> corners, const Fail& fail) const {
        for (std::int64_t v : corners)
            if (v < 0 || v >= vertex_count())
                fail("a facet names vertex number " + std::to_string(v) + " (counted from 0), but there are " +
                     std::to_string(vertex_count()) + " vertices. Correct it or export the surface again.");
    }
    void add_fan(std::span<const std::int64_t> corners, const PolygonFan& fan) {
        if (fan.obstacle) soup_.unfit_polygons.push_back(polygon_count_);
        if (corners.size() > 3) number_polygons();
        const auto corner = [&](std::size_t i) -> std::int32_t { return corners[(fan.apex + i) % corners.size()]; };
        for (std::size_t i = 2; i < corners.size(); ++i) add_facet({corner(0), corner(i - 1), corner(i)});
        ++polygon_count_;
    }
    std::int32_t welded(const Vec3& p, std::uint64_t hash) {
        add_vertex(p);
        const std::int32_t last = vertex_count() - 1, vertex = table_.enter(last, hash, soup_.vertices);
        if (vertex != last) soup_.vertices.pop_back();
        return vertex;
    }
    void take_regions() {
        const std::vector<RegionFace> faces = tets_.faces_of_regions();
        if (std::ssize(faces) > most_facets) refuse_facets();
        if (!has_facets() && tets_.volume_count() < 2) note(tell_skin(tets_.count()));
        if (tets_.region_names().size() == 1 && tets_.volume_count() > 1)
            note(tell_joined_volumes(tets_.volume_count(), tets_.region_names().front()));
        take_region_faces(soup_, faces, tets_.region_names(), {polygon_count_, unnamed_patch_}, path_);
    }
    void note_cells_by_corners() {
        if (cells_by_corners_ == 1) note("1 cell of higher order was read by its corners.");
        if (cells_by_corners_ > 1)
            note(std::to_string(cells_by_corners_) + " cells of higher order were read by their corners.");
    }
    [[noreturn]] void refuse_facets() const {
        throw Error(ErrorCode::input, path_ + ": the file has more than " + std::to_string(most_facets) +
                                          " facets, which is the most that a surface can have. Split it.");
    }
    void add_facet(const Triangle& facet) {
        if (std::ssize(soup_.facets) == most_facets) refuse_facets();
        if (patch_ < 0) {
            patch_ = patch_of_name_.try_emplace(patch_name_, count_of(soup_.patch_names)).first->second;
            if (patch_ == count_of(soup_.patch_names)) soup_.patch_names.push_back(patch_name_.substr(0, longest_name));
        }
        if (is_unnamed_) unnamed_patch_ = patch_;
        soup_.facets.push_back(facet);
        soup_.patch.push_back(patch_);
        if (has_fans_) soup_.polygon.push_back(polygon_count_);
    }
    // Gives polygons numbers of their own from the first fan on, from where facets and polygons have different numbers.
    void number_polygons() {
        if (has_fans_) return;
        has_fans_ = true;
        soup_.polygon.resize(soup_.facets.size());
        std::iota(soup_.polygon.begin(), soup_.polygon.end(), 0);
    }
    static constexpr std::size_t longest_name = 255;  // bytes that are kept

    const std::string& path_;
    Wanted wanted_;
    Soup soup_;
    TetCollector tets_;
    std::string patch_name_ = "surface";
    std::int32_t polygon_count_ = 0;
    std::int64_t facets_without_area_ = 0, edges_outside_ = 0, cells_by_corners_ = 0, other_cells_ = 0;
    bool has_fans_ = false;
    std::int32_t patch_ = -1;  // patch of the current name, -1 as long as no facet has used it
    std::map<std::string, std::int32_t> patch_of_name_;
    bool is_unnamed_ = false;          // the facets that follow have no patch in the file
    std::int32_t unnamed_patch_ = -1;  // patch of the facets without one in the file
    std::vector<FacetSides> sides_;
    std::vector<std::string> region_names_;
    VertexTable table_;  // vertices of separate facets; below, hashes of their corners
    std::vector<std::uint64_t> hashes_;
};

}  // namespace kerf

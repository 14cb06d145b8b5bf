// The seams of the input are the edges that do not have exactly two facets; each of their sheets has the edge. Copies
// of a vertex are an end where seams end, part or touch: where not one seam goes on as another one, with every fan of
// facets between the two.
#include "surface/remesh/inside/sheet_state.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/core/ids.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

// Numbers the seams, and returns for each corner of a border of sheets the number of its seam, -1 for others.
std::vector<std::int32_t> number_seams(const Sheets& sheets, std::int32_t& count) {
    std::vector<std::int32_t> seam(sheets.partner.size(), -1);
    EdgeCorners(sheets.facets_before()).for_each_edge([&](std::int32_t, std::span<const EdgeCorners::Corner> corners) {
        if (corners.size() <= 2) return;
        for (const auto& [high, corner] : corners) seam[corner] = count;
        ++count;
    });
    return seam;
}

// Whether one seam goes on as another one at these copies of a vertex, and every fan lies between the two. `seams`: two
// for each fan, in its order; there are as many fans as copies.
bool is_on_line(std::vector<std::int32_t> seams, std::size_t copies) {
    for (std::size_t i = 0; i < seams.size(); i += 2)
        if (seams[i] == seams[i + 1]) return false;
    std::sort(seams.begin(), seams.end());
    return seams[copies - 1] == seams.front() && seams[copies] == seams.back();
}

void make_places(const Sheets& sheets, const std::vector<std::int32_t>& seam, SheetState& state) {
    SheetArrays& arrays = state.arrays;
    std::vector<std::vector<std::int32_t>> copies(sheets.vertices_before), seams(arrays.points.size());
    for (std::int32_t v = 0; v < count_of(sheets.original); ++v) copies[sheets.original[v]].push_back(v);
    for (std::int32_t corner = 0; corner < count_of(seam); ++corner)
        if (seam[corner] >= 0)
            for (const std::int32_t c : {corner, next_corner(corner)})
                seams[start_vertex(arrays.corners, c)].push_back(seam[corner]);
    for (const std::vector<std::int32_t>& vertices : copies) {
        if (vertices.size() < 2) continue;
        std::vector<std::int32_t> all;
        bool is_fixed = false, has_two_each = true;
        for (const std::int32_t v : vertices) {
            is_fixed |= arrays.vertices[v].is_fixed;
            has_two_each &= seams[v].size() == 2;
            all.insert(all.end(), seams[v].begin(), seams[v].end());
        }
        const bool is_end = !has_two_each || !is_on_line(std::move(all), vertices.size());
        for (const std::int32_t v : vertices) {
            arrays.vertices[v].is_fixed = is_fixed;
            arrays.vertices[v].is_end = is_end;
            arrays.vertices[v].place = state.places;
        }
        ++state.places;
    }
}

}  // namespace

SheetState sheet_state(const InputShape& input, const std::vector<char>& kept) {
    const Sheets& sheets = input.sheets();
    SheetState state;
    SheetArrays& arrays = state.arrays;
    arrays.points = input.vertices();
    arrays.vertices.resize(arrays.points.size());
    for (std::int32_t v = 0; v < count_of(arrays.points); ++v) {
        arrays.vertices[v].tolerance = input.vertex_tolerance(v);
        arrays.vertices[v].input = v;
    }
    arrays.corners = input.facets();
    const bool has_seams = arrays.points.size() > sheets.vertices_before;
    std::vector<std::int32_t> seam;
    if (has_seams) seam = number_seams(sheets, state.seams);
    for (std::int32_t f = 0; f < count_of(arrays.corners); ++f) {
        const bool is_kept = !kept.empty() && kept[f] != 0;
        arrays.facets.push_back({.patch = input.patch(f),
                                 .region = input.regions().of[f],
                                 .near = f,
                                 .is_kept = is_kept,
                                 .is_wall = input.is_wall(f)});
        for (std::int32_t corner = 3 * f; corner < 3 * f + 3; ++corner)
            arrays.edges.push_back({.is_feature = input.is_feature(corner), .seam = has_seams ? seam[corner] : -1});
        if (is_kept)
            for (const std::int32_t v : arrays.corners[f]) arrays.vertices[v].is_fixed = true;
    }
    if (has_seams) make_places(sheets, seam, state);
    state.planes = input.regions().planes;
    state.next_point.assign(input.vertices().size(), -1);
    return state;
}

void find_regions(const InputShape& input, double share, SheetState& state) {
    SheetArrays& arrays = state.arrays;
    const auto flatness = [&](std::int32_t f) {
        return share * input.largest_tolerance() * input.share_by_thickness(arrays.facets[f].near);
    };
    const auto is_border = [&](std::int32_t corner) { return arrays.edges[corner].is_feature; };
    FlatRegions regions = find_flat_regions(arrays.points, arrays.corners,
                                            {.tolerance = flatness, .noise = input.noise(), .is_border = is_border});
    state.planes = std::move(regions.planes);
    for (std::size_t f = 0; f < arrays.facets.size(); ++f) arrays.facets[f].region = regions.of[f];
}

std::vector<std::int32_t> first_copies(const SheetArrays& sheets) {
    std::vector<std::int32_t> first(sheets.vertices.size()), of_place;
    for (std::int32_t v = 0; v < count_of(first); ++v) {
        first[v] = v;
        const std::int32_t place = sheets.vertices[v].place;
        if (place < 0) continue;
        if (place >= count_of(of_place)) of_place.resize(place + 1, -1);
        if (of_place[place] < 0) of_place[place] = v;
        first[v] = of_place[place];
    }
    return first;
}

SurfaceArrays joined_surface(const SheetArrays& sheets) {
    SurfaceArrays result;
    std::vector<std::int32_t> number = first_copies(sheets);
    for (std::int32_t v = 0; v < count_of(number); ++v) {
        if (number[v] != v) {
            number[v] = number[number[v]];
            continue;
        }
        number[v] = count_of(result.vertices);
        result.vertices.push_back(sheets.points[v]);
        result.vertex_key.push_back(make_key(input_node, number[v]));
    }
    for (std::int32_t f = 0; f < count_of(sheets.corners); ++f) {
        const Triangle& t = sheets.corners[f];
        result.facets.push_back({number[t[0]], number[t[1]], number[t[2]]});
        result.facet_key.push_back(make_key(input_node, f));
        result.patch.push_back(sheets.facets[f].patch);
    }
    return result;
}

std::int64_t count_features(const SheetArrays& sheets) {
    std::int64_t halves = 0;
    std::vector<std::int32_t> seams;
    for (const SheetEdge& edge : sheets.edges) {
        if (!edge.is_feature) continue;
        if (edge.seam < 0)
            ++halves;
        else
            seams.push_back(edge.seam);
    }
    std::sort(seams.begin(), seams.end());
    return halves / 2 + (std::unique(seams.begin(), seams.end()) - seams.begin());
}

}  // namespace kerf

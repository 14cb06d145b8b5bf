#include "run/report/inside/region_summary.h"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "base/geometry/triangle.h"
#include "run/prepare/input.h"
#include "surface/complex/mass_properties.h"

namespace kerf {

std::vector<RegionSummary> summarize_regions(const Soup& soup) {
    std::vector<RegionSummary> regions;
    if (soup.sides.empty()) return regions;
    const Complex complex = make_complex(soup);
    for (const RegionIndex region : ids<RegionIndex>(complex.region_count())) {
        const Surface surface = complex.surface_of(region);
        regions.push_back({soup.region_names[static_cast<std::size_t>(region.value())],
                           enclosed_volume(surface),
                           find_shells(surface).count,
                           0,
                           {}});
    }
    std::map<std::pair<std::int32_t, std::int32_t>, double> walls;
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        const auto [front, back] = soup.sides[f];
        const auto [a, b, c] = soup.facets[f];
        const double area = triangle_area(soup.vertices[a], soup.vertices[b], soup.vertices[c]);
        if (soup.sides[f].is_wall()) {
            walls[{front, back}] += area;
            walls[{back, front}] += area;
        } else {
            regions[static_cast<std::size_t>(std::max(front, back))].outer_area += area;
        }
    }
    for (const auto& [sides, area] : walls)
        regions[static_cast<std::size_t>(sides.first)].walls.push_back(
            {soup.region_names[static_cast<std::size_t>(sides.second)], area, sides.second});
    return regions;
}

std::string region_tables(const std::vector<RegionSummary>& regions) {
    if (regions.empty()) return "The surface bounds one region, which has no name.\n";
    std::string text = fmt::format("{:>12} {:>6} {:>12}  {}\n", "volume", "shells", "outside", "name");
    std::string walls;
    for (std::size_t r = 0; r < regions.size(); ++r) {
        const RegionSummary& region = regions[r];
        text += fmt::format("{:>12.6g} {:>6} {:>12.6g}  {}\n", region.volume, region.shells, region.outer_area,
                            region.name);
        for (const CommonWall& wall : region.walls)
            if (wall.number > static_cast<std::int32_t>(r))
                walls += fmt::format("{:>12.6g}  {}  {}\n", wall.area, region.name, wall.region);
    }
    return text + (walls.empty() ? "" : fmt::format("\n{:>12}  wall between\n{}", "area", walls));
}

std::string to_text(const std::vector<RegionSummary>& regions) {
    constexpr std::size_t most = 50;
    std::string text;
    for (std::size_t r = 0; r < std::min(most, regions.size()); ++r) {
        const RegionSummary& region = regions[r];
        text += fmt::format("  region    {}: volume {:.6g}, {} shell{}", region.name, region.volume, region.shells,
                            region.shells == 1 ? "" : "s");
        if (region.outer_area > 0) text += fmt::format(", outside {:.6g}", region.outer_area);
        for (const CommonWall& wall : region.walls) text += fmt::format(", wall to {} {:.6g}", wall.region, wall.area);
        text += "\n";
    }
    if (regions.size() > most) text += fmt::format("{:12}and {} more\n", "", regions.size() - most);
    return text;
}

}  // namespace kerf

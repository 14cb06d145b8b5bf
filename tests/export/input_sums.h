// What the mesh of a case must add up to.
#pragma once

#include <map>
#include <string>

#include <Eigen/Geometry>

#include "export/cases.h"

namespace kerf::test {

inline double signed_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return (b - a).cross(c - a).dot(d - a) / 6;
}
inline double area(const Vec3& a, const Vec3& b, const Vec3& c) { return (b - a).cross(c - a).norm() / 2; }

/// Of the body that the surface encloses.
inline double volume_of(const Soup& soup) {
    double volume = 0;
    for (const Triangle& t : soup.facets)
        volume += signed_volume(Vec3::Zero(), soup.vertices[t[0]], soup.vertices[t[1]], soup.vertices[t[2]]);
    return volume;
}

inline std::map<std::string, double> area_by_patch(const Soup& soup) {
    std::map<std::string, double> areas;
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        const Triangle& t = soup.facets[f];
        areas[soup.patch_names[static_cast<std::size_t>(soup.patch[f])]] +=
            area(soup.vertices[t[0]], soup.vertices[t[1]], soup.vertices[t[2]]);
    }
    return areas;
}

inline void expect_same_areas(const std::map<std::string, double>& found, const std::map<std::string, double>& wanted) {
    EXPECT_EQ(found.size(), wanted.size());
    for (const auto& [name, area] : wanted) {
        ASSERT_TRUE(found.contains(name)) << name;
        EXPECT_NEAR(found.at(name), area, 1e-9 * area) << name;
    }
}

}  // namespace kerf::test

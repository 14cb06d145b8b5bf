// Surfaces as files, with coordinates that are read back bit for bit.
#pragma once

#include <fstream>
#include <limits>
#include <string>

#include "surface/soup/soup.h"

namespace kerf::test {

inline void write_off(const std::string& path, const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets) {
    std::ofstream file(path);
    file.precision(std::numeric_limits<double>::max_digits10);
    file << "OFF\n" << vertices.size() << ' ' << facets.size() << " 0\n";
    for (const Vec3& p : vertices) file << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    for (const Triangle& t : facets) file << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
}

}  // namespace kerf::test

// The options of TetGen alone.
#pragma once

#include <cstdint>
#include <string>

namespace kerf {

struct TetgenOptions {
    std::string switches;  ///< switches of an expert, which replace the bounds of MesherOptions; a volume is in units
                           ///< of the input cubed
    double tolerance = 0;  ///< relative tolerance for points that count as coplanar; 0: TetGen's own
    std::uint32_t shuffle = 0;  ///< seed of a fixed shuffle of vertices and facets, the usual cure when TetGen fails;
                                ///< 0: they are handed over as they are

    template <class Archive>
    void archive(Archive& a) {
        a(switches, tolerance, shuffle);
    }
};

}  // namespace kerf

// What cannot be joined: the counts of a piece, without meshes of that size.
#include "files/part/joined_parts.h"

#include <gtest/gtest.h>

#include "base/core/error.h"

namespace kerf {
namespace {

// Four parts that claim to have so many tetrahedra, and have three vertices and a triangle each.
class FourParts : public PartSource {
 public:
    explicit FourParts(std::int64_t tets) {
        for (NodeId id(4); id < NodeId(8); ++id) outline_.parts.push_back({id, 3, tets, 1, 0});
    }
    const MeshOutline& outline() const override { return outline_; }
    Part load(PartIndex index) const override {
        ++loaded;
        Part part;
        part.id = outline_.parts[index].id;
        part.mesh.vertices = {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()};
        part.facets = {{0, 1, 2}};
        part.patch = {0};
        part.neighbour = {NodeId::none()};
        return part;
    }
    mutable int loaded = 0;

 private:
    MeshOutline outline_;
};

std::string refusal(const FourParts& parts, std::int32_t pieces, std::int64_t most = JoinedParts::most_of_piece) {
    try {
        const JoinedParts joined(parts, pieces, most);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        return error.what();
    }
    return "";
}

TEST(JoinedParts, RefuseMoreTetrahedraThanNumbersBeforeAnyIsLoaded) {
    const FourParts parts(1'000'000'000);
    EXPECT_NE(refusal(parts, 1).find("a piece of 4000000000 tetrahedra of parts 4 to 7"), std::string::npos);
    EXPECT_EQ(parts.loaded, 0);
    EXPECT_EQ(refusal(parts, 2), "");
    EXPECT_EQ(parts.loaded, 4);
}

TEST(JoinedParts, RefuseMoreVerticesOrTrianglesThanNumbers) {
    const FourParts parts(1);
    EXPECT_NE(refusal(parts, 2, 5).find("6 vertices of parts 4 to 5"), std::string::npos);
    EXPECT_EQ(refusal(parts, 2, 6), "");
}

}  // namespace
}  // namespace kerf

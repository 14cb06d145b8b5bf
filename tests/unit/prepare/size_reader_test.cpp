// A background mesh is the same field in every format.
#include "run/prepare/size_reader.h"

#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/core/error.h"
#include "support/shapes.h"
#include "support/size_fields.h"
#include "support/temporary_folder.h"
#include "surface/complex/mass_properties.h"

namespace kerf {
namespace {

using namespace test;

std::string vtu_text(const SizedMesh& mesh, const std::string& scalars) {
    std::string points, corners, ends, types;
    for (const Vec3& p : mesh.vertices) points += fmt::format("{} {} {}\n", p.x(), p.y(), p.z());
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        corners += fmt::format("{}\n", fmt::join(mesh.tets[t], " "));
        ends += fmt::format("{}\n", 4 * (t + 1));
        types += "10\n";
    }
    return fmt::format(
        "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\"><UnstructuredGrid><Piece NumberOfPoints=\"{}\" "
        "NumberOfCells=\"{}\"><PointData>{}</PointData><Points><DataArray type=\"Float64\" "
        "NumberOfComponents=\"3\">{}</DataArray></Points><Cells><DataArray type=\"Int32\" "
        "Name=\"connectivity\">{}</DataArray><DataArray type=\"Int32\" Name=\"offsets\">{}</DataArray><DataArray "
        "type=\"UInt8\" Name=\"types\">{}</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>",
        mesh.vertices.size(), mesh.tets.size(), scalars, points, corners, ends, types);
}

std::string vtu_scalar(const std::string& name, const std::vector<double>& values) {
    return fmt::format("<DataArray type=\"Float64\" Name=\"{}\">{}</DataArray>", name, fmt::join(values, " "));
}

template <class Number>
void append_bytes(std::string& bytes, Number number) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

// MSH 2.2; the nodes are numbered from 5, and the data come backwards.
std::string msh_text(const SizedMesh& mesh, bool binary) {
    std::string text = fmt::format("$MeshFormat\n2.2 {} 8\n", binary ? 1 : 0);
    if (binary) {
        append_bytes(text, std::int32_t{1});
        text += '\n';
    }
    text += fmt::format("$EndMeshFormat\n$Nodes\n{}\n", mesh.vertices.size());
    const auto add_row = [&](std::initializer_list<std::int32_t> whole, std::initializer_list<double> real) {
        for (const std::int32_t number : whole)
            binary ? append_bytes(text, number) : void(text += fmt::format("{} ", number));
        for (const double number : real) binary ? append_bytes(text, number) : void(text += fmt::format("{} ", number));
        if (!binary) text += '\n';
    };
    const auto tag = [](std::size_t v) { return static_cast<std::int32_t>(v) + 5; };
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
        add_row({tag(v)}, {mesh.vertices[v].x(), mesh.vertices[v].y(), mesh.vertices[v].z()});
    text += fmt::format("$EndNodes\n$Elements\n{}\n", mesh.tets.size());
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        const auto& [a, b, c, d] = mesh.tets[t];
        const auto number = static_cast<std::int32_t>(t + 1);
        if (binary)
            add_row({4, 1, 2, number, 0, 1, a + 5, b + 5, c + 5, d + 5}, {});
        else
            add_row({number, 4, 2, 0, 1, a + 5, b + 5, c + 5, d + 5}, {});
    }
    text += fmt::format("$EndElements\n$NodeData\n1\n\"edge length\"\n1\n0.0\n3\n0\n1\n{}\n", mesh.size.size());
    for (std::size_t v = mesh.size.size(); v-- > 0;) add_row({tag(v)}, {mesh.size[v]});
    return text + "$EndNodeData\n";
}

class SizeFiles : public testing::Test {
 protected:
    SizeField read(const std::string& name, const std::string& bytes) const {
        std::ofstream(folder_.file(name), std::ios::binary) << bytes;
        SizeOptions options;
        options.field_file = folder_.file(name);
        return read_size_field(options, to_arrays(box()), {"surface"});
    }
    void expect_refused(const std::string& bytes, const std::vector<std::string>& words) const {
        try {
            read("bad.vtu", bytes);
            ADD_FAILURE() << "accepted";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::input);
            for (const std::string& word : words)
                EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
        }
    }
    const TemporaryFolder folder_;
    const SizedMesh mesh_ = sized_grid(Vec3(-1, -2, -3), Vec3(3, 2, 1), 3,
                                       [](const Vec3& p) { return 1 + 0.1 * p.x() + 0.05 * p.y() * p.z(); });
};

TEST_F(SizeFiles, AreTheSameFieldInEveryFormat) {
    const SizeField wanted = make_size_field({}, to_arrays(box()), {"surface"}, mesh_);
    std::mt19937 random(1);
    const std::vector<double> other(mesh_.size.size(), 7.0);
    for (const SizeField& field :
         {read("one.vtu", vtu_text(mesh_, vtu_scalar("h", mesh_.size))),
          read("two.vtu", vtu_text(mesh_, vtu_scalar("other", other) + vtu_scalar("size", mesh_.size))),
          read("text.msh", msh_text(mesh_, false)), read("binary.msh", msh_text(mesh_, true))})
        for (int i = 0; i < 100; ++i) {
            const Vec3 p = random_point(random, 4);
            EXPECT_NEAR(field.at(p), wanted.at(p), 1e-12);
        }
}

TEST_F(SizeFiles, NeedAPositiveScalarAtEachNode) {
    std::vector<double> size = mesh_.size;
    expect_refused(vtu_text(mesh_, ""), {"bad.vtu", "no scalar"});
    expect_refused(vtu_text(mesh_, vtu_scalar("h", size) + vtu_scalar("k", size)), {"h, k", "size"});
    size[3] = 0;
    expect_refused(vtu_text(mesh_, vtu_scalar("h", size)), {"node 3", "positive"});
    size.pop_back();
    expect_refused(vtu_text(mesh_, vtu_scalar("h", size)), {"one value for each point"});
}

TEST(SizesOfAir, GrowFromTheBodyToTheBoxAndAreFineInTheWake) {
    const Soup ball = test::icosphere(2);
    InputOptions options;
    options.air.box = "2,2,4";
    options.air.edge = 1.0;
    options.air.wake = 0.1;
    const Input input = make_input(ball.vertices, ball.facets, {}, {}, options);
    ASSERT_TRUE(input.enclosure);
    const SizeField field = read_size_field(sizes_of_cells({}, input), input);
    EXPECT_NEAR(field.at(input.enclosure->wake->center()), 0.1, 1e-12);
    EXPECT_NEAR(field.at(input.enclosure->box.min()), 1, 0.2) << "far from the body";
    EXPECT_LE(field.at(Vec3(0, 0, 1.1)), 0.4) << "beside it";
    EXPECT_NEAR(input.reference_volume(input.volume), enclosed_volume(ball.vertices, ball.facets), 1e-9);
}

}  // namespace
}  // namespace kerf

// The page of a run: what its bytes hold is what the run has, however coarse, and what is no finished run is refused.
#include "files/html/report_page.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "files/html/inside/packed_surface.h"
#include "files/html/inside/page_surface.h"
#include "files/io/compressed.h"
#include "support/assets.h"
#include "support/file_contents.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

using Json = nlohmann::json;
using Corners = std::array<PageSurface::GridPoint, 3>;

// A box of so many squares a side whose side x = `shared` belongs to another part as well.
Part box_of_squares(NodeId id, NodeId neighbour, double from, double to, double shared, int squares, double bend) {
    Part part;
    part.id = id;
    const auto vertex = [&](const Vec3& u) {
        part.mesh.vertices.emplace_back(from + u.x() * (to - from), u.y() + bend * std::sin(7 * u.z()), u.z());
        return static_cast<std::int32_t>(part.mesh.vertices.size() - 1);
    };
    for (int axis = 0; axis < 3; ++axis)
        for (const int end : {0, 1})
            for (int i = 0; i < squares; ++i)
                for (int k = 0; k < squares; ++k) {
                    const auto corner = [&](int a, int b) {
                        Vec3 u;
                        u[axis] = end;
                        u[(axis + 1) % 3] = static_cast<double>(i + a) / squares;
                        u[(axis + 2) % 3] = static_cast<double>(k + b) / squares;
                        return vertex(u);
                    };
                    const std::array<std::int32_t, 4> c = {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
                    const bool is_shared = axis == 0 && (end == 0 ? from : to) == shared;
                    for (const Triangle& t : {Triangle{c[0], c[1], c[2]}, Triangle{c[0], c[2], c[3]}}) {
                        part.facets.push_back(end == 1 ? t : Triangle{t[0], t[2], t[1]});
                        part.patch.push_back(is_shared ? -1 : 2 * axis + end);
                        part.neighbour.push_back(is_shared ? neighbour : NodeId::none());
                    }
                }
    part.mesh.boundary_vertex_count = static_cast<std::int32_t>(part.mesh.vertices.size());
    return part;
}

struct TwoParts {
    Part first, second;

    explicit TwoParts(unsigned seed) {
        std::mt19937 random(seed);
        const int squares = std::uniform_int_distribution(1, 24)(random);
        const double middle = std::uniform_real_distribution(0.2, 0.8)(random);
        const double bend = std::uniform_real_distribution(0.0, 0.1)(random);
        first = box_of_squares(NodeId(2), NodeId(3), 0, middle, middle, squares, bend);
        second = box_of_squares(NodeId(3), NodeId(2), middle, 1, middle, squares, bend);
    }
    Box box() const {
        Box all = box_around(first.mesh.vertices);
        all.extend(box_around(second.mesh.vertices));
        return all;
    }
    PageSurface surface(std::int64_t limit) const {
        PageSurface made(box(), limit);
        made.add(first);
        made.add(second);
        return made;
    }
};

// The corners of triangles beside `neighbour`, from the smallest one on; of turned ones as seen from the other side.
std::multiset<Corners> places(const PageSurface& surface, const PagePart& part, NodeId neighbour, bool turned) {
    std::multiset<Corners> all;
    for (const PageTriangle& t : part.triangles) {
        if (t.neighbour != neighbour) continue;
        Corners corners;
        for (int i = 0; i < 3; ++i) corners[i] = surface.place_of(part.cells[t.corners[i]]);
        if (turned) std::swap(corners[1], corners[2]);
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
        all.insert(corners);
    }
    return all;
}

TEST(PageSurface, HasAllTrianglesWithinHalfAStepIfTheyAreFew) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE(seed);
        const TwoParts parts(seed);
        const PageSurface surface = parts.surface(1'000'000);
        EXPECT_EQ(surface.joins(), 0);
        EXPECT_EQ(surface.triangles(), std::ssize(parts.first.facets) + std::ssize(parts.second.facets));
        EXPECT_EQ(surface.triangles_of_run(), surface.triangles());
        std::set<PageSurface::GridPoint> there;
        for (const std::uint64_t cell : surface.parts()[0].cells) there.insert(surface.place_of(cell));
        for (const Vec3& vertex : parts.first.mesh.vertices) {
            const Vec3 steps = (vertex - surface.low()) / surface.step();
            EXPECT_TRUE(there.contains({std::llround(steps.x()), std::llround(steps.y()), std::llround(steps.z())}));
        }
    }
}

TEST(PageSurface, ObeysItsLimitAndInterfacesFitHoweverCoarse) {
    int coarser = 0;
    for (unsigned seed = 0; seed < 20; ++seed)
        for (const std::int64_t limit : {2000, 500, 100, 20}) {
            SCOPED_TRACE(testing::Message() << "seed " << seed << ", limit " << limit);
            const PageSurface surface = TwoParts(seed).surface(limit);
            EXPECT_LE(surface.triangles(), limit);
            coarser += surface.joins() > 0;
            std::int64_t counted = 0;
            for (const PagePart& part : surface.parts()) {
                counted += std::ssize(part.triangles);
                EXPECT_TRUE(std::is_sorted(part.triangles.begin(), part.triangles.end()));
            }
            EXPECT_EQ(counted, surface.triangles());
            EXPECT_EQ(places(surface, surface.parts()[0], NodeId(3), false),
                      places(surface, surface.parts()[1], NodeId(2), true));
        }
    EXPECT_GT(coarser, 20);
}

// The value is the place along x, so that the mean in a cell lies in the cell, and its step among 256 says where.
TEST(PageSurface, ValuesAreMeansOfTheirCellsHoweverCoarse) {
    for (const std::int64_t limit : {1'000'000, 300, 40}) {
        const TwoParts parts(3);
        PageSurface surface(parts.box(), limit);
        for (const Part* part : {&parts.first, &parts.second}) {
            std::vector<double> along_x;
            for (const Vec3& vertex : part->mesh.vertices) along_x.push_back(vertex.x());
            surface.add(*part, {along_x});
        }
        const double cell_size = surface.step() * std::exp2(surface.joins());
        for (const PagePart& part : surface.parts())
            for (std::size_t cell = 0; cell < part.cells.size(); ++cell)
                EXPECT_NEAR(part.value(0, cell),
                            surface.low().x() + surface.step() * surface.place_of(part.cells[cell])[0],
                            1.01 * cell_size);
        const std::vector<ValueRange> ranges = ranges_of(surface);
        ASSERT_EQ(ranges.size(), 1U);
        EXPECT_GE(ranges[0].least, 0);
        EXPECT_LE(ranges[0].most, 1);
        EXPECT_GT(packed_surface(surface, ranges).size(), packed_surface(surface).size());
    }
}

// As view.js reads them.
class PackedReader {
 public:
    explicit PackedReader(std::string_view bytes) : bytes_(bytes) {}
    std::int64_t next() {
        std::uint64_t value = 0;
        for (int shift = 0;; shift += 7) {
            const auto byte = static_cast<unsigned char>(bytes_.at(place_++));
            value |= static_cast<std::uint64_t>(byte & 0x7f) << shift;
            if (byte < 0x80) break;
        }
        return static_cast<std::int64_t>(value >> 1) ^ -static_cast<std::int64_t>(value & 1);
    }
    bool is_at_end() const { return place_ == bytes_.size(); }

 private:
    std::string_view bytes_;
    std::size_t place_ = 0;
};

TEST(PackedSurface, IsReadAsItWas) {
    for (unsigned seed = 0; seed < 10; ++seed) {
        const PageSurface surface = TwoParts(seed).surface(seed % 2 == 0 ? 1'000'000 : 300);
        const std::string bytes = packed_surface(surface), block = deflate_block(bytes);
        EXPECT_EQ(inflate_block(block, bytes.size(), "block"), bytes);
        PackedReader reader(bytes);
        for (const PagePart& part : surface.parts()) {
            PageSurface::GridPoint place{0, 0, 0};
            for (const std::uint64_t cell : part.cells) {
                for (std::int64_t& steps : place) steps += reader.next();
                ASSERT_EQ(place, surface.place_of(cell));
            }
            std::int64_t first = 0;
            for (const PageTriangle& t : part.triangles) {
                first += reader.next();
                const std::int64_t second = first + reader.next(), third = first + reader.next();
                ASSERT_EQ((std::array{first, second, third}),
                          (std::array<std::int64_t, 3>{t.corners[0], t.corners[1], t.corners[2]}));
            }
        }
        EXPECT_TRUE(reader.is_at_end());
    }
}

TEST(PackedSurface, BaseSixtyFourIsThatOfItsStandard) {
    const std::vector<std::pair<std::string, std::string>> vectors = {
        {"", ""}, {"f", "Zg=="}, {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foob", "Zm9vYg=="}, {"\xff\xfe\xfd", "//79"}};
    for (const auto& [bytes, text] : vectors) EXPECT_EQ(base64(bytes), text);
}

class ReportPageOfRun : public testing::Test {
 protected:
    static void SetUpTestSuite() {
        folder_ = std::make_unique<test::TemporaryFolder>();
        for (const char* command : {"mesh", "decompose"}) {
            const ChildResult run =
                test::run_kerf({command, test::asset_path("cube"), "-o", path(command), "-n", "3", "-q"});
            ASSERT_EQ(run.exit_code, 0) << run.log;
        }
    }
    static void TearDownTestSuite() { folder_.reset(); }
    static std::string path(const std::string& name) { return folder_->file(name); }

    static Json data_of(const std::string& html) {
        const std::string begin = R"(<script type="application/json" id="data">)";
        const std::size_t from = html.find(begin) + begin.size();
        return Json::parse(html.substr(from, html.find("</script>", from) - from));
    }
    static void expect_refused(const std::vector<std::string>& arguments, int exit_code, const std::string& words) {
        std::vector<std::string> all = {"report"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        const ChildResult result = test::run_kerf(all);
        EXPECT_EQ(result.exit_code, exit_code) << result.log;
        EXPECT_NE(result.log.find(words), std::string::npos) << result.log;
    }

    static std::unique_ptr<test::TemporaryFolder> folder_;
};
std::unique_ptr<test::TemporaryFolder> ReportPageOfRun::folder_;

TEST_F(ReportPageOfRun, HasTheCountsOfItsReport) {
    for (const char* run : {"mesh", "decompose"}) {
        const ReportPage page = report_page(path(run));
        const Json data = data_of(page.html), report = Json::parse(test::bytes_of_file(path(run) + "/report.json"));
        EXPECT_EQ(data["report"]["totals"], report["totals"]);
        EXPECT_EQ(data["report"]["quality"], report["quality"]);
        EXPECT_EQ(data["report"]["input"]["path"], "cube.stl");
        ASSERT_EQ(page.parts, 3);
        for (int i = 0; i < page.parts; ++i) {
            const Json &part = data["surface"]["parts"][i], &of_run = report["parts"][i];
            EXPECT_EQ(part["id"], of_run["id"]);
            EXPECT_EQ(part["triangles"], of_run["surface_faces"]);
            EXPECT_EQ(part["vertices"], of_run["surface_vertices"]);
            std::int64_t triangles = 0;
            for (const Json& group : part["groups"]) triangles += group[2].get<std::int64_t>();
            EXPECT_EQ(triangles, of_run["surface_faces"]);
        }
        EXPECT_EQ(report_page(path(run)).html, page.html);
        EXPECT_EQ(page.html.find("src="), std::string::npos) << "another file is named";
        EXPECT_EQ(page.html.find("{{"), std::string::npos) << "a blank of the page was not filled";
    }
}

// Of each region and file its name, and of no file where it lay.
TEST_F(ReportPageOfRun, NamesRegionsAndFilesButNoFolders) {
    const std::string other = path("here/cement.stl");
    std::filesystem::create_directory(path("here"));
    std::filesystem::copy_file(test::asset_path("cement"), other);
    const ChildResult run = test::run_kerf({"mesh", test::asset_path("bone"), other, "-o", path("regions"), "-n", "2",
                                            "--order", "2", "--report", path("again.json"), "-q"});
    ASSERT_EQ(run.exit_code, 0) << run.log;
    const std::string html = report_page(path("regions")).html;
    EXPECT_NE(html.find("<h1 id=\"title\">bone.stl and cement.stl</h1>"), std::string::npos);
    const Json data = data_of(html);
    EXPECT_EQ(data["report"]["options"]["with"], Json({"cement.stl"}));
    EXPECT_EQ(data["surface"]["regions"], Json({"bone", "cement"}));
    std::set<int> regions;
    for (const Json& part : data["surface"]["parts"]) regions.insert(part["region"].get<int>());
    EXPECT_EQ(regions, (std::set<int>{0, 1}));
    EXPECT_EQ(html.find(path("")), std::string::npos);
    EXPECT_EQ(html.find(test::asset_path("bone")), std::string::npos);
}

TEST_F(ReportPageOfRun, ShowsPartsThatFailedAndWhy) {
    const ChildResult run = test::run_kerf({"mesh", test::asset_path("cube"), "-o", path("failed"), "-n", "2",
                                            "--max-volume", "2e-7", "--timeout", "0.3", "--attempts", "1", "-q"});
    ASSERT_EQ(run.exit_code, 4) << run.log;
    const ReportPage page = report_page(path("failed"));
    EXPECT_EQ(page.parts, 2);
    const Json data = data_of(page.html);
    std::string errors;
    for (const Json& part : data["report"]["parts"]) errors += part.value("error", "");
    EXPECT_NE(errors.find("ran longer than its 0.3 s"), std::string::npos) << errors;
    for (const Json& part : data["surface"]["parts"]) EXPECT_GT(part["triangles"], 0);
}

TEST_F(ReportPageOfRun, SaysThatASurfaceIsCoarser) {
    const ReportPage page = report_page(path("mesh"), 1000);
    EXPECT_LE(page.triangles, 1000);
    EXPECT_EQ(page.triangles_of_run, report_page(path("mesh")).triangles);
    const Json surface = data_of(page.html)["surface"];
    EXPECT_EQ(surface["triangles"], page.triangles);
    EXPECT_EQ(surface["triangles_of_run"], page.triangles_of_run);
    EXPECT_GT(surface["joins"], 0);
}

TEST_F(ReportPageOfRun, IsWrittenByTheCommandAndReplacesAnOlderOne) {
    std::ofstream(path("page.html")) << report_page(path("decompose")).html;
    const ChildResult written = test::run_kerf({"report", path("mesh"), "-o", path("page.html")});
    EXPECT_EQ(written.exit_code, 0) << written.log;
    EXPECT_NE(written.log.find("3 parts"), std::string::npos) << written.log;
    EXPECT_EQ(test::bytes_of_file(path("page.html")), report_page(path("mesh")).html);
}

TEST_F(ReportPageOfRun, RefusesWhatItCannotShow) {
    expect_refused({path("mesh")}, 2, "--output");
    expect_refused({path("nowhere"), "-o", path("a.html")}, 7, "is not a finished run");
    expect_refused({path("mesh"), "-o", path("mesh/a.html")}, 7, "Name a file beside it");
    expect_refused({path("mesh"), "-o", path("nowhere/a.html")}, 7, "--output");
    std::filesystem::copy(path("mesh"), path("altered"), std::filesystem::copy_options::recursive);
    std::ofstream(path("altered/report.json"), std::ios::app) << " ";
    expect_refused({path("altered"), "-o", path("a.html")}, 8, "is not as Kerf has written it");
    std::filesystem::copy_file(path("mesh/report.json"), path("altered/report.json"),
                               std::filesystem::copy_options::overwrite_existing);
    std::filesystem::remove(path("altered/parts/part_0006.surface.vtu"));
    expect_refused({path("altered"), "-o", path("a.html")}, 7, "part_0006.surface.vtu");
    EXPECT_FALSE(std::filesystem::exists(path("a.html")));
}

}  // namespace
}  // namespace kerf

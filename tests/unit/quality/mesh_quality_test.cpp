// The quality of whole meshes: measured, as text and picture, and held against limits.
#include "files/quality/inside/measured_mesh.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <random>
#include <regex>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/core/error.h"
#include "files/quality/compared_quality.h"
#include "files/quality/inside/histogram_rows.h"
#include "files/quality/quality_sheet.h"
#include "support/shapes.h"
#include "support/surface_files.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

MeshQuality quality_of_random_cells(unsigned seed, int count, double length_scale = 4) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-1, 1);
    const auto point = [&] { return Vec3(number(random), number(random), number(random)); };
    MeshQuality quality;
    quality.name = "seed " + std::to_string(seed);
    quality.cells = PartQuality(length_scale);
    for (int i = 0; i < count; ++i) {
        const TetQuality cell = tet_quality(point(), point(), point(), point());
        (i % 4 == 0 ? quality.cells.interface : quality.cells.interior).add(cell);
        (i % 5 == 0 ? quality.cells.angles.forced : quality.cells.angles.unforced).add(cell.min_dihedral_deg);
        quality.boundary.add(triangle_angles(point(), point(), point()));
    }
    quality.cells.all.add(quality.cells.interface);
    quality.cells.all.add(quality.cells.interior);
    return quality;
}

std::vector<const Distribution*> all_distributions(const MeshQuality& quality) {
    std::vector<const Distribution*> all;
    for (const Distribution& each : quality.cells.all.measures) all.push_back(&each);
    for (const Distribution& each : quality.boundary.measures) all.push_back(&each);
    return all;
}

TEST(TriangleAngles, AreThoseOfTheTextbook) {
    constexpr unsigned seed = 3;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-1, 1);
    for (int i = 0; i < 1000; ++i) {
        std::array<Vec3, 3> p;
        for (Vec3& x : p) x = Vec3(number(random), number(random), number(random));
        std::array<double, 3> angles{};
        for (std::size_t k = 0; k < 3; ++k)
            angles[k] = std::acos((p[(k + 1) % 3] - p[k]).normalized().dot((p[(k + 2) % 3] - p[k]).normalized()));
        const auto [low, high] = std::minmax_element(angles.begin(), angles.end());
        const TriangleAngles found = triangle_angles(p[0], p[1], p[2]);
        EXPECT_NEAR(found.min_deg, *low * 180 / std::numbers::pi, 1e-9);
        EXPECT_NEAR(found.max_deg, *high * 180 / std::numbers::pi, 1e-9);
    }
    const TriangleAngles flat = triangle_angles(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(3, 0, 0));
    EXPECT_EQ(flat.min_deg, 0);
    EXPECT_EQ(flat.max_deg, 180);
}

// The bin that is found without a logarithm is that of the logarithm, also at the very edge of bins.
TEST(Distribution, BinsAreThoseOfTheExactLogarithm) {
    for (const auto& [low, high] : {std::pair(0.5, 1e4), {1.0, 1e4}, {1e-9, 1.0}, {3.7e-22, 3.7e5}, {1e-270, 1e-243}}) {
        const Distribution distribution(Distribution::Scale::logarithmic, low, high);
        const double bins_per_octave = Distribution::bin_count / std::log2(high / low);
        const auto expect_bin = [&, low = low, high = high](double value) {
            if (!(value > low) || value >= high) return;
            const int exact =
                std::min(static_cast<int>(bins_per_octave * std::log2(value / low)), Distribution::bin_count - 1);
            ASSERT_EQ(distribution.bin_of(value), exact) << std::hexfloat << value;
        };
        for (int bin = 0; bin <= Distribution::bin_count; ++bin) {
            const double edge = low * std::exp2(bin / bins_per_octave);
            double above = edge, below = edge;
            for (int step = 0; step < 20; ++step) {
                expect_bin(above = std::nextafter(above, 2 * high));
                expect_bin(below = std::nextafter(below, 0.0));
                expect_bin(edge * (1 + step * 1e-9));
                expect_bin(edge * (1 - step * 3e-8));
                expect_bin(edge * std::exp2((step + 0.5) / 20 / bins_per_octave));
            }
        }
    }
}

TEST(HistogramRows, CoverEveryCellWithoutMoreThanAreWanted) {
    for (const int count : {1, 7, 3000}) {
        const MeshQuality quality = quality_of_random_cells(5, count);
        for (const Distribution* each : all_distributions(quality))
            for (const RowsWanted& wanted : {RowsWanted{}, RowsWanted{90, 0, 24}, RowsWanted{18, 0, 1440}}) {
                const HistogramRows rows = choose_rows(std::span(&each, 1), wanted);
                EXPECT_LE(rows.groups, wanted.most);
                EXPECT_GE(rows.groups * rows.group, wanted.least_bins);
                ASSERT_LE(rows.first + rows.groups * rows.group, Distribution::bin_count);
                const auto histogram = each->histogram(rows.first, rows.group, rows.groups);
                std::int64_t counted = 0;
                for (const std::int64_t in_interval : histogram.counts) counted += in_interval;
                EXPECT_EQ(counted, count);
            }
    }
}

TEST(HistogramRows, LeaveOutNoMoreThanTheTails) {
    const MeshQuality quality = quality_of_random_cells(6, 20000);
    for (const Distribution* each : all_distributions(quality)) {
        const HistogramRows rows = choose_rows(std::span(&each, 1), {.most = 90, .tail = 0.01});
        std::int64_t counted = 0;
        for (const std::int64_t count : each->histogram(rows.first, rows.group, rows.groups).counts) counted += count;
        EXPECT_GE(counted, 0.98 * 20000);
        if (each->scale() == Distribution::Scale::linear) {
            EXPECT_EQ(counted, 20000);
        }
    }
}

TEST(MeshQuality, OfKnownCells) {
    const test::TemporaryFolder folder;
    Soup corner = test::tetrahedron();
    std::ofstream(folder.file("corner.mesh")) << test::to_medit(corner, {{0, 1, 2, 3}});
    const MeasurableMesh mesh(folder.file("corner.mesh"));
    EXPECT_DOUBLE_EQ(mesh.diagonal(), std::sqrt(3.0));
    const MeshQuality quality = mesh.measure(mesh.diagonal());
    EXPECT_EQ(quality.tets(), 1);
    EXPECT_EQ(quality.vertices, 4);
    EXPECT_EQ(quality.cells.interface.measures[0].count(), 0);
    EXPECT_NEAR(quality.cells.all.measures[0].min(), std::acos(std::sqrt(1.0 / 3)) * 180 / std::numbers::pi, 1e-12);
    EXPECT_NEAR(quality.cells.all.measures[1].max(), 90, 1e-12);
    EXPECT_NEAR(quality.cells.all.measures[5].max(), 1.0 / 6, 1e-15);
    EXPECT_EQ(quality.boundary.measures[0].count(), 4);
    EXPECT_NEAR(quality.boundary.measures[0].min(), 45, 1e-12);
    EXPECT_NEAR(quality.boundary.measures[1].max(), 90, 1e-12);
    EXPECT_NEAR(quality.boundary.measures[0].max(), 60, 1e-12);
    EXPECT_EQ(quality.cells.angles.forced.count(), 0);
    EXPECT_EQ(quality.cells.angles.unforced.min(), quality.cells.all.measures[0].min());
}

// Of triangles in the file, and of the hull where there are none.
TEST(MeshQuality, TellsWhichCellsAreForced) {
    const test::TemporaryFolder folder;
    Soup flat = test::tetrahedron();
    for (Vec3& p : flat.vertices) p.z() *= 0.1;
    std::ofstream(folder.file("flat.mesh")) << test::to_medit(flat, {{0, 1, 2, 3}});
    std::ofstream(folder.file("flat.node")) << test::to_node_list(flat, 0);
    std::ofstream(folder.file("flat.ele")) << test::to_element_list({{0, 1, 2, 3}}, 0);
    for (const char* name : {"flat.mesh", "flat.node"}) {
        const MeshQuality quality = MeasurableMesh(folder.file(name)).measure(2);
        EXPECT_EQ(quality.cells.angles.forced.count(), 1);
        EXPECT_EQ(quality.cells.angles.forced.min(), quality.cells.all.measures[0].min());
        EXPECT_EQ(quality.cells.angles.unforced.count(), 0);
    }
}

// TetGen's files have no triangles, so that the boundary is found.
TEST(MeshQuality, OfAFileWithoutTrianglesHasThoseOfItsHull) {
    const test::TemporaryFolder folder;
    Soup cube = test::box(Vec3::Zero(), Vec3::Ones(), 3);
    std::vector<Tetrahedron> tets;
    const auto top = static_cast<std::int32_t>(cube.vertices.size());
    for (const auto& [a, b, c] : cube.facets) tets.push_back({top, a, b, c});
    cube.vertices.emplace_back(0.5, 0.5, 0.5);
    std::ofstream(folder.file("cube.node")) << test::to_node_list(cube, 0);
    std::ofstream(folder.file("cube.ele")) << test::to_element_list(tets, 0);
    std::ofstream(folder.file("cube.mesh")) << test::to_medit(cube, tets);
    const MeshQuality hull = MeasurableMesh(folder.file("cube.node")).measure(2),
                      listed = MeasurableMesh(folder.file("cube.mesh")).measure(2);
    EXPECT_EQ(hull.boundary.measures[0].count(), static_cast<std::int64_t>(cube.facets.size()));
    for (std::size_t i = 0; i < triangle_measures.size(); ++i) {
        EXPECT_EQ(hull.boundary.measures[i].count(), listed.boundary.measures[i].count());
        EXPECT_NEAR(hull.boundary.measures[i].max(), listed.boundary.measures[i].max(), 1e-12);
    }
    EXPECT_NEAR(hull.boundary.measures[0].min(), 45, 1e-9);
}

TEST(ComparedQuality, HasOneLengthScaleAndTheLimitsOfTheFirst) {
    const test::TemporaryFolder folder;
    std::ofstream(folder.file("small.mesh")) << test::to_medit(test::tetrahedron(), {{0, 1, 2, 3}});
    Soup twice = test::tetrahedron();
    for (Vec3& p : twice.vertices) p *= 2;
    std::ofstream(folder.file("large.mesh")) << test::to_medit(twice, {{0, 1, 2, 3}});
    const ComparedQuality both = compare_quality(folder.file("small.mesh"), folder.file("large.mesh"));
    EXPECT_EQ(to_text(both, QualityDetail::brief), comparison_text(both.mesh, *both.other, QualityDetail::brief));
    EXPECT_EQ(to_picture(both), comparison_sheet(both.mesh, *both.other));
    const auto missed = QualityGate::parse("volume=1", "max-edge=2").missed_by(both.mesh);
    ASSERT_EQ(missed.size(), 1U);
    const auto json = nlohmann::json::parse(to_json(both, missed));
    EXPECT_EQ(json["missed_limits"][0], missed[0]);
    EXPECT_EQ(json["compared_with"]["tets"], json["tets"]);
    EXPECT_EQ(json["forced"]["tets"], 0);
    EXPECT_EQ(json["forced"]["others_min_dihedral_deg"], json["quality"]["all"]["min_dihedral_deg"]);
    EXPECT_EQ(json["forced"]["min_dihedral_deg"]["histogram"]["counts"].size(), 36U);
    EXPECT_FALSE(compare_quality(folder.file("small.mesh")).other);
}

TEST(QualityGate, ComparesTheWorstWithItsLimit) {
    const MeshQuality quality = quality_of_random_cells(8, 100);
    for (const auto& [end, list] :
         {std::pair(BadEnd::small, limit_names(BadEnd::small)), {BadEnd::large, limit_names(BadEnd::large)}}) {
        const std::regex name("[a-z-]+");
        for (std::sregex_iterator each(list.begin(), list.end(), name), none; each != none; ++each) {
            SCOPED_TRACE(each->str());
            const bool is_small = end == BadEnd::small;
            const auto missed = [&, end = end](const std::string& limit) {
                return missed_limits(quality, parse_limits(each->str() + "=" + limit, end), end).size();
            };
            EXPECT_EQ(missed(is_small ? "-1e300" : "1e300"), 0U);
            EXPECT_EQ(missed(is_small ? "1e300" : "-1e300"), 1U);
        }
    }
    const double smallest = quality.cells.all.measures[0].min();
    EXPECT_TRUE(missed_limits(quality, {{"min-dihedral", smallest}}, BadEnd::small).empty());
    const auto missed = missed_limits(quality, {{"min-dihedral", std::nextafter(smallest, 180)}}, BadEnd::small);
    ASSERT_EQ(missed.size(), 1U);
    EXPECT_NE(missed.front().find("smallest dihedral angle"), std::string::npos) << missed.front();
}

TEST(QualityGate, MayLeaveOutWhatTheSurfaceForces) {
    MeshQuality quality = quality_of_random_cells(8, 100);
    quality.cells.all.add(tet_quality(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0.3, 0.3, 1e-9)));
    quality.cells.angles.forced.add(quality.cells.all.measures[0].min());
    const double smallest = quality.cells.angles.unforced.min();
    EXPECT_GT(smallest, quality.cells.all.measures[0].min());
    EXPECT_EQ(missed_limits(quality, {{"min-dihedral", smallest}}, BadEnd::small).size(), 1U);
    EXPECT_TRUE(missed_limits(quality, {{"unforced-dihedral", smallest}}, BadEnd::small).empty());
}

TEST(QualityGate, RefusesWhatIsNoLimit) {
    EXPECT_EQ(limit_names(BadEnd::small), "min-dihedral, shape, volume, min-edge, unforced-dihedral, min-angle");
    EXPECT_EQ(limit_names(BadEnd::large), "max-dihedral, radius-edge, aspect, max-edge, max-angle");
    EXPECT_TRUE(parse_limits("", BadEnd::small).empty());
    EXPECT_EQ(parse_limits("min-dihedral=5,shape=1e-2", BadEnd::small).size(), 2U);
    const auto expect_refused = [](const char* list, const char* words) {
        try {
            parse_limits(list, BadEnd::small);
            ADD_FAILURE() << list;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::usage);
            EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
        }
    };
    expect_refused("max-dihedral=170", "--fail-above");
    expect_refused("dihedral=5", "min-dihedral, shape");
    for (const char* list : {"min-dihedral", "min-dihedral=", "min-dihedral=five", "min-dihedral=5 deg",
                             "min-dihedral=nan", "min-dihedral=inf", "shape=1,min-dihedral="})
        expect_refused(list, "needs a number");
    expect_refused(",", "is no measure");
}

// Every element that begins ends, and nothing is no number.
void expect_good_svg(const std::string& svg) {
    std::vector<std::string> open;
    const std::regex tag("<(/?)([a-z]+)[^<>]*?(/?)>");
    for (std::sregex_iterator each(svg.begin(), svg.end(), tag), none; each != none; ++each) {
        if ((*each)[1].length() > 0) {
            ASSERT_FALSE(open.empty());
            EXPECT_EQ(open.back(), (*each)[2].str());
            open.pop_back();
        } else if ((*each)[3].length() == 0) {
            open.push_back((*each)[2].str());
        }
    }
    EXPECT_TRUE(open.empty());
    for (const char* word : {"nan", "-inf", "\"inf"}) EXPECT_EQ(svg.find(word), svg.npos) << word;
}

std::size_t count_of(const std::string& text, const std::string& words) {
    std::size_t count = 0;
    for (std::size_t at = text.find(words); at != text.npos; at = text.find(words, at + 1)) ++count;
    return count;
}

TEST(QualitySheet, HasAPanelForEveryMeasureAndACurveForEveryKind) {
    MeshQuality first = quality_of_random_cells(1, 3000), second = quality_of_random_cells(2, 500);
    first.name = "a <b> & \"c\"";
    const std::string sheet = quality_sheet(first), compared = comparison_sheet(first, second);
    for (const std::string& svg : {sheet, compared}) {
        expect_good_svg(svg);
        EXPECT_NE(svg.find("a &lt;b&gt; &amp;"), svg.npos);
        EXPECT_EQ(count_of(svg, "font-weight='bold'"), 1 + quality_measures.size() + triangle_measures.size());
    }
    EXPECT_EQ(count_of(sheet, "<tspan"), 3 * quality_measures.size() + triangle_measures.size());
    EXPECT_EQ(count_of(compared, "<tspan"), 2 * (quality_measures.size() + triangle_measures.size()));
    EXPECT_EQ(sheet, quality_sheet(first));
    EXPECT_THROW(comparison_sheet(first, quality_of_random_cells(2, 5, 3)), Error);
}

TEST(QualitySheet, HoldsCellsThatAreAllAlikeOrFlat) {
    MeshQuality quality = quality_of_random_cells(1, 0);
    quality.cells.all.add(tet_quality(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)));
    expect_good_svg(quality_sheet(quality));
    EXPECT_NE(quality_text(quality).find("All cells: 1 (100.00 %)"), std::string::npos) << quality_text(quality);
    for (int i = 0; i < 3; ++i)
        quality.cells.all.add(tet_quality(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)));
    expect_good_svg(quality_sheet(quality));
}

// The counts of the histogram of a measure, read from the text.
std::int64_t cells_in_histogram(const std::string& text, const std::string& title) {
    const std::size_t begin = text.find("\n\n" + title + "\n");
    EXPECT_NE(begin, text.npos) << title;
    const std::size_t end = text.find("\n\n", begin + 2);
    const std::string block = text.substr(begin, end - begin);
    static const std::regex count("- +[^ ]+ +([0-9,]+) +[0-9.]+ %");
    std::int64_t sum = 0;
    for (std::sregex_iterator each(block.begin(), block.end(), count), none; each != none; ++each) {
        std::string digits = (*each)[1];
        std::erase(digits, ',');
        sum += std::stoll(digits);
    }
    return sum;
}

TEST(QualityText, CountsEveryCellInEveryHistogram) {
    const MeshQuality quality = quality_of_random_cells(4, 12345);
    const std::string text = quality_text(quality);
    for (const Measure& measure : quality_measures)
        EXPECT_EQ(
            cells_in_histogram(text, *measure.unit ? std::string(measure.title) + ", " + measure.unit : measure.title),
            12345)
            << measure.title;
    EXPECT_NE(text.find("Cells with a vertex on an interface: 3,087 (25.01 %)"), text.npos) << text;
    EXPECT_NE(text.find("Other cells: 9,258 (74.99 %)"), text.npos);
}

TEST(QualityText, TellsForcedCellsApart) {
    MeshQuality quality = quality_of_random_cells(4, 12345);
    const std::string title = "smallest dihedral angle not forced, deg";
    for (const QualityDetail detail : {QualityDetail::brief, QualityDetail::all}) {
        const std::string text = quality_text(quality, detail);
        EXPECT_NE(text.find("\nForced by the surface: 2,469 cells (20.00 %)"), text.npos) << text;
        EXPECT_EQ(count_of(text, title), 1U);
    }
    const std::string beside = comparison_text(quality, quality_of_random_cells(9, 2000), QualityDetail::brief);
    EXPECT_EQ(count_of(beside, title + ": A"), 1U) << beside;
    quality.cells.angles = {};
    EXPECT_NE(quality_text(quality).find("\nForced by the surface: 0 cells (0.00 %)\n"), std::string::npos);
    EXPECT_EQ(count_of(quality_text(quality), title), 0U);
    EXPECT_EQ(count_of(comparison_text(quality, quality), title), 0U);
}

TEST(QualityText, ComparesUpToTheLastCell) {
    const MeshQuality first = quality_of_random_cells(4, 1000), second = quality_of_random_cells(9, 2000);
    const std::string text = comparison_text(first, second);
    EXPECT_EQ(count_of(text, "100.00 %    100.00 %\n"), quality_measures.size() + triangle_measures.size()) << text;
    EXPECT_THROW(comparison_text(first, quality_of_random_cells(2, 5, 3)), Error);
}

}  // namespace
}  // namespace kerf

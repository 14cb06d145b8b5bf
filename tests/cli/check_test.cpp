// kerf check as a user sees it, and the repairs that are asked for: what check calls clean with them is meshed with
// them.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "files/io/surface_reader.h"
#include "support/assets.h"
#include "support/damage.h"
#include "support/file_contents.h"
#include "support/program.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"
#include "support/write_off.h"

namespace kerf {
namespace {

using Json = nlohmann::json;
using test::join;

class Check : public testing::Test {
 protected:
    std::string write(const Soup& soup) const {
        const std::string path = folder_.file("surface.off");
        test::write_off(path, soup.vertices, soup.facets);
        return path;
    }
    static ChildResult check(const std::string& path, std::vector<std::string> more = {}) {
        more.insert(more.begin(), {"check", path});
        return test::run_kerf(more);
    }
    static Json check_json(const std::string& path, std::vector<std::string> more = {}) {
        more.push_back("--json");
        return Json::parse(test::output_of(check(path, more)));
    }
    // Refused as it is, with the options checked to be clean, meshed and verified. Gives the report of the run.
    Json expect_mended(const Soup& soup, const std::vector<std::string>& options) const {
        const std::string path = write(soup), out = folder_.file("out");
        EXPECT_EQ(check(path).exit_code, 3);
        const ChildResult checked = check(path, options);
        EXPECT_EQ(checked.exit_code, 0) << test::output_of(checked);
        std::vector<std::string> arguments = {"mesh", path, "-o", out, "-n", "2", "-q"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const ChildResult meshed = test::run_kerf(arguments);
        EXPECT_EQ(meshed.exit_code, 0) << meshed.log;
        EXPECT_EQ(test::run_kerf({"verify", out}).exit_code, 0);
        return Json::parse(test::bytes_of_file(out + "/report.json"));
    }

    test::TemporaryFolder folder_;
};

Soup hollow_box() { return read_surface(test::asset_path("hollow_box")); }

Soup without_fan(Soup soup, std::int32_t vertex) {
    const std::vector<std::int32_t> fan = test::facets_with(soup, {vertex});
    for (auto f = fan.rbegin(); f != fan.rend(); ++f) test::remove_facet(soup, *f);
    return soup;
}

TEST_F(Check, CleanSurfacesEndWithZeroAndSayThatTheyCanBeMeshed) {
    const ChildResult result = check(test::asset_path("cube"));
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_NE(test::output_of(result).find("4660 facets"), std::string::npos) << test::output_of(result);
    EXPECT_NE(test::output_of(result).find("It can be meshed."), std::string::npos) << test::output_of(result);
}

TEST_F(Check, SeveralFilesAreARegionEachAndSoIsARun) {
    const auto box = [&](const char* name, double low, double high) {
        const Soup soup = test::box(Vec3(low, 0, 0), Vec3(high, 1, 1), 3);
        test::write_off(folder_.file(name), soup.vertices, soup.facets);
        return folder_.file(name);
    };
    const std::string bone = box("bone.off", 0, 1), cement = box("cement.off", 1, 3), out = folder_.file("out");
    const std::string text = test::output_of(check(bone, {cement}));
    EXPECT_NE(text.find("region    bone: volume 1, 1 shell, outside 5, wall to cement 1"), text.npos) << text;
    EXPECT_EQ(check_json(bone, {"--with", cement})["regions"][1]["name"], "cement");
    const std::string list = test::output_of(check(bone, {cement, "--list-regions"}));
    EXPECT_NE(list.find("           2      1            9  cement\n"), list.npos) << list;
    EXPECT_NE(list.find("           1  bone  cement\n"), list.npos) << list;
    EXPECT_NE(test::output_of(check(bone, {"--list-regions"})).find("one region"), std::string::npos);
    const std::string patches = test::output_of(check(bone, {cement, "--list-patches"}));
    for (const char* patch : {"  bone_outer\n", "  bone_to_cement\n", "  cement_outer\n"})
        EXPECT_NE(patches.find(patch), patches.npos) << patches;
    const ChildResult meshed = test::run_kerf({"mesh", bone, cement, "-o", out, "-n", "2", "--surface", "split", "-q"});
    EXPECT_EQ(meshed.exit_code, 0) << meshed.log;
    const Json report = Json::parse(test::bytes_of_file(out + "/report.json"));
    EXPECT_EQ(report["input"]["regions"].size(), 2U);
    EXPECT_EQ(report["options"]["with"], Json::array({cement}));
    const ChildResult verified = test::run_kerf({"verify", out});
    EXPECT_EQ(verified.exit_code, 0) << test::output_of(verified);
    const ChildResult twice = test::run_kerf({"mesh", bone, bone, "-o", out});
    EXPECT_EQ(twice.exit_code, 2);
    EXPECT_NE(twice.log.find("bone.off is given twice"), std::string::npos) << twice.log;
}

// A body in a box of air is no body of its own, as a rule: the flow around it is wanted.
TEST_F(Check, ABoxAroundOthersMayLeaveThemEmpty) {
    const auto box = [&](const char* name, double low, double high) {
        const Soup soup = test::box(Vec3::Constant(low), Vec3::Constant(high), 2);
        test::write_off(folder_.file(name), soup.vertices, soup.facets);
        return folder_.file(name);
    };
    const std::string tunnel = box("tunnel.off", 0, 10), car = box("car.off", 4, 6), other = box("other.off", 20, 21);
    const std::string text = test::output_of(check(tunnel, {car}));
    EXPECT_NE(text.find("tunnel is a box around the others: --hole car leaves them empty"), text.npos) << text;
    const std::string apart = test::output_of(check(car, {other}));
    EXPECT_EQ(apart.find("--hole"), apart.npos) << apart;
}

TEST_F(Check, CapsComeFirstWhereEndsAreOpen) {
    Soup tube = test::box(Vec3::Zero(), Vec3(4, 1, 1), 10);
    for (std::int32_t f = static_cast<std::int32_t>(tube.facets.size()) - 1; f >= 0; --f) {
        const auto& [a, b, c] = tube.facets[f];
        const Vec3 middle = (tube.vertices[a] + tube.vertices[b] + tube.vertices[c]) / 3;
        if (middle.x() < 1e-6 || middle.x() > 4 - 1e-6) test::remove_facet(tube, f);
    }
    const std::string text = test::output_of(check(write(tube)));
    EXPECT_NE(text.find("2 open edge loops; --cap closes the 2 large ones by patches of their own"), text.npos) << text;
}

TEST_F(Check, BodiesThatDoNotFitAreToldByBothNamesAndAPlace) {
    const auto box = [&](const char* name, double low, double high, int n) {
        const Soup soup = test::box(Vec3(low, 0, 0), Vec3(high, 1, 1), n);
        test::write_off(folder_.file(name), soup.vertices, soup.facets);
        return folder_.file(name);
    };
    const std::string bone = box("bone.off", 0, 1, 2);
    const std::map<std::string, std::string> cements = {{"gap between bodies", box("gap.off", 1 + 1e-5, 2, 2)},
                                                        {"overlap of bodies", box("over.off", 0.9, 2, 2)},
                                                        {"wall of unlike facets", box("other.off", 1, 2, 3)}};
    for (const auto& [kind, cement] : cements) {
        const ChildResult result = check(bone, {cement});
        EXPECT_EQ(result.exit_code, 3);
        const std::string text = test::output_of(result), name = std::filesystem::path(cement).stem();
        for (const std::string& part : {"1 " + kind, "'bone' and '" + name + "'", std::string(" near (")})
            EXPECT_NE(text.find(part), text.npos) << text;
        const Json defects = check_json(bone, {"--with", cement})["defects"];
        ASSERT_EQ(defects.size(), 1U) << defects;
        EXPECT_EQ(defects[0]["kind"], kind);
        EXPECT_EQ(defects[0]["regions"], Json::array({"bone", name}));
        EXPECT_GE(defects[0]["distance"], 0);
        EXPECT_EQ(defects[0]["where"].size(), 3U);
        EXPECT_GE(defects[0]["facets"].size(), 2U);
    }
}

TEST_F(Check, TextIsShortHoweverManyDefectsThereAre) {
    const Soup sphere = test::icosphere(2);
    const ChildResult result = check(write(join(sphere, test::translated(sphere, Vec3(0.01, 0.02, 0.03)))));
    EXPECT_EQ(result.exit_code, 3);
    const std::string text = test::output_of(result);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2 + 12 + 2 + 2)
        << text;  // measures, defects, verdict, repair
    const Json json = check_json(folder_.file("surface.off"));
    EXPECT_NE(text.find(fmt::format("and {} more\n", json["defects"].size() - 10)), std::string::npos) << text;
    EXPECT_NE(text.find("It cannot be meshed as it is."), std::string::npos) << text;
    EXPECT_NE(text.find("--json"), std::string::npos) << text;
}

// Of a facet that is there twice one stays; but at the rim of a hole neither may belong there.
TEST_F(Check, TextGroupsDefectsOfAKindBySeverity) {
    const Soup whole = test::icosphere(3);
    Soup soup = whole;
    soup.facets.clear();
    for (std::size_t f = 0; f < whole.facets.size(); ++f) {
        const bool is_hole = f % 40 == 20;
        for (int copy = 0; copy < (is_hole ? 0 : f % 4 ? 2 : 1); ++copy) soup.facets.push_back(whole.facets[f]);
    }
    const std::string path = write(soup);
    std::map<std::string, int> of_severity;
    const Json json = check_json(path);
    for (const Json& defect : json["defects"])
        if (defect["kind"] == "duplicate facet") ++of_severity[defect["severity"]];
    ASSERT_GT(of_severity["repaired"], 10);
    ASSERT_GT(of_severity["error"], 10);
    const std::string text = test::output_of(check(path));
    for (const auto& [severity, defects] : of_severity)
        EXPECT_NE(text.find(fmt::format("  {:<9} {} duplicate facets; ", severity, defects)), std::string::npos)
            << text;
    std::size_t groups = 0;
    for (std::size_t at = text.find("duplicate facets"); at != text.npos; at = text.find("duplicate facets", at + 1))
        ++groups;
    EXPECT_EQ(groups, 2u) << text;
}

TEST_F(Check, TextNamesTheWorst) {
    const std::string cube = test::asset_path("cube");
    const std::vector<std::string> angle = {"--needle-angle", "44.5"};
    double worst = 60;
    const Json json = check_json(cube, angle);
    for (const Json& defect : json["defects"]) worst = std::min(worst, defect["angle_deg"].get<double>());
    const std::string text = test::output_of(check(cube, angle));
    const std::size_t first = text.find(" deg\n");
    ASSERT_NE(first, std::string::npos) << text;
    EXPECT_EQ(text.substr(text.rfind(' ', first - 1) + 1, first - text.rfind(' ', first - 1) - 1),
              fmt::format("{:.3g}", worst));
}

TEST_F(Check, JsonHasAMemberForEverything) {
    Soup soup = test::icosphere(2);
    test::remove_facet(soup, 40);
    const std::string path = write(soup);
    EXPECT_EQ(check(path, {"--json"}).exit_code, 3);
    const Json json = check_json(path, {"--needle-angle", "60"});
    EXPECT_EQ(json["path"], path);
    EXPECT_EQ(json["can_be_meshed"], false);
    EXPECT_EQ(json["vertices"], 162);
    EXPECT_EQ(json["faces"], 319);
    EXPECT_EQ(json["patches"], Json::array({"surface"}));
    EXPECT_EQ(json["notes"], Json::array());
    for (const char* repair : {"vertices_welded", "vertices_unused", "facets_dropped", "vertices_merged",
                               "facets_removed", "holes_filled", "facets_added"})
        EXPECT_EQ(json["repairs"][repair], 0) << repair;
    EXPECT_EQ(json["counts"]["open edge loop"], 1);
    EXPECT_EQ(json["counts"]["needle"], json["defects"].size() - 1);
    const Json &loop = json["defects"].front(), &needle = json["defects"].back();
    EXPECT_EQ(loop["kind"], "open edge loop");
    EXPECT_EQ(loop["severity"], "error");
    EXPECT_EQ(loop["facets"].size(), 3u);
    EXPECT_EQ(loop["vertices"].size(), 3u);
    EXPECT_EQ(loop["where"].size(), 3u);
    EXPECT_GT(loop["length"].get<double>(), 0);
    EXPECT_NE(loop["what_to_do"], "");
    EXPECT_EQ(needle["severity"], "warning");
    EXPECT_LT(needle["angle_deg"].get<double>(), 60);
}

TEST_F(Check, JsonOfAFileThatCannotBeReadHasTheMessage) {
    const std::string path = folder_.file("bad.obj");
    std::ofstream(path) << "v 0 0 0\nv 1 0 zero\n";
    EXPECT_EQ(check(path).exit_code, 3);
    const Json json = check_json(path);
    EXPECT_EQ(json["can_be_meshed"], false);
    EXPECT_EQ(json["defects"][0]["kind"], "unreadable");
    EXPECT_NE(json["defects"][0]["message"].get<std::string>().find("line 2"), std::string::npos);
    EXPECT_EQ(check(folder_.file("none.stl"), {"--json"}).exit_code, 7);
}

TEST_F(Check, JsonOfCoordinatesThatAreNoNumbersIsJson) {
    Soup soup = test::box();
    soup.vertices[2].x() = std::nan("");
    const Json json = check_json(write(soup));
    EXPECT_EQ(json["defects"][0]["kind"], "non-finite vertex");
    EXPECT_EQ(json["defects"][0]["vertices"], Json::array({2}));
}

// The numbers of an array of the file.
std::vector<int> array_of(const std::string& xml, const std::string& name) {
    std::smatch found;
    if (!std::regex_search(xml, found, std::regex("Name=\"" + name + "\"[^>]*>([^<]*)<"))) return {-999};
    std::istringstream text(found[1]);
    return {std::istream_iterator<int>(text), {}};
}

TEST_F(Check, OffendersAreTheFacetsTheEdgesAndThePlaces) {
    Soup soup = test::icosphere(1);
    test::remove_facet(soup, 40);
    soup = join(soup, join(test::box(Vec3(5, 0, 0), Vec3(6, 1, 1)), test::box(Vec3(6, 1, 0), Vec3(7, 2, 1))));
    weld_exactly(soup);  // the boxes share an edge
    const std::string file = folder_.file("offenders.vtu");
    EXPECT_EQ(check(write(soup), {"--offenders", file}).exit_code, 3);
    const std::string xml = test::bytes_of_file(file);
    const std::vector<int> types = array_of(xml, "types");
    const auto count = [&](int type) { return std::count(types.begin(), types.end(), type); };
    constexpr int point = 1, line = 4, triangle = 5;
    EXPECT_EQ(count(triangle), 3 + 4);
    EXPECT_EQ(count(line), 2);
    EXPECT_EQ(count(point), 2);
    EXPECT_NE(xml.find("NumberOfCells=\"11\""), std::string::npos);
    for (const char* name : {"Kind", "Severity", "Defect", "Facet", "offsets"})
        EXPECT_EQ(array_of(xml, name).size(), types.size()) << name;
    EXPECT_EQ(array_of(xml, "offsets").back(), static_cast<int>(array_of(xml, "connectivity").size()));
    EXPECT_EQ(array_of(xml, "connectivity").size(), 7u * 3 + 4 + 2 + 2) << "the loop is closed";
    const std::vector<int> kinds = array_of(xml, "Kind");
    EXPECT_EQ(std::count(kinds.begin(), kinds.end(), static_cast<int>(DefectKind::open_edge)), 5);
    EXPECT_EQ(std::count(kinds.begin(), kinds.end(), static_cast<int>(DefectKind::non_manifold_edge)), 6);
}

TEST_F(Check, OffendersOfACleanSurfaceAreNone) {
    const std::string file = folder_.file("offenders.vtu");
    EXPECT_EQ(check(test::asset_path("cube"), {"--offenders", file}).exit_code, 0);
    EXPECT_NE(test::bytes_of_file(file).find("NumberOfCells=\"0\""), std::string::npos);
    EXPECT_EQ(check(test::asset_path("cube"), {"--offenders", folder_.file("no/such.vtu")}).exit_code, 7);
}

TEST_F(Check, NeedleAngleIsTheUsersChoice) {
    const std::string cube = test::asset_path("cube");  // its smallest angle is 43.9 degrees
    EXPECT_EQ(check_json(cube, {"--needle-angle", "43.5"})["counts"], Json::object());
    const Json json = check_json(cube, {"--needle-angle", "44.5"});
    EXPECT_GT(json["counts"]["needle"].get<double>(), 0);
    EXPECT_EQ(json["can_be_meshed"], true);
}

TEST_F(Check, OptionsOutOfRangeAreRefused) {
    for (const char* option : {"--weld", "--fill-holes", "--feature-angle"}) {
        const ChildResult result = check(test::asset_path("cube"), {option, "-1"});
        EXPECT_EQ(result.exit_code, 2) << option;
        EXPECT_NE(result.log.find(option), std::string::npos) << result.log;
    }
    EXPECT_EQ(check(test::asset_path("cube"), {"--voids", "odd"}).exit_code, 2);
    for (const char* angle : {"-1", "61", "nan"})
        EXPECT_EQ(check(test::asset_path("cube"), {"--needle-angle", angle}).exit_code, 2) << angle;
}

TEST_F(Check, ScaleMultipliesTheCoordinatesWhereverTheyAreRead) {
    Soup open = test::box();
    test::remove_facet(open, 0);
    const double length = check_json(write(open))["defects"][0]["length"];
    EXPECT_NEAR(check_json(write(open), {"--scale", "0.001"})["defects"][0]["length"], length / 1000, 1e-12);
    const std::string cube = test::asset_path("cube"), out = folder_.file("out"), better = folder_.file("better.obj");
    const ChildResult meshed = test::run_kerf({"mesh", cube, "-o", out, "-n", "2", "-q", "--scale", "0.001"});
    EXPECT_EQ(meshed.exit_code, 0) << meshed.log;
    const Json report = Json::parse(test::bytes_of_file(out + "/report.json"));
    EXPECT_EQ(report["options"]["scale"], 0.001);
    EXPECT_NEAR(report["input"]["volume"], 1e-9, 1e-15);
    const ChildResult verified = test::run_kerf({"verify", out});
    EXPECT_EQ(verified.exit_code, 0);
    EXPECT_EQ(test::output_of(verified).find("not compared"), std::string::npos) << test::output_of(verified);
    EXPECT_EQ(test::run_kerf({"remesh", cube, "-o", better, "-q", "--scale", "0.5"}).exit_code, 0);
    for (const Vec3& p : read_surface(better).vertices) EXPECT_LE(p.maxCoeff(), 0.5 + 1e-6);
}

TEST_F(Check, OnlyBadFacetsAreRemeshedIfThatIsAskedFor) {
    const std::string bracket = test::asset_path("l_bracket"), better = folder_.file("better.obj");
    const Soup given = read_surface(bracket);
    const auto facets_of = [&](std::vector<std::string> options) {
        options.insert(options.begin(), {"remesh", bracket, "-o", better});
        const ChildResult remeshed = test::run_kerf(options);
        EXPECT_EQ(remeshed.exit_code, 0) << remeshed.log;
        EXPECT_EQ(remeshed.log.find("as they were") != std::string::npos, options.size() > 4) << remeshed.log;
        return read_surface(better).facets.size();
    };
    EXPECT_NE(facets_of({}), given.facets.size());
    EXPECT_EQ(facets_of({"--only-bad"}), given.facets.size());
}

TEST_F(Check, WeldMendsCracks) {
    const Soup whole = hollow_box();
    const Json input = expect_mended(test::cracked(whole, 5e-10, 1), {"--weld", "1e-6"})["input"];
    EXPECT_EQ(input["vertices"], whole.vertices.size());
    EXPECT_EQ(input["repairs"]["vertices_merged"], 3 * whole.facets.size() - whole.vertices.size());
    EXPECT_NEAR(input["volume"], 22, 1e-6);
}

TEST_F(Check, FillHolesClosesTheSurface) {
    const Soup whole = hollow_box();
    Soup open = without_fan(whole, whole.facets[0][0]);
    drop_unused_vertices(open);
    const Json input = expect_mended(open, {"--fill-holes", "20"})["input"];
    EXPECT_EQ(input["repairs"]["holes_filled"], 1);
    EXPECT_EQ(input["repairs"]["facets_added"].get<std::size_t>(), whole.facets.size() - 2 - open.facets.size());
    EXPECT_NEAR(input["volume"], 22, 0.1);
    EXPECT_EQ(check(write(open), {"--fill-holes", "2"}).exit_code, 3);
}

TEST_F(Check, AVolumeIsThatOfTheRepairedSurfaceWhicheverOptionRepairs) {
    const Soup whole = hollow_box();
    Soup open = without_fan(whole, whole.facets[0][0]);
    drop_unused_vertices(open);
    const std::string told =
        test::run_kerf({"mesh", write(open), "--fill-holes", "20", "-n", "1", "-o", folder_.file("run")}).log;
    EXPECT_NE(told.find("the repaired surface has"), told.npos) << told;
}

TEST_F(Check, KeepLargestDropsTheRest) {
    Soup aside = test::icosphere(1, 0.1, Vec3(50, 0, 0));
    test::remove_facet(aside, 0);
    const Json input = expect_mended(join(read_surface(test::asset_path("cube")), aside), {"--keep-largest"})["input"];
    EXPECT_EQ(input["faces"], 4660);
    EXPECT_EQ(input["repairs"]["facets_removed"], 79);
    EXPECT_NEAR(input["volume"], 1, 1e-12);
}

TEST_F(Check, ParityMakesAVoidOfASecondBody) {
    const Soup inner = test::icosphere(1, 0.2, Vec3::Constant(0.5));
    const Json input =
        expect_mended(join(read_surface(test::asset_path("cube")), inner), {"--voids", "parity"})["input"];
    EXPECT_EQ(input["components"], 2);
    EXPECT_EQ(input["repairs"]["shells_flipped"], 1);
    EXPECT_LT(input["volume"].get<double>(), 0.98);
}

}  // namespace
}  // namespace kerf

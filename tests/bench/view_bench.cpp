// How fast the viewer is without a graphics card: medians of whole frames (panels, scene, picking nothing) at 1280x800,
// the change from one step to another, and the first picture of a surface. `view_bench DIR`: of a run instead, its
// first picture, frames while it is turned, whole and cut open, and the memory that they take.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <vector>

#include <fmt/format.h>

#include "base/core/stopwatch.h"
#include "base/parallel/process_memory.h"
#include "support/assets.h"
#include "support/write_off.h"
#include "viewer/driver.h"

namespace kerf::test {
namespace {

using namespace view;

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + std::ssize(values) / 2, values.end());
    return values[values.size() / 2];
}

void report(const std::string& what, double milliseconds, double wanted) {
    fmt::print("{:<44} {:>8.0f} ms {:>8.0f} ms\n", what, milliseconds, wanted);
}

// A torus of 2 m n triangles.
void write_torus(const std::string& path, int m, int n) {
    std::vector<Vec3> vertices;
    std::vector<Triangle> facets;
    const auto number = [&](int i, int j) { return (i % m) * n + j % n; };
    for (int i = 0; i < m; ++i)
        for (int j = 0; j < n; ++j) {
            const double u = 2 * M_PI * i / m, v = 2 * M_PI * j / n, r = 3 + std::cos(v);
            vertices.emplace_back(r * std::cos(u), r * std::sin(u), std::sin(v));
            facets.push_back({number(i, j), number(i + 1, j), number(i + 1, j + 1)});
            facets.push_back({number(i, j), number(i + 1, j + 1), number(i, j + 1)});
        }
    write_off(path, vertices, facets);
}

// Milliseconds, and those of all processors, which others that use them do not change.
struct FrameTime {
    double median = 0, processors = 0;
};

// Turned by the mouse, as in the window.
FrameTime frame_time(Driver& driver, int frames) {
    std::vector<double> times;
    const Rectangle scene = driver.app().scene_area();
    const float x = scene.x + scene.width / 2, y = scene.y + scene.height / 2;
    driver.app().paint();
    driver.move_to(x, y);
    driver.press();
    driver.move_to(x + 8, y);  // the stand-in is made
    driver.app().paint();
    const std::clock_t before = std::clock();
    for (int i = 0; i < frames; ++i) {
        const Stopwatch stopwatch;
        driver.move_to(x + 8.f * static_cast<float>(i + 2), y);
        driver.app().paint();
        driver.app().renderer().finish();
        times.push_back(1000 * stopwatch.seconds());
    }
    const double processor_seconds = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
    driver.release();
    driver.settle();
    return {median(times), 1000 * processor_seconds / frames};
}

double at_rest(Driver& driver) {
    driver.settle();
    const Stopwatch stopwatch;
    driver.picture();
    return 1000 * stopwatch.seconds();
}

// Of all that the view asks for.
double first_picture(Driver& driver) {
    const Stopwatch stopwatch;
    driver.picture();
    return 1000 * stopwatch.seconds();
}

void report_turning(Driver& driver, const std::string& what) {
    report(fmt::format("{}, at rest", what), at_rest(driver), 500);
    const auto thousands = driver.app().facts().triangles / 1000;
    const FrameTime time = frame_time(driver, 15);
    report(fmt::format("{}, turned, {} k triangles", what, thousands), time.median, 1000. / 30);
    fmt::print("{:<44} {:>8.0f} ms\n", "  processor time of a frame", time.processors);
    fmt::print("{:<44} {:>8.0f} MB\n", "  memory until now", static_cast<double>(own_peak_rss_bytes()) / 1e6);
}

// The plane through the middle shows the insides of all parts that it meets.
void time_run(const std::string& folder) {
    const Stopwatch stopwatch;
    Driver driver;
    driver.open(folder);
    driver.state().step = {Stage::tetrahedra, -1};
    driver.picture();
    report("first picture of the run", 1000 * stopwatch.seconds(), 500);
    report_turning(driver, "whole");
    driver.state().clip.on = true;
    report("cut open for the first time", first_picture(driver), 500);
    report_turning(driver, "cut open");
    driver.state().clip.style = ClipStyle::smooth;
    report("cut smoothly for the first time", first_picture(driver), 500);
    report_turning(driver, "cut smoothly");
}

void time_first_picture() {
    std::vector<double> times;
    for (int i = 0; i < 5; ++i) {
        const Stopwatch stopwatch;
        Driver driver;
        driver.app().open_files({asset_path("bearing_cap_52k")});
        while (driver.drawn(LayerKind::surface).triangles == 0) {
            driver.app().wait(0.01);
            driver.frame();
        }
        times.push_back(1000 * stopwatch.seconds());
    }
    report("first picture, bearing cap, 52 k facets", median(times), 1000);
}

// The second time round everything is in memory.
void time_steps() {
    Driver::Options options;
    options.parts = 8;
    Driver driver(options);
    driver.open(asset_path("bearing_cap_52k"));
    for (const bool first : {true, false}) {
        std::vector<double> times;
        for (const Step& step : driver.app().steps()) {
            driver.state().step = step;
            const Stopwatch stopwatch;
            driver.frame();
            times.push_back(1000 * stopwatch.seconds());
            driver.settle();
        }
        report(first ? "step change, for the first time, median" : "step change, again, median", median(times), 50);
        report("                                 longest", *std::max_element(times.begin(), times.end()), 50);
    }
}

void time_frames(const std::string& folder, int m, int n, int frames, double wanted) {
    const std::string path = folder + "/torus.off";
    write_torus(path, m, n);
    Driver::Options options;
    options.auto_run = false;
    Driver driver(options);
    driver.open(path);
    report(fmt::format("frame, {} k triangles with edges", 2 * m * n / 1000), frame_time(driver, frames).median,
           wanted);
    driver.state().look.edges = false;
    driver.settle();
    report(fmt::format("frame, {} k triangles without edges", 2 * m * n / 1000), frame_time(driver, frames).median,
           wanted);
}

int run(const std::vector<std::string>& runs) {
    for (const std::string& folder : runs) time_run(folder);
    if (!runs.empty()) return 0;
    const std::string folder = std::filesystem::temp_directory_path() / fmt::format("kerf_view_bench_{}", ::getpid());
    std::filesystem::create_directories(folder);
    fmt::print("{:<44} {:>11} {:>11}\n", "1280x800, software OpenGL", "median", "wanted");
    time_first_picture();
    time_steps();
    time_frames(folder, 500, 200, 30, 60);
    time_frames(folder, 2000, 500, 10, 350);
    std::filesystem::remove_all(folder);
    return 0;
}

}  // namespace
}  // namespace kerf::test

int main(int count, char** words) { return kerf::test::run({words + 1, words + count}); }

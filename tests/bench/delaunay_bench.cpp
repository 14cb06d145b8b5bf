// Our Delaunay triangulation against CGAL's on a million points, at random and in centred cubes, exact and jittered.
//
// Each in a process of its own, in turns. User seconds, and the largest resident set, both less those of a process that
// only makes the points; medians of three runs.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <fmt/format.h>

#include "fill/delaunay/delaunay.h"

namespace kerf {

namespace {

using CgalKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalPoint = CgalKernel::Point_3;

constexpr int point_count = 1000000;

template <class Point>
std::vector<Point> random_points() {
    std::mt19937 random(1);
    const auto next = [&] { return 0x1p-32 * random(); };
    std::vector<Point> points;
    points.reserve(point_count);
    for (int i = 0; i < point_count; ++i) {
        const double x = next(), y = next(), z = next();
        points.emplace_back(x, y, z);
    }
    return points;
}

template <class Point>
std::vector<Point> centred_cubes(double jitter) {
    std::mt19937 random(1);
    const auto next = [&](double at) { return 0.37 * (at + jitter * 0x1p-32 * random()); };
    const int n = static_cast<int>(std::cbrt(point_count / 2));
    std::vector<Point> points;
    points.reserve(point_count);
    for (int i = 0; i < 2 * n * n * n; ++i) {
        const int cube = i / 2;
        const double shift = 0.5 * (i % 2);
        const double x = next(cube % n + shift), y = next(cube / n % n + shift), z = next(cube / n / n + shift);
        points.emplace_back(x, y, z);
    }
    return points;
}

struct Usage {
    double seconds = 0, bytes = 0;
};

// Of a process that calls it.
Usage usage_of(const std::function<void()>& work) {
    const pid_t child = fork();
    if (child == 0) {
        work();
        _exit(0);
    }
    rusage usage = {};
    int status = 0;
    if (child < 0 || wait4(child, &status, 0, &usage) != child || status != 0) {
        fmt::print(stderr, "delaunay_bench: a process has failed\n");
        std::exit(1);
    }
    return {static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec),
            1024.0 * static_cast<double>(usage.ru_maxrss)};
}

Usage median(std::array<Usage, 3> runs) {
    std::array<double, 3> seconds = {runs[0].seconds, runs[1].seconds, runs[2].seconds};
    std::array<double, 3> bytes = {runs[0].bytes, runs[1].bytes, runs[2].bytes};
    std::sort(seconds.begin(), seconds.end());
    std::sort(bytes.begin(), bytes.end());
    return {seconds[1], bytes[1]};
}

// make(point) makes points of the type of `point`.
template <class Make>
void compare(const std::string& name, Make make) {
    std::array<Usage, 3> points, own, cgal;
    for (std::size_t run = 0; run < points.size(); ++run) {
        points[run] = usage_of([&] { make(Vec3()); });
        own[run] = usage_of([&] { delaunay(make(Vec3())); });
        cgal[run] = usage_of([&] {
            const std::vector<CgalPoint> all = make(CgalPoint());
            const CGAL::Delaunay_triangulation_3<CgalKernel> triangulation(all.begin(), all.end());
        });
    }
    const Usage before = median(points), ours = median(own), theirs = median(cgal);
    const double own_seconds = ours.seconds - before.seconds, cgal_seconds = theirs.seconds - before.seconds;
    const double own_bytes = ours.bytes - before.bytes, cgal_bytes = theirs.bytes - before.bytes;
    fmt::print("{:22} {:6.2f} s {:6.2f} s  {:4.2f} times as fast  {:5.0f} MB {:5.0f} MB  {:.0f} % of the memory\n",
               name, own_seconds, cgal_seconds, cgal_seconds / own_seconds, 1e-6 * own_bytes, 1e-6 * cgal_bytes,
               100 * own_bytes / cgal_bytes);
    std::fflush(stdout);
}

void compare_all() {
    fmt::print("Delaunay triangulation of {} points, Kerf and CGAL\n", point_count);
    std::fflush(stdout);
    compare("random", [](auto point) { return random_points<decltype(point)>(); });
    compare("centred cubes", [](auto point) { return centred_cubes<decltype(point)>(0); });
    compare("jittered centred cubes", [](auto point) { return centred_cubes<decltype(point)>(1e-6); });
}

}  // namespace

}  // namespace kerf

int main() { kerf::compare_all(); }

// A forecast is linear: facets and cells inside, each times a number that is known of the mesher (MesherForecast in
// fill/volume/meshers.h). Two numbers of tetrahedra must be told apart. The expected one sums what each facet is
// forecast to have at it (fill/volume/tet_forecast.h), and gives time. The most that there may be takes the largest
// number a facet, most_tets(), and gives all for which there must be room: memory, K, the refusals of check_budget().
// The disk is another matter: there a run is refused only if not even the share `certain` of its forecast would fit,
// because a forecast that is too high must not forbid a run. Volumes are sized volumes: space is counted by the size
// that is wanted there, so that one number of cells a volume holds for all.
#include "run/run/inside/forecast.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "base/core/check.h"
#include "base/core/error.h"
#include "base/core/number_text.h"
#include "files/export/format.h"
#include "files/io/folder_files.h"
#include "files/io/run_folder.h"
#include "fill/volume/meshers.h"
#include "fill/volume/tet_forecast.h"
#include "surface/size/mean_edge.h"

namespace kerf {

namespace {

constexpr double bytes_of_worker = 14e6;
// The limit of a worker is one of its address space, of which libraries take a share; and a forecast may be low.
constexpr double reserved_bytes = 100e6, safety = 1.5;
constexpr double least_tets_per_part = 1000;
constexpr std::int32_t parts_per_worker = 4;  // so that the last one is short against all of them
constexpr double area_per_squared_edge =
    0.69;  // area of an interface triangle over the square of its longest wanted edge
constexpr double tets_at_interface_facet = 0.5;
constexpr double stored_bytes_per_tet = 22, file_bytes_per_tet = 70;  // bytes of the store, and of any format but vtu
constexpr double vtu_bytes_per_tet = 31, field_bytes_per_tet = 4;     // bytes of vtu, and of each field of its cells

constexpr double certain = 0.5;  // nearly every mesh is larger than this share of its forecast

const MesherForecast& known_of(const MesherOptions& mesher) { return find_mesher(mesher.name).forecast; }

// Facets of the interfaces as the bound of the volume will have them: a dry run leaves them coarse.
double expected_interface_facets(const PartReport& part) {
    return std::max<double>(part.interface_facets, part.interface_in_squared_edges / area_per_squared_edge);
}

double expected_facets(const PartReport& part) {
    return part.surface_facets - part.interface_facets + expected_interface_facets(part);
}

Forecast forecast_of(const PartReport& part, const MesherOptions& mesher) {
    return forecast(
        {expected_facets(part), part.tets_at_facets + tets_at_interface_facet * expected_interface_facets(part),
         part.sized_volume},
        mesher);
}

// The number of tetrahedra for which there must be room.
double most_tets(double facets, double volume, const MesherOptions& mesher) {
    return known_of(mesher).most_tets_per_facet * facets + tets_inside(volume, mesher);
}

// No text says that something takes 0 s.
std::string seconds_text(double seconds) {
    return seconds < 0.05 ? "less than 0.1 s" : fmt::format("{:.{}f} s", seconds, seconds < 10 ? 1 : 0);
}

}  // namespace

Forecast forecast(const BodyToFill& body, const MesherOptions& mesher) {
    KERF_CHECK(body.facets >= 0 && body.tets_at_facets >= 0 && body.volume >= 0);
    const MesherForecast& known = known_of(mesher);
    const double tets = body.tets_at_facets + tets_inside(body.volume, mesher);
    return {tets, known.seconds_per_facet * body.facets + known.seconds_per_tet * tets,
            bytes_of_worker + known.bytes_per_tet * most_tets(body.facets, body.volume, mesher)};
}

double pace_of_reading(double seconds, double facets) {
    constexpr double seconds_to_begin = 0.003, seconds_per_facet = 2e-6;
    constexpr double fastest = 0.5, slowest = 20;
    KERF_CHECK(seconds >= 0 && facets >= 0);
    return std::clamp(seconds / (seconds_to_begin + seconds_per_facet * facets), fastest, slowest);
}

std::int32_t choose_parts(const WorkerOptions& workers, const MesherOptions& mesher, double facets, double volume,
                          int ranks, std::int32_t most) {
    KERF_CHECK(ranks >= 1 && workers.count >= 1 && most >= 1);
    const double tets = most_tets(facets, volume, mesher);
    double parts = std::min<double>(parts_per_worker * ranks * workers.count, tets / least_tets_per_part);
    if (workers.memory_mb > 0) {
        const double available = workers.memory_mb * 0x1p20 - reserved_bytes;
        if (available <= 0)
            throw Error(ErrorCode::usage, fmt::format("--memory is {}, but a worker needs {:.0f} MB before it begins.",
                                                      workers.memory_mb, reserved_bytes / (1 << 20)));
        parts = std::max(parts, std::ceil(safety * known_of(mesher).bytes_per_tet * tets / available));
    }
    return static_cast<std::int32_t>(std::clamp<double>(parts, 1, most));
}

namespace {

// Bytes that parts of an interrupted run, which wait for this one, have taken of the disk already.
double bytes_waiting(const std::string& output) {
    double bytes = 0;
    for (const std::string& folder : RunFolder::folders_of(output))
        if (std::error_code ignored; std::filesystem::exists(folder + "/work/run.json", ignored))
            for (const std::string& file : list_files(folder)) {
                const std::uintmax_t size = std::filesystem::file_size(std::filesystem::path(folder) / file, ignored);
                if (!ignored) bytes += size;
            }
    return bytes;
}

// Bytes of all files that lie there at once, for a tetrahedron. Stores of parts that no format asks for again make room
// while these are written.
double disk_bytes_per_tet(const RunChoices& choices) {
    const double fields = choices.fields.count();
    double bytes = 0, stored = 0;
    for (const Format* format : choices.formats) {
        const bool is_vtu = format == &find_format("vtu");
        bytes += is_vtu ? vtu_bytes_per_tet + field_bytes_per_tet * fields : file_bytes_per_tet;
        if (!format->asks_for_one_part) stored = stored_bytes_per_tet;
    }
    return bytes + stored;
}

// The edge with which there are not more tetrahedra; 0 if none is large enough. By bisection of its ratio to that of
// the options, whose square divides the facets that follow it, and whose cube the volume's cells.
double least_size(const MesherOptions& mesher, double facets, double volume, Facets of_surface, double affordable) {
    if (mesher.size.is_empty()) return 0;
    const MesherForecast& known = known_of(mesher);
    const double inside = tets_inside(volume, mesher);
    const auto tets = [&](double ratio) {
        const double boundary = of_surface == Facets::follow_size ? facets / (ratio * ratio) : facets;
        return known.most_tets_per_facet * boundary + inside / (ratio * ratio * ratio);
    };
    double low = 1, high = 1e150;
    if (tets(high) > affordable) return 0;
    while (high > 1.01 * low) {
        const double middle = std::sqrt(low) * std::sqrt(high);
        (tets(middle) > affordable ? low : high) = middle;
    }
    return high * mean_edge_below(mesher.size.reference_volume());
}

}  // namespace

void check_budget(const RunChoices& choices, const MesherOptions& mesher, std::int32_t parts, double facets,
                  double volume, Facets of_surface) {
    KERF_CHECK(parts >= 1);
    const double tets = most_tets(facets, volume, mesher);
    const MesherForecast& known = known_of(mesher);
    const auto way_out = [&](double affordable) {
        const double size = least_size(mesher, facets, volume, of_surface, affordable);
        return size == 0 ? std::string("Use a coarser surface")
               : mesher.size.is_constant()
                   ? fmt::format("Use --size {:.2g} or larger", size / choices.request.sizes.mean_over_size())
                   : std::string("Use larger sizes");
    };
    const double enough = std::ceil(tets / known.most_tets);
    if (tets > known.most_tets * parts)
        throw Error(ErrorCode::memory,
                    fmt::format("This would make about {} tetrahedra, {} in each of {} parts, but a part can hold {}. "
                                "{}{}.",
                                short_number(tets), short_number(tets / parts), parts, short_number(known.most_tets),
                                way_out(known.most_tets * parts),
                                of_surface == Facets::are_given && enough <= facets / 4
                                    ? fmt::format(", or -n {:.0f} or more", enough)
                                    : ""));
    const RunRequest& request = choices.request;
    if (!request.volume) return;
    std::error_code error;
    std::filesystem::path folder = std::filesystem::path(RunFolder::folders_of(request.output).front()).parent_path();
    while (!std::filesystem::exists(folder, error) && folder.has_relative_path()) folder = folder.parent_path();
    const std::filesystem::space_info space = std::filesystem::space(folder, error);
    const double available = space.available + bytes_waiting(request.output);
    const bool is_known = !error && space.capacity > 0;
    const double bytes = disk_bytes_per_tet(choices);
    if (!is_known || certain * tets * bytes <= available) return;
    throw Error(
        ErrorCode::memory,
        fmt::format("This would make about {} tetrahedra, whose files take {} bytes, but {} has {} left. {}, or "
                    "another disk.",
                    short_number(tets), short_number(tets * bytes), folder.string(), short_number(available),
                    way_out(available / bytes)));
}

std::string plan_text(const std::vector<PartReport>& parts, const MesherOptions& mesher, int workers, bool every_part,
                      double pace) {
    KERF_CHECK(workers >= 1 && pace > 0);
    Forecast all, largest;
    std::string table;
    if (every_part) table = fmt::format("{:>10} {:>10} {:>12} {:>10} {:>9}\n", "part", "facets", "tets", "MB", "s");
    for (const PartReport& part : parts) {
        Forecast f = forecast_of(part, mesher);
        f.seconds *= pace;
        all.tets += f.tets;
        all.seconds += f.seconds;
        if (f.tets > largest.tets) largest = f;
        if (every_part)
            table += fmt::format("{:>10} {:>10} {:>12.0f} {:>10.0f} {:>9.1f}\n", part.id.value(),
                                 std::llround(expected_facets(part)), f.tets, f.memory_bytes / (1 << 20), f.seconds);
    }
    return fmt::format("{:<11} {} parts for {} worker{}, about {} tetrahedra in {}; the largest part {}, {:.0f} MB\n",
                       "plan", parts.size(), workers, workers == 1 ? "" : "s", short_number(all.tets),
                       seconds_text(std::max(largest.seconds, all.seconds / workers)), short_number(largest.tets),
                       largest.memory_bytes / (1 << 20)) +
           table;
}

std::string plan_text(double seconds, std::int64_t peak_rss_bytes) {
    return fmt::format("{:<11} {} to read and to cut, {:.0f} MB on the first rank\n", "before", seconds_text(seconds),
                       peak_rss_bytes / 0x1p20);
}

std::string plan_text(const FoundSize& found) { return fmt::format("{:<11} {}\n", "cells", found_size_text(found)); }

RunningForecast::RunningForecast(const std::vector<PartReport>& parts, MesherOptions mesher, int workers)
    : mesher_(std::move(mesher)), workers_(workers) {
    for (const PartReport& part : parts) {
        const Forecast f = forecast_of(part, mesher_);
        tets_ahead_ += f.tets;
        if (!part.resumed) seconds_ahead_ += f.seconds;
    }
}

void RunningForecast::add(const PartReport& part) {
    const Forecast f = forecast_of(part, mesher_);
    tets_ahead_ -= f.tets;
    if (part.result.tets > 0) {
        tets_forecast_ += f.tets;
        tets_found_ += part.result.tets;
    }
    if (part.resumed) return;
    seconds_ahead_ -= f.seconds;
    seconds_forecast_ += f.seconds;
    seconds_found_ += part.seconds;
}

double RunningForecast::tets() const {
    const double correction = tets_forecast_ > 0 ? tets_found_ / tets_forecast_ : 1;
    return tets_found_ + std::max(0.0, tets_ahead_) * correction;
}

double RunningForecast::seconds_left(double elapsed) const {
    if (seconds_forecast_ <= 0) return -1;
    const double correction = seconds_found_ / seconds_forecast_;
    return std::max(0.0, (seconds_found_ + std::max(0.0, seconds_ahead_) * correction) / workers_ - elapsed);
}

}  // namespace kerf

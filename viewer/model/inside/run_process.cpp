// The command line of a run is derived from the table of options: those that differ from the defaults are given, and
// switches become --NAME or --no-NAME. A surface without a file is written in the MEDIT format with 17 digits, by which
// doubles are read back bit for bit; the number of a patch, plus one, is the reference of its triangles. The process is
// the only child of its pool. It keeps its scratch folder alive, whose removal is tried for half a second, because
// workers of a killed run may still write into it.
#include "viewer/model/inside/run_process.h"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <thread>

#include <fmt/format.h>

#include "base/core/error.h"
#include "files/io/checked_file.h"

namespace kerf::view {

namespace fs = std::filesystem;

namespace {

constexpr int tag = 0;  // of the only child
constexpr double patience_with_runs_seconds = 5;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

ScratchFolder::ScratchFolder() {
    std::error_code error;
    path_ = (fs::temp_directory_path(error) / fmt::format("kerf-view-{}-XXXXXX", ::getpid())).string();
    if (!::mkdtemp(path_.data()))
        throw Error(ErrorCode::io,
                    fmt::format("No folder for temporary files can be made in {}: {}. Check its permissions "
                                "and free space, or set TMPDIR.",
                                fs::path(path_).parent_path().string(), std::generic_category().message(errno)));
}

// Workers of a run that was killed may need a moment to end, too.
ScratchFolder::~ScratchFolder() {
    std::error_code error;
    for (int i = 0; i < 50; ++i) {
        fs::remove_all(path_, error);
        if (!error && !fs::exists(path_, error)) return;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
}

std::vector<std::string> command_line_of(RunRequest options, bool volume) {
    std::vector<std::string> arguments = {volume ? "mesh" : "decompose", options.input, "--output=" + options.output,
                                          "--quiet"};
    RunRequest defaults;
    const std::vector<OptionField> fields = option_fields(options), default_fields = option_fields(defaults);
    for (std::size_t i = 0; i < fields.size(); ++i) {
        const std::string text = fields[i].text();
        if (text == default_fields[i].text()) continue;
        const bool is_flag = std::holds_alternative<bool*>(fields[i].value);
        const bool is_off = is_flag && text == "false";
        arguments.push_back((is_off ? "--no-" : "--") + fields[i].name + (is_flag ? "" : "=" + text));
    }
    return arguments;
}

void write_surface_of(const Trace& trace, const std::string& path) {
    CheckedFile file(path, "w");
    const SurfaceArrays& surface = trace.surface;
    std::string text = fmt::format("MeshVersionFormatted 2\nDimension 3\nVertices\n{}\n", surface.vertices.size());
    const auto flush = [&](std::size_t limit) {
        if (text.size() <= limit) return;
        file.write(text);
        text.clear();
    };
    constexpr std::size_t chunk = 1 << 20;
    for (const Vec3& p : surface.vertices) {
        fmt::format_to(std::back_inserter(text), "{:.17g} {:.17g} {:.17g} 0\n", p.x(), p.y(), p.z());
        flush(chunk);
    }
    text += fmt::format("Triangles\n{}\n", surface.facets.size());
    for (std::size_t f = 0; f < surface.facets.size(); ++f) {
        const Triangle& t = surface.facets[f];
        fmt::format_to(std::back_inserter(text), "{} {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1, surface.patch[f] + 1);
        flush(chunk);
    }
    text += "End\n";
    flush(0);
    file.close();
}

RunProcess::RunProcess(const std::string& program, const std::vector<std::string>& arguments,
                       std::shared_ptr<ScratchFolder> scratch)
    : scratch_(std::move(scratch)) {
    pool_.start(tag, program, arguments, {}, 0);
}

void RunProcess::interrupt() {
    if (interrupted_) return;
    pool_.interrupt(tag);
    interrupted_ = Clock::now();
}

bool RunProcess::is_overdue() const {
    return interrupted_ && seconds_since(*interrupted_) > patience_with_runs_seconds;
}

std::optional<ChildResult> RunProcess::wait(double seconds) {
    if (!is_running()) return std::nullopt;
    auto finished = pool_.wait_any(seconds);
    if (!finished) return std::nullopt;
    return std::move(finished->result);
}

double RunProcess::seconds() const { return seconds_since(start_); }

std::string reason_of(const ChildResult& result) {
    std::string text = result.log;
    while (!text.empty() && text.back() == '\n') text.pop_back();
    if (text.starts_with("kerf: ")) text.erase(0, 6);
    return text.empty() ? "The run " + result.describe() + "." : text;
}

}  // namespace kerf::view

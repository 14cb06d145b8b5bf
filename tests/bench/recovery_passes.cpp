#include "bench/recovery_passes.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <csignal>
#include <cstring>

#include <fmt/format.h>

#include "base/core/error.h"
#include "fill/lattice/lattice_core.h"
#include "fill/mesh/verification.h"
#include "fill/shell/shell.h"
#include "fill/volume/mesher.h"
#include "surface/complex/mass_properties.h"

namespace kerf::bench {

namespace {

constexpr rlim_t most_seconds = 10;
constexpr double radius_edge = 1.4;
constexpr double cells_of_a_body = 3000;  // where their size is wanted, about

std::string broken_laws(const MeshLaws& laws) {
    if (laws.hold()) return "";
    std::string text;
    for (const MeshLaw& law : mesh_laws)
        if (laws.*law.count > 0) text += fmt::format("{} {}, ", laws.*law.count, law.broken);
    return text + fmt::format("volume {:.17g} instead of {:.17g} (rounding {:.2g})", laws.volume, laws.surface_volume,
                              laws.volume_error);
}

Outcome filled(const SurfaceArrays& boundary, const FilledShell& shell) {
    return {broken_laws(verify_mesh(shell.mesh, boundary)),
            fmt::format("{} cells, {} facets recovered", shell.mesh.tets.size(), shell.recovery.missing)};
}

Outcome fill_raw(const SurfaceArrays& surface) { return filled(surface, fill_shell(surface, {}, {})); }

Outcome fill_shaped(const SurfaceArrays& surface) {
    return filled(surface, fill_shell(surface, {}, {SizeField(), radius_edge}));
}

double volume_bound(const SurfaceArrays& surface) {
    return enclosed_volume(surface.vertices, surface.facets) / cells_of_a_body;
}

// With the boundary of the core, turned round.
SurfaceArrays with_core(SurfaceArrays surface, const ShellCore& core) {
    const auto first = static_cast<std::int32_t>(surface.vertices.size());
    surface.vertices.insert(surface.vertices.end(), core.points.begin(), core.points.end());
    for (const auto& [a, b, c] : core.faces) surface.facets.push_back({first + a, first + c, first + b});
    for (std::size_t v = first; v < surface.vertices.size(); ++v)
        surface.vertex_key.push_back(make_key(input_node, static_cast<std::int32_t>(v)));
    for (std::size_t f = surface.facet_key.size(); f < surface.facets.size(); ++f)
        surface.facet_key.push_back(make_key(input_node, static_cast<std::int32_t>(f)));
    surface.patch.resize(surface.facets.size(), 0);
    return surface;
}

// The core is a little coarser than a run's, so that its boundary is near to the surface as often.
Outcome fill_around_core(const SurfaceArrays& surface) {
    const double bound = volume_bound(surface);
    const LatticeCore core(surface, std::cbrt(8 * bound));
    ShellCore shell_core;
    if (core.cell_count() > 0) shell_core = {core.boundary_points(), core.boundary_faces(), core.free_points()};
    Outcome outcome =
        filled(with_core(surface, shell_core), fill_shell(surface, shell_core, {SizeField(bound), radius_edge}));
    outcome.remark += fmt::format(", a core of {} cells", core.cell_count());
    return outcome;
}

Outcome mesh(const SurfaceArrays& surface) {
    MesherOptions options;
    options.name = "lattice";
    options.size = SizeField(volume_bound(surface));
    const Filling filling = mesh_volume(surface, options);
    Outcome outcome{broken_laws(verify_mesh(filling.mesh, surface)),
                    fmt::format("{} cells, {}", filling.mesh.tets.size(), filling.strategy)};
    if (filling.strategy.starts_with("TetGen")) outcome.failure = filling.strategy + ". " + outcome.failure;
    return outcome;
}

constexpr std::array<RecoveryPass, 4> passes = {
    {{"raw", fill_raw}, {"shaped", fill_shaped}, {"core", fill_around_core}, {"mesh", mesh}}};

// Two lines: the failure, and the remark.
[[noreturn]] void run_child(const RecoveryPass& pass, const SurfaceArrays& surface, int answer) {
    const rlimit seconds = {most_seconds, most_seconds + 1}, no_core = {0, 0};
    ::setrlimit(RLIMIT_CPU, &seconds);
    ::setrlimit(RLIMIT_CORE, &no_core);
    const int nowhere = ::open("/dev/null", O_WRONLY);  // TetGen talks
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
    std::string text;
    try {
        const Outcome outcome = pass.fill(surface);
        text = outcome.failure + '\n' + outcome.remark;
    } catch (const std::exception& error) {
        text = std::string(error.what()) + '\n';
    }
    const auto written = ::write(answer, text.data(), text.size());
    ::_exit(written == static_cast<ssize_t>(text.size()) ? 0 : 1);
}

std::string read_all(int descriptor) {
    std::string text;
    std::array<char, 4096> buffer;
    for (ssize_t n = 0; (n = ::read(descriptor, buffer.data(), buffer.size())) > 0;)
        text.append(buffer.data(), static_cast<std::size_t>(n));
    return text;
}

double seconds_of(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

std::span<const RecoveryPass> recovery_passes() { return passes; }

Outcome outcome_in_child(const RecoveryPass& pass, const SurfaceArrays& surface) {
    std::array<int, 2> answer = {};
    if (::pipe(answer.data()) != 0) throw Error(ErrorCode::io, "No pipe could be opened.");
    std::fflush(nullptr);
    const pid_t child = ::fork();
    if (child < 0) throw Error(ErrorCode::io, "No process could be started.");
    if (child == 0) run_child(pass, surface, answer[1]);
    ::close(answer[1]);
    const std::string text = read_all(answer[0]);
    ::close(answer[0]);
    int status = 0;
    rusage usage = {};
    ::wait4(child, &status, 0, &usage);
    Outcome outcome;
    outcome.seconds = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
    const std::size_t end = text.find('\n');
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
        outcome.failure = fmt::format("took longer than {} s", most_seconds);
    else if (WIFSIGNALED(status))
        outcome.failure = fmt::format("was ended by signal {} ({})", WTERMSIG(status), ::strsignal(WTERMSIG(status)));
    else if (WEXITSTATUS(status) != 0 || end == std::string::npos)
        outcome.failure = fmt::format("ended with exit code {}", WEXITSTATUS(status));
    else
        outcome.failure = text.substr(0, end), outcome.remark = text.substr(end + 1);
    return outcome;
}

}  // namespace kerf::bench

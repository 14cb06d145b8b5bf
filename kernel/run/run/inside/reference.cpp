#include "run/run/inside/reference.h"

#include <filesystem>

#include <fmt/format.h>

#include "base/geometry/box.h"
#include "files/io/run_manifest.h"
#include "files/io/text_file.h"
#include "files/quality/quality_sheet.h"
#include "files/quality/quality_text.h"
#include "run/work/part_queue.h"

namespace kerf {

PartOutcome mesh_in_one_piece(const RunFolder& folder, const Surface& surface, double length_scale,
                              const RunOptions& options, const std::function<void()>& while_waiting) {
    constexpr int no_leaf = 0;
    PartJob job;
    job.part = no_leaf;
    job.surface = surface.arrays();
    job.boundary_id.assign(job.surface.vertices.size(), -1);
    job.neighbour.assign(job.surface.facets.size(), -1);
    job.length_scale = length_scale;
    const std::string job_file = folder.job_file(no_leaf), part_file = folder.stored_part_file(no_leaf);
    write_job(job_file, job);
    PartQueue queue({{job_file, part_file, options.mesher.size, box_around(job.surface.vertices)}},
                    {options.worker_program, options.mesher, 1, options.timeout_seconds, 0, options.attempts});
    queue.add(0);
    std::optional<PartQueue::Finished> finished;
    while (!finished) {
        while_waiting();
        finished = queue.step(0.1);
    }
    remove_run_files(folder.partial_path(), [&](const std::string& file) {
        return folder.file(file) == job_file || folder.file(file) == part_file;
    });
    return std::move(finished->outcome);
}

Reference compare_with_whole(const RunFolder& folder, const RunReport& report, PartOutcome whole) {
    if (whole.result.code) return {std::move(whole), ""};
    const std::string name = std::filesystem::path(report.input.path).filename().string();
    MeshQuality parts, one;
    parts.name = fmt::format("{} in {} parts", name, report.parts.size());
    parts.parts = static_cast<std::int64_t>(report.parts.size());
    parts.vertices = report.mesh.vertices;
    parts.cells = report.mesh.quality;
    one.name = name + " in one piece";
    one.vertices = whole.result.vertices;
    one.cells = whole.result.quality;
    write_text_file(folder.file("comparison.svg"), comparison_sheet(one, parts));
    return {std::move(whole), comparison_text(one, parts)};
}

}  // namespace kerf

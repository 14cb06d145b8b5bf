// The laws of the whole follow from sums over the parts. Volumes need care, because they only agree up to rounding: for
// each region, the volumes of its parts are compared with the volume of the region, within a bound that is itself a sum
// of the bounds of all volumes, of rounding in that sum, and of the distances by which straight cuts move facets. The
// report has error and bound of the region that comes nearest to its bound, or is farthest beyond it. A run passes if
// all parts were meshed and hold by themselves, all counts are zero and the volumes agree; without meshes, the volumes
// of the parts' surfaces stand for those of the cells.
#include "run/report/totals.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/core/error.h"
#include "base/core/ids.h"
#include "run/work/mesh_hash.h"

namespace kerf {

namespace {

// Returns the most by which straight cuts change the sum of the parts' volumes. A new vertex lies beside its edge by
// less than 16 e times the largest coordinate (cut/cut/inside/facet_split.cpp), e = 2^-53, and so does each piece
// beside its facet, once for each level of the tree.
double error_of_splits(const RunReport& report) {
    if (report.cut.split_facets == 0) return 0;
    NodeId last = root_node;
    for (const PartReport& part : report.parts) last = std::max(last, part.id);
    return (level_of(last) + 1) * 16 * 0x1p-53 * report.input.largest_coordinate * report.input.area;
}

// The volume of a region, and the sum of those of its parts.
struct RegionVolume {
    double of_input = 0, of_parts = 0, error = 0;

    double relative_error() const { return std::abs(of_parts - of_input) / of_input; }
    double relative_bound() const { return error / of_input; }
    double share_of_bound() const { return relative_error() / relative_bound(); }
};

Array<RegionIndex, RegionVolume> volumes_of_regions(const RunReport& report) {
    const Input& input = report.input;
    Array<RegionIndex, RegionVolume> volumes;
    for (const InputRegion& region : input.regions) volumes.push_back({region.volume, 0, region.volume_error});
    if (volumes.empty()) volumes.push_back({input.volume, 0, input.volume_error});
    Array<RegionIndex, std::int64_t> parts(volumes.size(), 0);
    for (const PartReport& part : report.parts) {
        const MeshLaws& laws = part.result.laws;
        RegionVolume& region = volumes[part.region];
        region.of_parts += report.request.volume ? laws.volume : part.surface_volume;
        region.error += report.request.volume ? laws.volume_error : part.surface_volume_error;
        ++parts[part.region];
    }
    // Volumes are positive, and added in order.
    for (const RegionIndex r : volumes.ids())
        volumes[r].error += error_of_splits(report) + parts[r] * 0x1p-53 * volumes[r].of_parts;
    return volumes;
}

RunVerification verify_parts(const RunReport& report) {
    RunVerification v = report.verification;
    bool parts_hold = true;
    for (const PartReport& part : report.parts) {
        const MeshLaws& laws = part.result.laws;
        v.inverted_tets += laws.inverted_tets;
        v.tets_without_volume += laws.tets_without_volume;
        v.input_faces_missing += laws.missing_facets;
        v.extra_boundary_faces += laws.extra_boundary_faces;
        if (!report.request.volume) continue;
        v.tets_zero_parts += part.result.tets == 0;
        parts_hold &= part.result.code == 0 && laws.hold();
    }
    const Array<RegionIndex, RegionVolume> volumes = volumes_of_regions(report);
    const auto worst = std::max_element(
        volumes.begin(), volumes.end(),
        [](const RegionVolume& a, const RegionVolume& b) { return a.share_of_bound() < b.share_of_bound(); });
    v.volume_rel_error = worst->relative_error();
    v.volume_rel_bound = worst->relative_bound();
    v.changed_volumes = count_changed_volumes(report.input);
    v.passed = parts_hold && v.all_hold();
    return v;
}

// Measures how the workers spent the meshing stage, as means over all of them.
void measure_workers(RunReport& report) {
    const std::int32_t workers = report.ranks * report.request.workers.count;
    std::vector<double> busy(workers, 0);
    WorkerSeconds& mean = report.worker_seconds;
    for (const PartReport& part : report.parts) {
        if (part.resumed) continue;
        busy[part.rank * report.request.workers.count + part.worker] += part.seconds;
        mean.mesher += part.result.mesh_seconds;
        mean.verify += part.result.verify_seconds;
        mean.store += part.result.store_seconds;
    }
    const double sum = std::accumulate(busy.begin(), busy.end(), 0.0);
    if (sum > 0) report.imbalance = *std::max_element(busy.begin(), busy.end()) * workers / sum;
    for (double* seconds : {&mean.mesher, &mean.verify, &mean.store}) *seconds /= workers;
    mean.start = sum / workers - mean.mesher - mean.verify - mean.store;
    mean.idle = std::max(0.0, report.seconds.mesh - sum / workers);
}

}  // namespace

int failure_code(const std::vector<PartReport>& parts) {
    int code = 0;
    for (const PartReport& part : parts) {
        if (part.result.code == 0) continue;
        const bool memory = part.result.code == static_cast<int>(ErrorCode::memory);
        if (!memory) return static_cast<int>(ErrorCode::subdomain);
        code = part.result.code;
    }
    return code;
}

void add_up_parts(RunReport& report) {
    std::vector<PartHash> hashes;
    for (const PartReport& part : report.parts) {
        report.mesh.tets += part.result.tets;
        report.mesh.sizes.add(part.result.sizes);
        report.mesh.improve_seconds += part.result.improve_seconds;
        report.mesh.recovery.add(part.result.recovery);
        if (report.request.volume && part.result.code == 0) {
            ++report.mesh.parts_by_way[part.result.way()];
            report.mesh.parts_by_tetgen += part.result.is_by_tetgen();
        }
        hashes.push_back({part.id.value(), part.result.hash});
    }
    if (report.request.volume) report.mesh.hash = hash_of_parts(hashes);
    report.verification = verify_parts(report);
    measure_workers(report);
    report.exit_code = failure_code(report.parts);
    if (report.exit_code == 0 && !report.verification.passed)
        report.exit_code = static_cast<int>(ErrorCode::verification);
}

}  // namespace kerf

#include "run/run/inside/told_plan.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace kerf {

namespace {

// Lists the fields of the message, for writing and for reading.
template <class Archive>
class PlanArchive {
 public:
    explicit PlanArchive(Archive& archive) : archive_(archive) {}

    void plan(RunPlan& plan, std::vector<double>& largest_of_regions) {
        RunOptions& options = plan.options;
        archive_(options.input, options.decompose.parts, options.mesher, largest_of_regions);
        length(options.input_options.repairs.weld_tolerance);
        length(options.deviation);
        sizes(options.sizes);
        found(plan.found_size);
        archive_(plan.surface_nodes.edges, plan.surface_nodes.points, plan.surface_nodes.surface_edges);
    }
    void input(Input& input) {
        archive_(input.path, input.file_hash, input.vertices, input.facets, input.components, input.genus);
        archive_(input.volume, input.volume_error, input.area, input.largest_coordinate, input.diagonal);
        archive_(input.patch_names, input.patch_colours, input.notes, input.is_cad);
        regions(input.regions);
    }

 private:
    void length(Length& length) {
        double number = length.number();
        bool is_percent = length.is_percent();
        archive_(number, is_percent);
        length = is_percent ? Length::percent(number) : Length(number);
    }
    void sizes(SizeOptions& sizes) {
        length(sizes.size);
        length(sizes.chord_error);
        archive_(sizes.max_volume, sizes.cells, sizes.fineness, sizes.inside, sizes.on, sizes.near, sizes.in_region);
        archive_(sizes.growth, sizes.segments_per_turn, sizes.cells_across);
    }
    void regions(std::vector<InputRegion>& regions) {
        auto count = static_cast<std::uint64_t>(regions.size());
        archive_(count);
        regions.resize(count);
        for (InputRegion& region : regions)
            archive_(region.facets, region.components, region.volume, region.volume_error, region.area);
    }
    void found(std::optional<FoundSize>& found) {
        FoundSize size = found.value_or(FoundSize());
        bool is_found = found.has_value();
        archive_(is_found, size.cells, size.size, size.tets, size.remeshings);
        found = is_found ? std::optional(size) : std::nullopt;
    }

    Archive& archive_;
};

}  // namespace

Bytes bytes_of_plan(const RunPlan& plan, const Input& input) {
    Bytes bytes;
    ByteWriter writer(bytes);
    PlanArchive<ByteWriter> archive(writer);
    // An archive that writes bytes does not change its fields.
    std::vector<double> largest_of_regions = plan.options.decompose.region_sizes.max_volumes();
    archive.plan(const_cast<RunPlan&>(plan), largest_of_regions);
    archive.input(const_cast<Input&>(input));
    const std::span<const std::string> names = input.complex.region_names();
    const std::span<const FacetSides> sides = input.complex.all_sides();
    writer(std::vector<std::string>(names.begin(), names.end()));
    if (!names.empty()) writer(input.complex.arrays(), std::vector<FacetSides>(sides.begin(), sides.end()));
    return bytes;
}

void take_plan(const Bytes& told, RunPlan& plan, Input& input) {
    ByteReader reader(told);
    PlanArchive<ByteReader> archive(reader);
    std::vector<double> largest_of_regions;
    archive.plan(plan, largest_of_regions);
    plan.options = with_sizes(std::move(plan.options), SizeField(plan.options.mesher.size));
    plan.options.decompose.region_sizes = RegionSizes(std::move(largest_of_regions));
    input = Input();
    archive.input(input);
    std::vector<std::string> names;
    reader(names);
    if (names.empty()) return;
    SurfaceArrays facets;
    std::vector<FacetSides> sides;
    reader(facets, sides);
    input.complex = Complex(std::move(facets), std::move(sides), std::move(names));
}

}  // namespace kerf

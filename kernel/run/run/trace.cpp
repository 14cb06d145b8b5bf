// A file of a trace is a header and one record, both through base/core/bytes.h; the header holds size and hash of the
// record, so that a damaged file is refused. The surfaces of inner nodes are not in it: the sides of the facets and the
// interface of a cut give both halves again, with the same numbers. A straight cut is the exception: it splits facets
// of the node before it cuts, so that its Cut holds the surface of the node (Cut::split_parent). A node is cut twice
// where straight cuts follow a contour that was not found; the record then has the last cut, with the tries of both.
#include "run/run/trace.h"

#include <algorithm>
#include <bit>
#include <limits>

#include <fmt/format.h>

#include "base/core/hash.h"
#include "cut/cut/split.h"
#include "files/io/checked_file.h"
#include "files/io/file_bytes.h"
#include "files/io/output_file.h"
#include "surface/complex/touching.h"

namespace kerf {

namespace {

constexpr std::uint64_t trace_magic = 0x636172746672656b;  // "kerftrac" in little-endian order
constexpr std::uint32_t trace_version = 6;  // is raised whenever a field of the record is added, dropped or changed

struct TraceHeader {
    std::uint64_t magic = trace_magic;
    std::uint32_t version = trace_version;
    std::uint64_t record_size = 0;
    std::uint64_t record_hash = 0;

    template <class Archive>
    void archive(Archive& a) {
        a(magic, version, record_size, record_hash);
    }
};

[[noreturn]] void refuse(const std::string& path, const std::string& reason) {
    throw Error(ErrorCode::io, path + ": " + reason);
}

std::size_t header_size() { return to_bytes(TraceHeader()).size(); }

void check(const TraceHeader& header, std::span<const char> record, const std::string& path) {
    if (header.magic != trace_magic)
        refuse(path, "the file is no trace of Kerf. Give a file that --trace has written.");
    if (header.version != trace_version)
        refuse(path, fmt::format("the trace has format {}, but this version of Kerf reads format {}. Read it with the "
                                 "version that wrote it, or repeat the run.",
                                 header.version, trace_version));
    if (header.record_size != record.size())
        refuse(path, fmt::format("the trace is truncated or damaged: {} bytes should follow its header, but {} do. "
                                 "Copy it again, or repeat the run.",
                                 header.record_size, record.size()));
    if (header.record_hash != hash_bytes(record))
        refuse(path,
               "the trace is damaged: its bytes are not those that were written. Copy it again, or repeat the "
               "run.");
}

// The first node of each region; all ranks have the nodes above the regions that they own.
std::vector<NodeId> roots_of_regions(Communicator& ranks, const std::vector<TreeNode>& own, std::size_t regions) {
    std::vector<NodeId> roots(regions, NodeId(std::numeric_limits<std::int32_t>::max()));
    for (const TreeNode& node : own)
        if (NodeId& root = roots[node.region.value()]; node.regions == 1) root = std::min(root, node.id);
    for (const std::vector<NodeId>& of_rank : all_gather(ranks, roots))
        for (std::size_t r = 0; r < regions; ++r) roots[r] = std::min(roots[r], of_rank[r]);
    return roots;
}

}  // namespace

const Cut* Trace::find(NodeId node) const {
    const auto found = std::partition_point(cuts.begin(), cuts.end(), [&](const Cut& c) { return c.node < node; });
    return found != cuts.end() && found->node == node ? &*found : nullptr;
}

std::optional<Surface> Trace::root_surface(NodeId node) const {
    if (region_roots.empty()) return node == root_node ? std::optional(Surface(surface)) : std::nullopt;
    const auto root = std::find(region_roots.begin(), region_roots.end(), node);
    if (root == region_roots.end()) return std::nullopt;
    return Complex(surface, sides, region_names).surface_of(RegionIndex(root - region_roots.begin()));
}

bool Trace::holds_regions(NodeId node) const {
    return std::any_of(region_roots.begin(), region_roots.end(),
                       [&](NodeId root) { return root != node && lies_below(root, node); });
}

SurfaceArrays Trace::outside_of_regions(NodeId node) const {
    const auto is_inside = [&](RegionIndex region) {
        return region.is_valid() && lies_below(region_roots[region.value()], node);
    };
    SurfaceArrays outside = surface;  // all of its vertices stay
    std::size_t kept = 0;
    for (std::size_t f = 0; f < sides.size(); ++f) {
        const bool has_back = is_inside(sides[f].back), has_front = is_inside(sides[f].front);
        if (has_back == has_front) continue;
        const Triangle& t = surface.facets[f];
        outside.facets[kept] = has_back ? t : Triangle{t[0], t[2], t[1]};
        outside.facet_key[kept] = surface.facet_key[f];
        outside.patch[kept++] = surface.patch[f];
    }
    outside.facets.resize(kept);
    outside.facet_key.resize(kept);
    outside.patch.resize(kept);
    return outside;
}

Surface replay(const Trace& trace, NodeId node) {
    if (const Cut* straight = trace.find(node); straight && !straight->split_parent.facets.empty())
        return separated_surface(straight->split_parent);
    if (std::optional<Surface> root = trace.root_surface(node)) return *std::move(root);
    const Cut* cut = trace.find(parent_of(node));
    if (!cut || !cut->made())
        throw Error(ErrorCode::usage, fmt::format("The tree of {} has no node {} with a surface. Its root is 1, the "
                                                  "children of a node i that was cut, or that holds several regions, "
                                                  "are 2i and 2i+1.",
                                                  trace.input, node.value()));
    const Surface parent = replay(trace, parent_of(node));
    return separated_surface(split(parent, cut->side, cut->interface, cut->node)[side_of(node)].arrays);
}

void write_trace(const std::string& path, const Trace& trace) {
    const Bytes record = to_bytes(trace);
    TraceHeader header;
    header.record_size = record.size();
    header.record_hash = hash_bytes(record);
    const Bytes begin = to_bytes(header);
    CheckedFile file(open_output(path), path);
    file.write(begin.data(), begin.size());
    file.write(record.data(), record.size());
    file.close();
}

Trace read_trace(const std::string& path) {
    const std::string file = read_file(path);
    if (file.size() < header_size())
        refuse(path, fmt::format("the file ends after {} bytes, within the header of a trace. Copy it again, or give a "
                                 "file that --trace has written.",
                                 file.size()));
    const std::span<const char> bytes(file);
    const std::span<const char> record = bytes.subspan(header_size());
    check(from_bytes<TraceHeader>(bytes), record, path);
    return from_bytes<Trace>(record);
}

TraceRecorder::TraceRecorder(const RunRequest& options, const Input& input, CutListener* next) : next_(next) {
    trace_.input = input.path;
    trace_.surface = input.complex.arrays();
    trace_.sides.assign(input.complex.all_sides().begin(), input.complex.all_sides().end());
    trace_.region_names.assign(input.complex.region_names().begin(), input.complex.region_names().end());
    trace_.remeshed = input.remeshed.has_value();
    trace_.patch_names = input.patch_names;
    trace_.patch_colours = input.patch_colours;
    trace_.options = option_texts(options, true);
}

void TraceRecorder::on_cut(const Surface& parent, const Cut& cut) {
    const auto earlier =
        std::find_if(trace_.cuts.begin(), trace_.cuts.end(), [&](const Cut& other) { return other.node == cut.node; });
    if (earlier == trace_.cuts.end()) {
        trace_.cuts.push_back(cut);
        trace_.cuts.back().seconds = 0;
    } else {  // a straight cut where no contour of edges was found
        const std::vector<CutTry> tries = std::move(earlier->tries);
        *earlier = cut;
        earlier->seconds = 0;
        earlier->tries.insert(earlier->tries.begin(), tries.begin(), tries.end());
    }
    if (next_ && next_->wants_cuts()) next_->on_cut(parent, cut);
}

void TraceRecorder::write(const std::string& path, Communicator& ranks, const Decomposition& own, LeafRange range) {
    const auto by_node = [](const Cut& a, const Cut& b) { return a.node < b.node; };
    std::sort(trace_.cuts.begin(), trace_.cuts.end(), by_node);
    std::vector<Cut> given;
    for (const TreeNode& node : own.nodes)
        if (node.cut_tried && range.meets(node.first_leaf, 1)) given.push_back(*trace_.find(node.id));
    constexpr int root = 0;
    trace_.cuts = gather_items_to(ranks, root, std::move(given));
    if (!trace_.region_names.empty())
        trace_.region_roots = roots_of_regions(ranks, own.nodes, trace_.region_names.size());
    in_agreement(ranks, [&] {
        if (ranks.rank() != root) return;
        std::sort(trace_.cuts.begin(), trace_.cuts.end(), by_node);
        write_trace(path, trace_);
    });
}

}  // namespace kerf

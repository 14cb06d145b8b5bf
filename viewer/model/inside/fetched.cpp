// A value is fetched once: its key is in the store, among those being fetched, or among those that have failed, and in
// none of these cases is anything posted. make() runs on the loader's thread with copies and shared constants; its
// completion puts the value into the store. A failed key is tried again only after restart() or drop(), because every
// frame would repeat the error otherwise; a failure to read a folder that a run has just moved is none. Nothing is
// fetched into a store that values in use fill: they would drive each other out, frame after frame. The surface of a
// node comes from the trace where there is one, else from the parts of the folder, else from the soup; vertices and
// facets have other numbers in each, so that use_trace() drops the surfaces of nodes. The surface before remeshing is
// read from the file again, when it is asked for. Prefetching fills idle time: breadth first while there is room, and
// depth first afterwards for the rows that still lack facts, because the replayer keeps only the last surfaces.
#include "viewer/model/inside/fetched.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/core/ids.h"
#include "base/geometry/box.h"
#include "run/prepare/size_reader.h"
#include "surface/complex/mass_properties.h"
#include "viewer/model/inside/node_surface.h"
#include "viewer/model/inside/opened_run.h"
#include "viewer/model/inside/tree_source.h"
#include "viewer/model/surface_values.h"

namespace kerf::view {

namespace {

constexpr std::size_t replayer_bytes = std::size_t{1} << 30, prefetch_bytes = std::size_t{1} << 30;

std::size_t bytes_of_value(const NodeSurface& value) { return bytes_of(value); }
std::size_t bytes_of_value(const PartCells& value) { return bytes_of(value); }
std::size_t bytes_of_value(const SurfaceValues& value) { return sizeof value + bytes_of(value.values); }
std::size_t bytes_of_value(const PartSolution& value) {
    return sizeof value + bytes_of(value.displacement) + bytes_of(value.stress) + bytes_of(value.von_mises) +
           bytes_of(value.error_of_tet) + bytes_of(value.error_at_facet);
}
template <class T>
std::size_t bytes_of_value(const std::vector<T>& value) {
    return sizeof value + bytes_of(value);
}

bool can_be_fetched(ColorBy color) { return is_measure(color) || is_kind(color); }

// Depth first, parents before children.
void sort_depth_first(std::vector<NodeId>& nodes) {
    const auto path = [](NodeId node) { return std::pair(node.value() << (30 - level_of(node)), level_of(node)); };
    std::sort(nodes.begin(), nodes.end(), [&](NodeId a, NodeId b) { return path(a) < path(b); });
}

// The folder whose parts have nodes on edges; empty: none. A solution may be of higher order than its mesh.
std::string folder_of_edge_nodes(const Document& document) {
    if (document.solution && document.solution->order > 1) return document.solution->folder;
    return document.options.order > 1 ? document.folder : "";
}

SizeField field_of(SizeOptions sizes, const NodeSurface& whole, const std::vector<std::string>& patch_names) {
    sizes.resolve_lengths(box_around(whole.vertices).diagonal().norm());
    SurfaceArrays arrays;
    arrays.vertices = whole.vertices;
    arrays.facets = whole.facets;
    arrays.patch = whole.patch;
    return read_size_field(sizes, arrays, patch_names);
}

// Fills the rows of cuts of which nothing has told yet.
void describe_cuts(Document& document) {
    for (const Cut& cut : document.trace->cuts) {
        TreeRow* row = document.tree.find(cut.node);
        if (!row || row->cut) continue;
        const NodeState state = row->state;
        describe_cut(cut, *row);
        row->state = state;
    }
}

}  // namespace

template <class T>
std::shared_ptr<const T> Fetched::kept(const Store::Key& key) {
    asked_ = true;
    return shown_.store.find<T>(key);
}

// Fetches a value that is not kept. `make` runs on the loader's thread.
template <class T, class Make>
std::shared_ptr<const T> Fetched::fetch(const Store::Key& key, Make make) {
    if (fetching_.contains(key) || failed_.contains(key)) return nullptr;
    if (shown_.store.is_full()) {
        if (!told_of_full_store_)
            background_.note_failure(
                fmt::format("What is shown fills the {} GB that the viewer allows itself. Hide some parts.",
                            Shown::store_bytes >> 30));
        told_of_full_store_ = true;
        return nullptr;
    }
    fetching_.insert(key);
    const auto work = [this, key, make]() -> Loader::Completion {
        Made<T> made = make();
        const std::size_t bytes = bytes_of_value(made.value);
        return [this, key, value = std::make_shared<const T>(std::move(made.value)), bytes, also = made.also] {
            fetching_.erase(key);
            shown_.store.insert(key, value, bytes);
            if (also) also();
        };
    };
    const auto failed = [this, key, folder = shown_.document.folder](const Error& error) {
        fetching_.erase(key);
        if (!folder.empty() && !exists(folder)) return;  // the run has just moved it
        failed_.insert(key);
        background_.note_failure(error);
    };
    background_.post(background_.data, work, failed);
    return nullptr;
}

// Fills the row of a node from its surface, unless a report has described the node.
Loader::Completion Fetched::fill_row(NodeId node, const Surface& surface) {
    return [this, node, vertices = surface.vertex_count(), facets = surface.facet_count(),
            mass = mass_properties(surface)] {
        TreeRow* row = shown_.document.tree.find(node);
        if (row && !row->centroid) describe_surface(vertices, facets, mass, *row);
    };
}

std::shared_ptr<const NodeSurface> Fetched::surface(NodeId node) {
    const Document& document = shown_.document;
    const Store::Key key{Store::Kind::surface, node};
    const bool is_known = node == not_repaired   ? document.unrepaired != nullptr
                          : node == not_remeshed ? document.remeshed
                                                 : document.tree.find(node) != nullptr;
    if (!is_known) return nullptr;
    if (auto found = kept<NodeSurface>(key)) return found;
    if (node == not_repaired)
        return fetch<NodeSurface>(key,
                                  [unrepaired = document.unrepaired] { return node_surface_of(unrepaired->soup); });
    if (node == not_remeshed)
        return fetch<NodeSurface>(key, [path = document.options.input, options = document.options.input_options] {
            return node_surface_of(read_input(path, options).complex.arrays());
        });
    if (shown_.replayer && document.trace->holds_regions(node))
        return fetch<NodeSurface>(
            key, [trace = document.trace, node] { return node_surface_of(trace->outside_of_regions(node)); });
    if (shown_.replayer)
        return fetch<NodeSurface>(key, [this, replayer = shown_.replayer, node]() -> Made<NodeSurface> {
            const std::shared_ptr<const Surface> surface = replayer->surface(node);
            return {node_surface_of(surface->arrays()), fill_row(node, *surface)};
        });
    if (!shown_.folder_parts.empty()) {
        std::vector<PartBelow> parts;
        for (const NodeId part : document.tree.parts_below(node))
            if (shown_.folder_parts.contains(part))
                parts.emplace_back(part, shown_.store.find<NodeSurface>({Store::Kind::part_surface, part}));
        return fetch<NodeSurface>(
            key, [folder = document.folder, node, parts] { return join_part_surfaces(folder, node, parts); });
    }
    if (!document.soup || node != root_node) return nullptr;
    return fetch<NodeSurface>(key, [soup = document.soup] { return node_surface_of(*soup); });
}

bool Fetched::has_part_surface(NodeId node) const {
    return shown_.folder_parts.contains(node) && !failed_.contains({Store::Kind::part_surface, node});
}

std::shared_ptr<const NodeSurface> Fetched::part_surface(NodeId part) {
    const Store::Key key{Store::Kind::part_surface, part};
    if (!shown_.folder_parts.contains(part)) return nullptr;
    if (auto found = kept<NodeSurface>(key)) return found;
    return fetch<NodeSurface>(key,
                              [folder = shown_.document.folder, part, nodes = folder_of_edge_nodes(shown_.document)] {
                                  NodeSurface surface = read_part_surface(folder, part);
                                  if (!nodes.empty()) add_edge_nodes(nodes, part, surface);
                                  return surface;
                              });
}

// The surface from which a surface deviates: the present one from the one before, and each one before from the present
// one. nullptr: it is not there yet.
std::shared_ptr<const NodeSurface> Fetched::compared_with(const std::shared_ptr<const NodeSurface>& surface,
                                                          const std::shared_ptr<const NodeSurface>& whole) {
    const auto unrepaired = shown_.document.unrepaired ? this->surface(not_repaired) : nullptr;
    if (!shown_.document.remeshed) return surface == unrepaired ? whole : unrepaired;
    const auto before = this->surface(not_remeshed);
    return surface == before || surface == unrepaired ? whole : before;
}

std::shared_ptr<const SurfaceValues> Fetched::values_on(const std::shared_ptr<const NodeSurface>& surface,
                                                        ColorBy color) {
    const Document& document = shown_.document;
    if (!surface || !is_of_surface(color) || why_without_values(document, color)) return nullptr;
    const Store::Key key{.kind = Store::Kind::on_surface, .color = color, .of = surface.get()};
    if (auto found = kept<SurfaceValues>(key)) return found;
    const auto whole = this->surface(root_node);
    if (!whole) return nullptr;
    if (color == ColorBy::deviation) {
        const auto other = compared_with(surface, whole);
        if (!other) return nullptr;
        return fetch<SurfaceValues>(key, [surface, other] {
            return SurfaceValues{surface, distances_of_facets(*surface, *other)};
        });
    }
    return fetch<SurfaceValues>(key, [surface, whole, sizes = document.options.sizes, names = document.patch_names] {
        return SurfaceValues{surface, lengths_at_vertices(*surface, field_of(sizes, *whole, names))};
    });
}

bool Fetched::is_meshed(NodeId part) const {
    const TreeRow* row = shown_.document.tree.find(part);
    return row && row->state == NodeState::done && shown_.folder_parts.contains(part);
}

PartSource Fetched::source_of(NodeId part) const {
    const Document& document = shown_.document;
    const TreeRow* row = document.tree.find(part);
    return {document.folder, part, row ? row->core_tets : 0, folder_of_edge_nodes(document)};
}

std::shared_ptr<const PartCells> Fetched::cells(NodeId part) {
    const Store::Key key{Store::Kind::cells, part};
    if (!is_meshed(part)) return nullptr;
    if (auto found = kept<PartCells>(key)) return found;
    return fetch<PartCells>(key, [source = source_of(part)] { return read_part_cells(source); });
}

// Fetches values of a part, which are computed from the cells where these are at hand.
template <class Read>
std::shared_ptr<const std::vector<float>> Fetched::values(Store::Kind kind, NodeId part, ColorBy color, Read read) {
    const Store::Key key{kind, part, color};
    if (!is_meshed(part) || !can_be_fetched(color)) return nullptr;
    if (auto found = kept<std::vector<float>>(key)) return found;
    const auto at_hand = shown_.store.find<PartCells>({Store::Kind::cells, part});
    return fetch<std::vector<float>>(
        key, [source = source_of(part), color, at_hand, read] { return read(source, color, at_hand.get()); });
}

std::shared_ptr<const std::vector<float>> Fetched::cell_values(NodeId part, ColorBy color) {
    return values(Store::Kind::cell_values, part, color, read_values_of_cells);
}

std::shared_ptr<const std::vector<float>> Fetched::facet_values(NodeId part, ColorBy color) {
    return values(Store::Kind::facet_values, part, color, read_values_at_facets);
}

// The list of fewer parts is shown while that of more is being made. A run that is under way gets a new one when it has
// a quarter more parts, so that all lists together read no part more than a few times.
std::shared_ptr<const std::vector<WorstCell>> Fetched::worst_cells(ColorBy color, std::size_t count) {
    if (!is_measure(color)) return nullptr;
    std::vector<NodeId> parts;
    for (const NodeId part : shown_.document.tree.parts_below(root_node))
        if (is_meshed(part)) parts.push_back(part);
    const std::int32_t all = count_of(parts);
    const auto key_of = [&](std::int32_t parts_read) {
        return Store::Key{Store::Kind::worst_cells, NodeId(parts_read), color, count};
    };
    std::int32_t known = all;
    while (known > 0 && !shown_.store.holds(key_of(known))) --known;
    const auto found = known > 0 ? kept<std::vector<WorstCell>>(key_of(known)) : nullptr;
    const bool is_enough = shown_.document.progress.running && 4 * all < 5 * known;
    if (all == 0 || known == all || is_enough) return found;
    const auto scope = std::shared_ptr<const Scope>(background_.data.scope);
    fetch<std::vector<WorstCell>>(key_of(all), [folder = shown_.document.folder, parts, color, count, scope] {
        return find_worst_cells(folder, parts, color, count, [&] { return scope->has_ended(); });
    });
    return found;
}

std::shared_ptr<const PartSolution> Fetched::solution(NodeId part, std::size_t number) {
    const std::optional<Solution>& solution = shown_.document.solution;
    if (!solution || number >= solution->cases.size() || !is_meshed(part)) return nullptr;
    const Store::Key key{.kind = Store::Kind::solution, .node = part, .count = number};
    if (auto found = kept<PartSolution>(key)) return found;
    return fetch<PartSolution>(key, [of = *solution, number, part] { return read_part_solution(of, number, part); });
}

void Fetched::next_frame() {
    if (asked_) shown_.store.next_frame();
    asked_ = false;
}

void Fetched::restart() {
    background_.data.reset();
    background_.redo.reset();
    fetching_.clear();
    failed_.clear();
    told_of_full_store_ = false;
}

void Fetched::forget() {
    restart();
    shown_.store.clear();
    shown_.replayer.reset();
    shown_.folder_parts.clear();
    shown_.cuts_again.clear();
}

void Fetched::drop(const Store::Key& key) {
    shown_.store.erase(key);
    failed_.erase(key);
}

void Fetched::use_trace(std::shared_ptr<const Trace> trace) {
    restart();
    Document& document = shown_.document;
    document.trace = trace;
    document.patch_colours = trace->patch_colours;  // folders have none
    note_remeshing(trace->remeshed, document);
    shown_.replayer = std::make_shared<Replayer>(std::move(trace), replayer_bytes);
    shown_.store.erase_if([](const Store::Key& key) {
        return (key.kind == Store::Kind::surface && key.node > no_node) || key.kind == Store::Kind::on_surface;
    });
    describe_cuts(document);
    prefetch_surfaces();
}

namespace {

// The state that prefetching tasks share; only they look at it, one after the other.
struct Prefetch {
    std::shared_ptr<Replayer> replayer;
    std::vector<NodeId> nodes;     // the next one last
    std::set<NodeId> undescribed;  // nodes whose rows lack facts that only the surface tells
    std::size_t bytes = 0;
    bool is_full = false;
};

}  // namespace

// Makes steps through the tree immediate. A surface for which there is no room is still made, to describe its row.
void Fetched::prefetch_surfaces() {
    if (!shown_.replayer) return;
    const auto state = std::make_shared<Prefetch>();
    state->replayer = shown_.replayer;
    for (const TreeRow& row : shown_.document.tree.rows) {
        if (!row.centroid) state->undescribed.insert(row.id);
        if (shown_.replayer->trace()->holds_regions(row.id)) continue;
        if (!row.centroid || !shown_.store.holds({Store::Kind::surface, row.id})) state->nodes.push_back(row.id);
    }
    std::reverse(state->nodes.begin(), state->nodes.end());
    const auto next = [this, state]() -> Loader::Completion {
        if (state->nodes.empty()) return {};
        const NodeId node = state->nodes.back();
        state->nodes.pop_back();
        const std::shared_ptr<const Surface> surface = state->replayer->surface(node);
        Loader::Completion fill;
        if (state->undescribed.contains(node)) fill = fill_row(node, *surface);
        if (state->is_full) return fill;
        const auto value = std::make_shared<const NodeSurface>(node_surface_of(surface->arrays()));
        const std::size_t bytes = bytes_of(*value);
        state->bytes += bytes;
        if (state->bytes > prefetch_bytes) {
            state->is_full = true;
            std::erase_if(state->nodes, [&](NodeId other) { return !state->undescribed.contains(other); });
            sort_depth_first(state->nodes);
            std::reverse(state->nodes.begin(), state->nodes.end());
        }
        return [this, node, value, bytes, fill] {
            const Store::Key key{Store::Kind::surface, node};
            if (!shown_.store.holds(key)) shown_.store.insert(key, value, bytes);
            if (fill) fill();
        };
    };
    for (std::size_t i = state->nodes.size(); i > 0; --i) background_.post_idle(background_.data, next);
}

}  // namespace kerf::view

// What is asked for is fetched once: its key is in the store, or among those being fetched, or among the failed ones.
#include "viewer/model/session_impl.h"

#include <algorithm>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "prepare/size_reader.h"
#include "surface/mass_properties.h"
#include "viewer/model/node_surface.h"
#include "viewer/model/surface_values.h"
#include "viewer/model/tree_source.h"

namespace kerf::view {

namespace {

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
    const auto path = [](NodeId node) { return std::pair(node << (30 - level_of(node)), level_of(node)); };
    std::sort(nodes.begin(), nodes.end(), [&](NodeId a, NodeId b) { return path(a) < path(b); });
}

}  // namespace

template <class T>
std::shared_ptr<const T> Session::Impl::kept(const Store::Key& key) {
    asked_ = true;
    return store_.find<T>(key);
}

// For what is not kept. `make` runs on the loader's thread.
template <class T, class Make>
std::shared_ptr<const T> Session::Impl::fetch(const Store::Key& key, Make make) {
    if (fetching_.contains(key) || failed_.contains(key)) return nullptr;
    if (store_.is_full()) {
        if (!told_of_full_store_)
            note_failure(fmt::format("What is shown fills the {} GB that the viewer allows itself. Hide some parts.",
                                     store_bytes >> 30));
        told_of_full_store_ = true;
        return nullptr;
    }
    fetching_.insert(key);
    const auto work = [this, key, make]() -> Loader::Completion {
        Fetched<T> fetched = make();
        const std::size_t bytes = bytes_of_value(fetched.value);
        return [this, key, value = std::make_shared<const T>(std::move(fetched.value)), bytes, also = fetched.also] {
            fetching_.erase(key);
            store_.insert(key, value, bytes);
            if (also) also();
        };
    };
    const auto failed = [this, key, folder = document_.folder](const std::string& message) {
        fetching_.erase(key);
        std::error_code ignored;
        if (!folder.empty() && !std::filesystem::exists(folder, ignored)) return;  // the run has just moved it
        failed_.insert(key);
        note_failure(message);
    };
    post(data_, work, failed);
    return nullptr;
}

// Of nodes that a report describes the row stays as it is.
Loader::Completion Session::Impl::fill_row(NodeId node, std::int64_t vertices, std::int64_t facets,
                                           const MassProperties& mass) {
    return [this, node, vertices, facets, mass] {
        TreeRow* row = document_.tree.find(node);
        if (row && !row->centroid) describe_surface(vertices, facets, mass, *row);
    };
}

std::shared_ptr<const NodeSurface> Session::Impl::surface(NodeId node) {
    const Store::Key key{Store::Kind::surface, node};
    const bool is_known = node == not_repaired   ? document_.unrepaired != nullptr
                          : node == not_remeshed ? document_.remeshed
                                                 : document_.tree.find(node) != nullptr;
    if (!is_known) return nullptr;
    if (auto found = kept<NodeSurface>(key)) return found;
    if (node == not_repaired)
        return fetch<NodeSurface>(key, [unrepaired = document_.unrepaired]() -> Fetched<NodeSurface> {
            return {node_surface_of(unrepaired->soup), {}};
        });
    if (node == not_remeshed)
        return fetch<NodeSurface>(
            key, [path = document_.options.input, options = document_.options.input_options]() -> Fetched<NodeSurface> {
                return {node_surface_of(read_input(path, options).complex.arrays()), {}};
            });
    if (replayer_ && document_.trace->holds_regions(node))
        return fetch<NodeSurface>(key, [trace = document_.trace, node]() -> Fetched<NodeSurface> {
            return {node_surface_of(trace->outside_of_regions(node)), {}};
        });
    if (replayer_)
        return fetch<NodeSurface>(key, [this, replayer = replayer_, node]() -> Fetched<NodeSurface> {
            const std::shared_ptr<const Surface> surface = replayer->surface(node);
            return {node_surface_of(surface->arrays()),
                    fill_row(node, surface->vertex_count(), surface->facet_count(), mass_properties(*surface))};
        });
    if (!folder_parts_.empty()) {
        std::vector<PartBelow> parts;
        for (const NodeId part : document_.tree.parts_below(node))
            if (folder_parts_.contains(part))
                parts.emplace_back(part, store_.find<NodeSurface>({Store::Kind::part_surface, part}));
        return fetch<NodeSurface>(key, [folder = document_.folder, node, parts]() -> Fetched<NodeSurface> {
            return {join_part_surfaces(folder, node, parts), {}};
        });
    }
    if (!document_.soup || node != 1) return nullptr;
    return fetch<NodeSurface>(key, [soup = document_.soup]() -> Fetched<NodeSurface> {
        return {node_surface_of(*soup), {}};
    });
}

std::shared_ptr<const NodeSurface> Session::Impl::part_surface(NodeId part) {
    const Store::Key key{Store::Kind::part_surface, part};
    if (!folder_parts_.contains(part)) return nullptr;
    if (auto found = kept<NodeSurface>(key)) return found;
    return fetch<NodeSurface>(
        key, [folder = document_.folder, part, nodes = folder_of_edge_nodes()]() -> Fetched<NodeSurface> {
            NodeSurface surface = read_part_surface(folder, part);
            if (!nodes.empty()) add_edge_nodes(nodes, part, surface);
            return {std::move(surface), {}};
        });
}

namespace {

SizeField field_of(SizeOptions sizes, const NodeSurface& whole, const std::vector<std::string>& patch_names) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : whole.vertices) box.extend(p);
    sizes.resolve_lengths(box.diagonal().norm());
    if (!sizes.depends_on_place()) return SizeField(sizes.constant_max_volume());
    SurfaceArrays arrays;
    arrays.vertices = whole.vertices;
    arrays.facets = whole.facets;
    arrays.patch = whole.patch;
    return read_size_field(sizes, arrays, patch_names);
}

}  // namespace

// The surface from which one deviates: what is now from what was before, and what was from what is. nullptr: not there
// yet.
std::shared_ptr<const NodeSurface> Session::Impl::compared_with(const std::shared_ptr<const NodeSurface>& surface,
                                                                const std::shared_ptr<const NodeSurface>& whole) {
    const auto unrepaired = document_.unrepaired ? this->surface(not_repaired) : nullptr;
    if (!document_.remeshed) return surface == unrepaired ? whole : unrepaired;
    const auto before = this->surface(not_remeshed);
    return surface == before || surface == unrepaired ? whole : before;
}

std::shared_ptr<const SurfaceValues> Session::Impl::values_on(const std::shared_ptr<const NodeSurface>& surface,
                                                              ColorBy color) {
    if (!surface || !is_of_surface(color) || why_without_values(document_, color)) return nullptr;
    const bool is_deviation = color == ColorBy::deviation;
    const Store::Key key{.kind = Store::Kind::on_surface, .color = static_cast<int>(color), .of = surface.get()};
    if (auto found = kept<SurfaceValues>(key)) return found;
    const auto whole = this->surface(1);
    if (!whole) return nullptr;
    if (is_deviation) {
        const auto other = compared_with(surface, whole);
        if (!other) return nullptr;
        return fetch<SurfaceValues>(key, [surface, other]() -> Fetched<SurfaceValues> {
            return {{surface, distances_of_facets(*surface, *other)}, {}};
        });
    }
    return fetch<SurfaceValues>(
        key,
        [surface, whole, sizes = document_.options.sizes, names = document_.patch_names]() -> Fetched<SurfaceValues> {
            return {{surface, lengths_at_vertices(*surface, field_of(sizes, *whole, names))}, {}};
        });
}

bool Session::Impl::is_meshed(NodeId part) const {
    const TreeRow* row = document_.tree.find(part);
    return row && row->state == NodeState::done && folder_parts_.contains(part);
}

PartSource Session::Impl::source_of(NodeId part) const {
    const TreeRow* row = document_.tree.find(part);
    return {document_.folder, part, row ? row->core_tets : 0, folder_of_edge_nodes()};
}

std::shared_ptr<const PartCells> Session::Impl::cells(NodeId part) {
    const Store::Key key{Store::Kind::cells, part};
    if (!is_meshed(part)) return nullptr;
    if (auto found = kept<PartCells>(key)) return found;
    return fetch<PartCells>(key, [source = source_of(part)]() -> Fetched<PartCells> {
        return {read_part_cells(source), {}};
    });
}

std::shared_ptr<const std::vector<float>> Session::Impl::cell_values(NodeId part, ColorBy color) {
    const Store::Key key{Store::Kind::cell_values, part, static_cast<int>(color)};
    if (!is_meshed(part) || !can_be_fetched(color)) return nullptr;
    if (auto found = kept<std::vector<float>>(key)) return found;
    const auto at_hand = store_.find<PartCells>({Store::Kind::cells, part});
    return fetch<std::vector<float>>(key, [source = source_of(part), color, at_hand]() -> Fetched<std::vector<float>> {
        return {read_values_of_cells(source, color, at_hand.get()), {}};
    });
}

std::shared_ptr<const std::vector<float>> Session::Impl::facet_values(NodeId part, ColorBy color) {
    const Store::Key key{Store::Kind::facet_values, part, static_cast<int>(color)};
    if (!is_meshed(part) || !can_be_fetched(color)) return nullptr;
    if (auto found = kept<std::vector<float>>(key)) return found;
    const auto at_hand = store_.find<PartCells>({Store::Kind::cells, part});
    return fetch<std::vector<float>>(key, [source = source_of(part), color, at_hand]() -> Fetched<std::vector<float>> {
        return {read_values_at_facets(source, color, at_hand.get()), {}};
    });
}

// The list of fewer parts is shown while that of more is being made. A run that is under way gets a new one when it has
// a quarter more parts, so that all lists together read no part more than a few times.
std::shared_ptr<const std::vector<WorstCell>> Session::Impl::worst_cells(ColorBy color, std::size_t count) {
    if (!is_measure(color)) return nullptr;
    std::vector<NodeId> parts;
    for (const NodeId part : document_.tree.parts_below(1))
        if (is_meshed(part)) parts.push_back(part);
    const auto all = static_cast<NodeId>(parts.size());
    const auto key_of = [&](NodeId parts_read) {
        return Store::Key{Store::Kind::worst_cells, parts_read, static_cast<int>(color), count};
    };
    NodeId known = all;
    while (known > 0 && !store_.holds(key_of(known))) --known;
    const auto found = known > 0 ? kept<std::vector<WorstCell>>(key_of(known)) : nullptr;
    const bool is_enough = document_.progress.running && 4 * all < 5 * known;
    if (all == 0 || known == all || is_enough) return found;
    fetch<std::vector<WorstCell>>(
        key_of(all),
        [folder = document_.folder, parts, color, count,
         scope = std::shared_ptr<const Scope>(data_.scope)]() -> Fetched<std::vector<WorstCell>> {
            return {find_worst_cells(folder, parts, color, count, [&] { return scope->has_ended(); }), {}};
        });
    return found;
}

std::shared_ptr<const PartSolution> Session::Impl::solution(NodeId part, std::size_t number) {
    if (!document_.solution || number >= document_.solution->cases.size() || !is_meshed(part)) return nullptr;
    const Store::Key key{Store::Kind::solution, part, 0, number};
    if (auto found = kept<PartSolution>(key)) return found;
    return fetch<PartSolution>(key, [of = *document_.solution, number, part]() -> Fetched<PartSolution> {
        return {read_part_solution(of, number, part), {}};
    });
}

// What is under way is of a tree or of files that are there no more.
void Session::Impl::restart_data() {
    data_.reset();
    fetching_.clear();
    failed_.clear();
    told_of_full_store_ = false;
    redoing_ = false;
}

void Session::Impl::forget_data() {
    restart_data();
    store_.clear();
    replayer_.reset();
    folder_parts_.clear();
    redo_queue_.clear();
}

// Without its file there is nothing to compare with.
void Session::Impl::note_remeshing(bool remeshed) {
    std::error_code ignored;
    document_.remeshed = remeshed && std::filesystem::exists(document_.options.input, ignored);
}

// Vertices and facets of nodes have other numbers in a trace than in a run folder.
void Session::Impl::use_trace(std::shared_ptr<Replayer> replayer) {
    restart_data();
    document_.trace = replayer->trace();
    document_.patch_colours = document_.trace->patch_colours;  // folders have none
    note_remeshing(document_.trace->remeshed);
    replayer_ = std::move(replayer);
    store_.erase_if([](const Store::Key& key) {
        return (key.kind == Store::Kind::surface && key.node > 0) || key.kind == Store::Kind::on_surface;
    });
    describe_cuts();
    prefetch_surfaces();
}

// Where nothing has told of them yet.
void Session::Impl::describe_cuts() {
    for (const Cut& cut : document_.trace->cuts) {
        TreeRow* row = document_.tree.find(cut.node);
        if (!row || row->cut) continue;
        const NodeState state = row->state;
        describe_cut(cut, *row);
        row->state = state;
    }
}

namespace {

// What prefetching tasks share; only they look at it, one after the other.
struct Prefetch {
    std::shared_ptr<Replayer> replayer;
    std::vector<NodeId> nodes;     // the next one last
    std::set<NodeId> undescribed;  // whose rows lack what only the surface tells
    std::size_t bytes = 0;
    bool is_full = false;
};

}  // namespace

// So that stepping through the tree is immediate: breadth first while there is room. What does not fit is still
// described in its row, and visited depth first then, since the replayer has kept only the last surfaces.
void Session::Impl::prefetch_surfaces() {
    const auto state = std::make_shared<Prefetch>();
    state->replayer = replayer_;
    for (const TreeRow& row : document_.tree.rows) {
        if (!row.centroid) state->undescribed.insert(row.id);
        if (replayer_->trace()->holds_regions(row.id)) continue;
        if (!row.centroid || !store_.holds({Store::Kind::surface, row.id})) state->nodes.push_back(row.id);
    }
    std::reverse(state->nodes.begin(), state->nodes.end());
    const auto next = [this, state]() -> Loader::Completion {
        if (state->nodes.empty()) return {};
        const NodeId node = state->nodes.back();
        state->nodes.pop_back();
        const std::shared_ptr<const Surface> surface = state->replayer->surface(node);
        Loader::Completion fill;
        if (state->undescribed.contains(node))
            fill = fill_row(node, surface->vertex_count(), surface->facet_count(), mass_properties(*surface));
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
            if (!store_.holds(key)) store_.insert(key, value, bytes);
            if (fill) fill();
        };
    };
    for (std::size_t i = state->nodes.size(); i > 0; --i) loader_.post_idle({data_.scope, next, {}});
}

}  // namespace kerf::view

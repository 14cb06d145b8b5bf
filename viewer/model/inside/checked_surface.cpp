#include "viewer/model/inside/checked_surface.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "run/prepare/slivers.h"
#include "run/request/run_request.h"
#include "viewer/model/inside/node_surface.h"

namespace kerf::view {

namespace {

OrientedSurface orient_copy(CheckedSoup checked) {
    apply_repairs(checked);
    Complex complex = make_complex(std::move(checked.soup));
    OrientedSurface oriented{complex.vertex_count(), complex.facet_count()};
    if (complex.region_count() == 1) {
        oriented.mass = mass_properties(complex.take_only_region());
        oriented.volume = oriented.mass->volume;
        return oriented;
    }
    for (const RegionIndex r : ids<RegionIndex>(complex.region_count()))
        oriented.volume += enclosed_volume(complex.surface_of(r));
    oriented.region_names.assign(complex.region_names().begin(), complex.region_names().end());
    return oriented;
}

// Surfaces of CAD models are remeshed without being asked.
std::string note_of_slivers(const CheckedSoup& checked, const std::string& path) {
    const Soup& soup = checked.soup;
    return soup.is_of_model ? ""
                            : sliver_note(find_slivers(soup.vertices, soup.facets),
                                          fmt::format("kerf mesh {} --surface remesh", path));
}

// Coordinates that are no numbers are equal to themselves here.
bool is_same_surface(const Soup& a, const Soup& b) {
    const auto same_point = [](const Vec3& p, const Vec3& q) { return p == q || (!p.allFinite() && !q.allFinite()); };
    return a.facets == b.facets &&
           std::equal(a.vertices.begin(), a.vertices.end(), b.vertices.begin(), b.vertices.end(), same_point);
}

}  // namespace

bool same_input(InputOptions a, InputOptions b) {
    const std::vector<OptionField> of_a = input_option_fields(a), of_b = input_option_fields(b);
    return a.wrap == b.wrap &&
           std::equal(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(),
                      [](const OptionField& x, const OptionField& y) { return x.text() == y.text(); });
}

CheckedSurface check_surface(const InputFiles& files, const InputOptions& options, const std::string& path,
                             const CheckedSoup* unrepaired, const std::function<void()>& check_cancelled) {
    constexpr double needle_angle_deg = 1;
    auto checked_soup =
        std::make_shared<const CheckedSoup>(check_files(files, options, needle_angle_deg, check_cancelled));
    CheckedSurface state{options, std::move(checked_soup), nullptr, {}, ""};
    const CheckedSoup& checked = *state.checked;
    if (unrepaired && !is_same_surface(checked.soup, unrepaired->soup))
        state.surface = std::make_shared<const NodeSurface>(node_surface_of(checked.soup));
    if (check_cancelled) check_cancelled();
    if (!checked.diagnosis.clean()) return state;
    state.oriented = orient_copy(checked);
    state.note = note_of_slivers(checked, path);
    return state;
}

void RepairHistory::begin(CheckedSurface unrepaired) {
    clear();
    states_.push_back(std::move(unrepaired));
}

void RepairHistory::add(CheckedSurface state) {
    states_.erase(states_.begin() + std::min(shown_ + 1, states_.size()), states_.end());
    states_.push_back(std::move(state));
    shown_ = states_.size() - 1;
}

void RepairHistory::clear() {
    states_.clear();
    shown_ = 0;
}

}  // namespace kerf::view

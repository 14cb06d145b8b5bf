#include "surface/defect.h"

#include <algorithm>

#include <fmt/format.h>

namespace kerf {

namespace {

// "facet 3", "vertices 4, 7": at most four numbers.
std::string list(const char* one, const char* many, const std::vector<std::int32_t>& numbers) {
    constexpr std::size_t limit = 4;
    if (numbers.size() == 1) return fmt::format("{} {}", one, numbers[0]);
    const auto end = numbers.begin() + static_cast<std::ptrdiff_t>(std::min(limit, numbers.size()));
    return fmt::format("{} {}{}", many, fmt::join(numbers.begin(), end, ", "), numbers.size() > limit ? ", ..." : "");
}

// The corners of a facet say nothing that its number does not say.
bool are_vertices_told(const Defect& defect) {
    return !defect.vertices.empty() && (defect.facets.empty() || defect.vertices.size() < 3);
}

ErrorElements elements_at(const Defect& defect, ElementKind kind, const std::vector<std::int32_t>& ids) {
    return {kind, {ids.begin(), ids.end()}, {{defect.where.x(), defect.where.y(), defect.where.z()}}, {}};
}

}  // namespace

const char* name(DefectKind kind) {
    switch (kind) {
        case DefectKind::empty:
            return "empty surface";
        case DefectKind::non_finite:
            return "non-finite vertex";
        case DefectKind::absurd_magnitude:
            return "absurd magnitude";
        case DefectKind::unfit_polygon:
            return "unfit polygon";
        case DefectKind::flat:
            return "flat surface";
        case DefectKind::degenerate_facet:
            return "degenerate facet";
        case DefectKind::duplicate_facet:
            return "duplicate facet";
        case DefectKind::coincident_shell:
            return "coincident shell";
        case DefectKind::open_edge:
            return "open edge loop";
        case DefectKind::non_manifold_edge:
            return "non-manifold edge";
        case DefectKind::non_manifold_vertex:
            return "non-manifold vertex";
        case DefectKind::inconsistent_orientation:
            return "inconsistent orientation";
        case DefectKind::one_sided:
            return "one-sided shell";
        case DefectKind::inverted_shell:
            return "inverted shell";
        case DefectKind::ambiguous_shell:
            return "ambiguous shell";
        case DefectKind::touching_shells:
            return "touching shell";
        case DefectKind::self_intersection:
            return "self-intersection";
        case DefectKind::needle:
            return "needle";
        case DefectKind::short_edge:
            return "short edge";
    }
    return "";
}

const char* name(Severity severity) {
    switch (severity) {
        case Severity::error:
            return "error";
        case Severity::repaired:
            return "repaired";
        case Severity::warning:
            return "warning";
    }
    return "";
}

const char* remedy(const Defect& defect) {
    const bool repaired = defect.severity == Severity::repaired;
    switch (defect.kind) {
        case DefectKind::empty:
            return "export the surface again";
        case DefectKind::non_finite:
            return "correct the coordinates or export the surface again";
        case DefectKind::absurd_magnitude:
            return "choose another unit of length, so that coordinates lie between 1e-50 and 1e50";
        case DefectKind::unfit_polygon:
            return "export the surface as triangles: the faces are not planar or not convex";
        case DefectKind::flat:
            return "give the boundary of a body, not a sheet";
        case DefectKind::degenerate_facet:
            return repaired ? "nothing needs to be done, they are left out"
                            : "collapse or remove the facets where the surface was made";
        case DefectKind::duplicate_facet:
            return repaired ? "nothing needs to be done, the copies are left out" : "remove the copies";
        case DefectKind::coincident_shell:
            return "remove all copies of the body but one";
        case DefectKind::open_edge:
            return "close the holes, merge vertices that are nearly equal with --weld, fill small holes with "
                   "--fill-holes, or drop loose pieces with --keep-largest";
        case DefectKind::non_manifold_edge:
        case DefectKind::non_manifold_vertex:
            return "unite the bodies that touch there, or move them apart";
        case DefectKind::inconsistent_orientation:
            return "nothing needs to be done, they are turned";
        case DefectKind::one_sided:
            return "model the surface again, it bounds no body";
        case DefectKind::inverted_shell:
            return "nothing needs to be done, it is turned";
        case DefectKind::ambiguous_shell:
            return repaired ? "nothing needs to be done, it is made a void"
                            : "make it a void with --voids parity, turn it, or leave all out but the largest with "
                              "--keep-largest";
        case DefectKind::touching_shells:
            return "unite the bodies, move them apart, or leave all out but the largest with --keep-largest";
        case DefectKind::self_intersection:
            return "unite the parts that overlap where the surface was made";
        case DefectKind::needle:
            return "remesh the surface with --surface remesh where good cells are needed";
        case DefectKind::short_edge:
            return "move the part closer to the origin or collapse the edges";
    }
    return "";
}

std::string counted(std::int64_t n, DefectKind kind) {
    std::string noun = name(kind);
    if (n != 1 && noun.ends_with("vertex")) noun.replace(noun.size() - 2, 2, "ice");
    return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s");
}

std::string place(const Defect& defect, const Soup& soup) {
    std::string text;
    if (!defect.facets.empty()) text = list("facet", "facets", soup.file_facets(defect.facets));
    if (are_vertices_told(defect))
        text += (text.empty() ? "" : ", ") + list("vertex", "vertices", soup.file_vertices(defect.vertices));
    return fmt::format("{} near ({:.9g}, {:.9g}, {:.9g})", text, defect.where.x(), defect.where.y(), defect.where.z());
}

std::vector<ErrorElements> elements_of(const Defect& defect, const Soup& soup) {
    std::vector<ErrorElements> elements;
    if (!defect.facets.empty()) {
        ErrorElements& facets =
            elements.emplace_back(elements_at(defect, ElementKind::facet, soup.file_facets(defect.facets)));
        for (const std::int32_t f : defect.facets)
            facets.names.push_back(soup.patch_names[static_cast<std::size_t>(soup.patch[static_cast<std::size_t>(f)])]);
        std::sort(facets.names.begin(), facets.names.end());
        facets.names.erase(std::unique(facets.names.begin(), facets.names.end()), facets.names.end());
    }
    const bool is_edge = defect.kind == DefectKind::non_manifold_edge || defect.kind == DefectKind::short_edge;
    if (are_vertices_told(defect))
        elements.push_back(elements_at(defect, is_edge ? ElementKind::edge : ElementKind::vertex,
                                       soup.file_vertices(defect.vertices)));
    return elements;
}

}  // namespace kerf

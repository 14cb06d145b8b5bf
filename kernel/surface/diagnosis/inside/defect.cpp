// The texts of defects. All kinds are rows of `texts_of_kinds`, in the order of DefectKind: the noun, of which
// counted() makes the plural, the advice, and a second advice for defects that repairs mend. The advice follows a colon
// in sentences like "The surface has 3 open edge loops, the first at ...: close the holes", so it begins in lower case
// and ends without a full stop; options that it names become buttons in the viewer.
#include "surface/diagnosis/inside/defect.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

namespace kerf {

namespace {

// "facet 3", "vertices 4, 7": at most four numbers.
std::string list(const char* one, const char* many, const std::vector<std::int32_t>& numbers) {
    constexpr std::size_t limit = 4;
    if (numbers.size() == 1) return fmt::format("{} {}", one, numbers[0]);
    const auto end = numbers.begin() + std::min(limit, numbers.size());
    return fmt::format("{} {}{}", many, fmt::join(numbers.begin(), end, ", "), numbers.size() > limit ? ", ..." : "");
}

struct KindTexts {
    const char* name;
    const char* advice;
    const char* when_repaired = nullptr;  // the other advice, where there is one
};

constexpr std::array<KindTexts, defect_kind_count> texts_of_kinds = {{
    {"empty surface", "export the surface again"},
    {"non-finite vertex", "correct the coordinates or export the surface again"},
    {"absurd magnitude", "choose another unit of length, so that coordinates lie between 1e-50 and 1e50"},
    {"unfit polygon", "export the surface as triangles: the faces are not planar or not convex"},
    {"flat surface", "give the boundary of a body, not a sheet; --repair thicken makes a wall of a sheet"},
    {"degenerate facet", "collapse or remove the facets where the surface was made, or with --repair clean",
     "nothing needs to be done, they are left out"},
    {"duplicate facet", "remove the copies, as --repair clean does",
     "nothing needs to be done, the copies are left out"},
    {"coincident shell", "remove all copies of the body but one, as --repair clean does"},
    {"open edge loop",
     "close the holes, as --repair stitch,holes does, merge vertices that are nearly equal with --weld, fill small "
     "holes with --fill-holes, or drop loose pieces with --keep-largest"},
    {"non-manifold edge", "unite the bodies that touch there, move them apart, or part them with --repair manifold"},
    {"non-manifold vertex", "unite the bodies that touch there, move them apart, or part them with --repair manifold"},
    {"inconsistent orientation", "nothing needs to be done, they are turned"},
    {"one-sided shell", "model the surface again, it bounds no body"},
    {"inverted shell", "nothing needs to be done, it is turned"},
    {"ambiguous shell",
     "make it a void with --voids parity, a region with --fill-voids, or one with a name by --region NAME=x,y,z with a "
     "point in it and one for what is around it; unite it with the other by --repair intersections, or keep the "
     "largest alone with --keep-largest",
     "nothing needs to be done, it is made a void"},
    {"touching shell",
     "unite the bodies, as --repair intersections does, move them apart, or leave all out but the largest with "
     "--keep-largest"},
    {"self-intersection", "unite the parts that overlap where the surface was made, or with --repair intersections"},
    {"needle",
     "kerf mesh remeshes CAD files, and others where needles would spoil cells; --surface remesh remeshes any file"},
    {"short edge", "move the part closer to the origin or collapse the edges"},
    {"wall of unlike facets",
     "give both bodies the same triangles where they touch, as solids of one CAD file have them, or merge vertices "
     "that are nearly equal with --weld or --repair snap"},
    {"overlap of bodies",
     "cut one body out of the other where they were made; where their triangles are the same but for a small distance, "
     "merge their vertices with --weld or --repair snap"},
    {"gap between bodies",
     "where their triangles are the same but for that distance, merge their vertices with --weld or --repair snap, "
     "else give both the "
     "same triangles; bodies that do not touch can be meshed each by itself"},
}};
static_assert(texts_of_kinds.back().name != nullptr);

const KindTexts& texts_of(DefectKind kind) { return texts_of_kinds[static_cast<std::size_t>(kind)]; }

// The corners of a facet say nothing that its number does not say.
bool are_vertices_told(const Defect& defect) {
    return !defect.vertices.empty() && (defect.facets.empty() || defect.vertices.size() < 3);
}

// " of 'bone' and 'cement', up to 0.01 apart".
std::string bodies_text(const Defect& defect) {
    if (defect.bodies.empty()) return "";
    const std::string text = fmt::format(" of '{}'", fmt::join(defect.bodies, "' and '"));
    if (!is_between_bodies(defect) || defect.measure == 0) return text;
    return fmt::format("{}, up to {:.6g} {}", text, defect.measure,
                       defect.kind == DefectKind::body_overlap ? "deep" : "apart");
}

ErrorElements elements_at(const Defect& defect, ElementKind kind, const std::vector<std::int32_t>& ids) {
    return {kind, {ids.begin(), ids.end()}, {{defect.where.x(), defect.where.y(), defect.where.z()}}, {}};
}

}  // namespace

const char* name(DefectKind kind) { return texts_of(kind).name; }

const char* name(Severity severity) {
    constexpr std::array names = {"error", "repaired", "warning"};
    static_assert(names.size() == static_cast<std::size_t>(Severity::warning) + 1);
    return names[static_cast<std::size_t>(severity)];
}

const char* advice(const Defect& defect) {
    const KindTexts& texts = texts_of(defect.kind);
    return defect.severity == Severity::repaired && texts.when_repaired ? texts.when_repaired : texts.advice;
}

bool is_between_bodies(const Defect& defect) {
    return defect.kind == DefectKind::unlike_walls || defect.kind == DefectKind::body_overlap ||
           defect.kind == DefectKind::body_gap;
}

void sort_defects(std::vector<Defect>& defects) {
    const auto first_facet = [](const Defect& d) { return d.facets.empty() ? -1 : d.facets.front(); };
    std::stable_sort(defects.begin(), defects.end(), [&](const Defect& a, const Defect& b) {
        return std::pair(a.kind, first_facet(a)) < std::pair(b.kind, first_facet(b));
    });
}

std::string counted(std::int64_t n, DefectKind kind) {
    std::string noun = name(kind);
    if (n == 1) return fmt::format("1 {}", noun);
    if (noun.ends_with("vertex")) noun.replace(noun.size() - 2, 2, "ice");
    const std::size_t end = std::min({noun.size(), noun.find(" of "), noun.find(" between ")});  // of the noun itself
    return fmt::format("{} {}s{}", n, noun.substr(0, end), noun.substr(end));
}

std::string place(const Defect& defect, const Soup& soup) {
    std::string text;
    if (!defect.facets.empty()) text = list("facet", "facets", soup.file_facets(defect.facets));
    if (are_vertices_told(defect))
        text += (text.empty() ? "" : ", ") + list("vertex", "vertices", soup.file_vertices(defect.vertices));
    return fmt::format("{}{} near ({:.9g}, {:.9g}, {:.9g})", text, bodies_text(defect), defect.where.x(),
                       defect.where.y(), defect.where.z());
}

std::vector<ErrorElements> elements_of(const Defect& defect, const Soup& soup) {
    std::vector<ErrorElements> elements;
    if (!defect.facets.empty()) {
        ErrorElements& facets =
            elements.emplace_back(elements_at(defect, ElementKind::facet, soup.file_facets(defect.facets)));
        for (const std::int32_t f : defect.facets) facets.names.push_back(soup.patch_names[soup.patch[f]]);
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

// TetGen is not invariant to scale and place, so it gets coordinates x' = (x - c) / h. The unit h is the power of two
// above the longest side of the bounding box, and c the centre of the box, rounded towards zero to a multiple of h.
// Then no bit of x is lost: where |c| < h nothing is subtracted, elsewhere x and c differ by less than 1.5 h while both
// are at least h / 2, and the difference of such numbers is exact.
//
// Vertex i of TetGen's input is vertex order[i] of the surface. Switch J keeps all of them in place in the output,
// which is checked bit by bit; Steiner points follow. TetGen's tetrahedra have the orientation of TetMesh.
#include "fill/volume/inside/tetgen_adapter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "base/core/error.h"
#include "base/core/ids.h"
#include "base/geometry/box.h"

// The packaged terminatetetgen() frees memory that is freed again while its exception unwinds. It is a weak symbol, and
// the definition below takes its place also inside the library.
#define TETLIBRARY
#define terminatetetgen packaged_terminatetetgen
#include <tetgen.h>
#undef terminatetetgen

void terminatetetgen(tetgenmesh*, int code) { throw code; }

namespace kerf {

namespace {

static_assert(sizeof(int) == sizeof(std::int32_t));

struct Normalisation {
    Vec3 centre;   // c
    int exponent;  // h = 2^exponent

    explicit Normalisation(const std::vector<Vec3>& vertices) {
        const Box box = box_around(vertices);
        std::frexp(box.sizes().maxCoeff(), &exponent);
        const double unit = std::ldexp(1.0, exponent);
        centre = (box.center() / unit).unaryExpr([](double x) { return std::trunc(x); }) * unit;
    }
    Vec3 to_unit(const Vec3& p) const { return scaled(p - centre, -exponent); }
    Vec3 from_unit(const Vec3& p) const { return scaled(p, exponent) + centre; }
    double length_from_unit(double length) const { return std::ldexp(length, exponent); }
    double volume_to_unit(double volume) const { return std::ldexp(volume, -3 * exponent); }

 private:
    static Vec3 scaled(const Vec3& p, int e) {
        return {std::ldexp(p.x(), e), std::ldexp(p.y(), e), std::ldexp(p.z(), e)};
    }
};

// Fisher-Yates; std::shuffle differs between standard libraries.
std::vector<std::int32_t> shuffled_order(std::size_t count, std::mt19937& random) {
    std::vector<std::int32_t> order(count);
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random() % i]);
    return order;
}

// The vertices and facets of the surface in the order of TetGen's numbers.
struct InputOrder {
    std::vector<std::int32_t> vertices;
    std::vector<std::int32_t> facets;

    InputOrder(const SurfaceArrays& surface, std::uint32_t seed)
        : vertices(surface.vertices.size()), facets(surface.facets.size()) {
        std::mt19937 random(seed);
        if (seed != 0) {
            vertices = shuffled_order(vertices.size(), random);
            facets = shuffled_order(facets.size(), random);
        } else {
            std::iota(vertices.begin(), vertices.end(), 0);
            std::iota(facets.begin(), facets.end(), 0);
        }
    }
};

// Copies points into an array that TetGen will delete.
REAL* new_point_list(const std::vector<Vec3>& points) {
    REAL* const list = new REAL[3 * points.size()];
    for (std::size_t i = 0; i < points.size(); ++i) std::copy_n(points[i].data(), 3, list + 3 * i);
    return list;
}

void set_points(tetgenio& in, const SurfaceArrays& surface, const std::vector<std::int32_t>& order,
                const Normalisation& frame) {
    std::vector<Vec3> points;
    points.reserve(order.size());
    for (std::int32_t v : order) points.push_back(frame.to_unit(surface.vertices[v]));
    in.numberofpoints = count_of(points);
    in.pointlist = new_point_list(points);
}

void set_facets(tetgenio& in, const SurfaceArrays& surface, const InputOrder& order) {
    std::vector<std::int32_t> number(order.vertices.size());
    for (std::size_t i = 0; i < number.size(); ++i) number[order.vertices[i]] = i;
    in.facetlist = new tetgenio::facet[order.facets.size()];
    for (std::int32_t f : order.facets) {
        tetgenio::facet& facet = in.facetlist[in.numberoffacets++];
        tetgenio::init(&facet);
        facet.polygonlist = new tetgenio::polygon[1];
        facet.numberofpolygons = 1;
        tetgenio::init(&facet.polygonlist[0]);
        const auto& [a, b, c] = surface.facets[f];
        facet.polygonlist[0].vertexlist = new int[3]{number[a], number[b], number[c]};
        facet.polygonlist[0].numberofvertices = 3;
    }
}

void set_holes(tetgenio& in, std::vector<Vec3> holes, const Normalisation& frame) {
    for (Vec3& p : holes) p = frame.to_unit(p);
    in.numberofholes = count_of(holes);
    in.holelist = new_point_list(holes);
}

constexpr std::string_view expert_letters = "qaSTODMCVX";

[[noreturn]] void refuse_switches(const std::string& switches) {
    throw Error(
        ErrorCode::usage,
        fmt::format(
            "--tetgen-switches is \"{}\", which cannot be used. Of TetGen's switches those of a linear mesh inside "
            "of the surface are left to choose: {}, each with its numbers. See TetGen's manual.",
            switches, expert_letters));
}

// p: fill a surface, Y: keep it, J: keep all vertices, Q: quiet. Bounds are set as numbers, because the switches know
// no exponents. Neighbours, switch n, are not asked for: TetGen would list them while its own memory is at its largest.
tetgenbehavior parse_switches(const MesherOptions& options) {
    const bool refine = !options.size.is_empty() || options.radius_edge > 0;
    const std::string& expert = options.tetgen.switches;
    std::string switches = "pYJQ" + (!expert.empty() ? expert : refine ? "q" : "");
    tetgenbehavior behaviour;
    if (switches.size() >= sizeof behaviour.commandline - 2 || !behaviour.parse_commandline(switches.data()) ||
        behaviour.refine || behaviour.order != 1 || behaviour.reversetetori)
        refuse_switches(expert);
    return behaviour;
}

tetgenbehavior behaviour_of(const MesherOptions& options, const Normalisation& frame) {
    tetgenbehavior behaviour = parse_switches(options);
    if (options.tetgen.switches.empty()) {
        behaviour.minratio = options.radius_edge;
        behaviour.fixedvolume = !options.size.is_empty() && options.size.is_constant();
        behaviour.maxvolume = options.size.reference_volume();
    }
    if (options.tetgen.tolerance > 0) behaviour.epsilon = options.tetgen.tolerance;
    if (behaviour.fixedvolume) behaviour.maxvolume = frame.volume_to_unit(behaviour.maxvolume);
    return behaviour;
}

// The field that is_unsuitable() asks: TetGen calls a plain function, to which no argument can be given. It is not
// thread-safe anyway.
struct AskedField {
    const SizeField& size;
    const Normalisation& frame;
};
const AskedField* asked_field = nullptr;

// Whether a tetrahedron, in TetGen's coordinates, is too large.
bool is_unsuitable(REAL* p, REAL* q, REAL* r, REAL* s, REAL*, REAL) {
    const auto point = [](const REAL* x) { return asked_field->frame.from_unit(Eigen::Map<const Vec3>(x)); };
    return is_too_large(asked_field->size, {point(p), point(q), point(r), point(s)});
}

[[noreturn]] void throw_failure(int code) {
    const auto reason = [&] {
        switch (code) {
            case 1:
                return "it ran out of memory; raise the memory limit, or use more parts or a coarser size";
            case 3:
                return "it found facets that intersect; check the surface for self-intersections";
            case 4:
                return "it met a very small feature; another order of the vertices or a smaller tolerance (-T) may "
                       "help";
            case 5:
                return "it met two facets that almost touch; another order of the vertices or a smaller tolerance "
                       "(-T) may help";
            case 10:
                return "it does not accept the surface; check that it is closed and not degenerate";
            default:
                return "it failed inside; another order of the vertices often helps";
        }
    }();
    throw Error(code == 1 ? ErrorCode::memory : ErrorCode::subdomain,
                fmt::format("TetGen stopped with code {}: {}.", code, reason));
}

void run(tetgenbehavior& behaviour, tetgenio& in, tetgenio& out) {
    try {
        tetrahedralize(&behaviour, &in, &out);
    } catch (int code) {
        throw_failure(code);
    }
    if (out.numberoftetrahedra == 0)
        throw Error(ErrorCode::subdomain,
                    "TetGen returned no tetrahedra, as it does for a surface that is open: check that it is closed.");
}

void check_vertices_kept(const tetgenio& in, const tetgenio& out, const std::vector<std::int32_t>& order) {
    const REAL* const end =
        in.pointlist + 3 * static_cast<std::size_t>(std::min(in.numberofpoints, out.numberofpoints));
    const auto changed = std::mismatch(static_cast<const REAL*>(in.pointlist), end, out.pointlist).first;
    const std::size_t kept = (changed - in.pointlist) / 3;
    if (kept < order.size())
        throw Error(ErrorCode::subdomain,
                    fmt::format("TetGen moved or dropped vertex {} of the surface. Another order of the vertices, or "
                                "merging vertices that coincide, may help.",
                                order[kept]));
}

// Frees a list of TetGen as soon as it is copied.
void drop(REAL*& list) { delete[] std::exchange(list, nullptr); }
void drop(int*& list) { delete[] std::exchange(list, nullptr); }

TetMesh to_mesh(tetgenio& out, const SurfaceArrays& surface, const std::vector<std::int32_t>& order,
                const Normalisation& frame) {
    TetMesh mesh;
    mesh.vertices.reserve(out.numberofpoints);
    mesh.vertices = surface.vertices;
    mesh.boundary_vertex_count = count_of(surface.vertices);
    for (std::int32_t v = mesh.boundary_vertex_count; v < out.numberofpoints; ++v)
        mesh.vertices.push_back(frame.from_unit(Eigen::Map<const Vec3>(out.pointlist + 3 * std::size_t(v))));
    drop(out.pointlist);
    mesh.tets.resize(out.numberoftetrahedra);
    for (std::size_t t = 0; t < mesh.tets.size(); ++t)
        for (std::size_t i = 0; i < 4; ++i) {
            const std::int32_t v = out.tetrahedronlist[4 * t + i];
            mesh.tets[t][i] = v < mesh.boundary_vertex_count ? order[v] : v;
        }
    drop(out.tetrahedronlist);
    return mesh;
}

}  // namespace

void check_tetgen_switches(const std::string& switches) {
    if (switches.find_first_not_of(std::string(expert_letters) + "0123456789./") != switches.npos)
        refuse_switches(switches);
    MesherOptions options;
    options.tetgen.switches = switches;
    parse_switches(options);
}

TetMesh mesh_with_tetgen(const SurfaceArrays& surface, const std::vector<Vec3>& holes, const MesherOptions& options) {
    const Normalisation frame(surface.vertices);
    const InputOrder order(surface, options.tetgen.shuffle);
    tetgenbehavior behaviour = behaviour_of(options, frame);
    tetgenio in, out;
    set_points(in, surface, order.vertices, frame);
    set_facets(in, surface, order);
    set_holes(in, holes, frame);
    const AskedField asked{options.size, frame};
    if (options.tetgen.switches.empty() && !options.size.is_constant()) {
        asked_field = &asked;
        in.tetunsuitable = is_unsuitable;
    }
    run(behaviour, in, out);
    check_vertices_kept(in, out, order.vertices);
    return to_mesh(out, surface, order.vertices, frame);
}

}  // namespace kerf

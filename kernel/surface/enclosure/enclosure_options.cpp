// Texts become a box with a place: multiples are of the longest side of the box around the bodies, the ground replaces
// the low end of its axis, and names of faces follow from the wind. Each text has one parser, which check() calls for
// its errors alone.
#include "surface/enclosure/enclosure_options.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/types.h"

namespace kerf {

namespace {

constexpr const char* axis_names = "xyz";
constexpr double share_of_longest_side = 0.05;  // edges on the faces, where no length is given
constexpr double wake_lengths = 2, wake_widening = 0.25;
constexpr double most_facets_of_box = 5e7;

int axis_of(Wind wind) { return static_cast<int>(wind) / 2; }
bool is_upwards(Wind wind) { return static_cast<int>(wind) % 2 == 0; }

// A plane across an axis.
struct Plane {
    int axis = 2;
    double at = 0;
};

Plane ground_of(const std::string& text) {
    std::string_view number = text;
    Plane plane;
    const std::size_t axis = std::string_view(axis_names).find(text.empty() ? ' ' : text[0]);
    if (text.size() > 2 && axis != std::string_view::npos && text[1] == '=') {
        plane.axis = static_cast<int>(axis);
        number.remove_prefix(2);
    }
    const std::optional<double> at = number_in<double>(number);
    if (!at)
        throw Error(ErrorCode::usage, fmt::format("--ground is '{}', but it must be the height of a plane, such as "
                                                  "-0.32 for z = -0.32, or y=-0.32.",
                                                  text));
    plane.at = *at;
    return plane;
}

// Six coordinates, or three multiples of which none is negative.
std::vector<double> numbers_of_box(const std::string& text) {
    const std::vector<double> numbers = numbers_in(text);
    const bool are_multiples =
        numbers.size() == 3 && std::all_of(numbers.begin(), numbers.end(), [](double n) { return n >= 0; });
    if (numbers.size() != 6 && !are_multiples)
        throw Error(
            ErrorCode::usage,
            fmt::format("--box is '{}', but it must be x0,y0,z0,x1,y1,z1, two corners in units of the input, or "
                        "UPSTREAM,SIDES,DOWNSTREAM, distances in multiples of the longest side of the body, "
                        "such as 3,3,8.",
                        text));
    return numbers;
}

Box box_of(const std::vector<double>& numbers, const Box& bodies, Wind wind) {
    if (numbers.size() == 6) {
        const Vec3 a(numbers[0], numbers[1], numbers[2]), b(numbers[3], numbers[4], numbers[5]);
        return {a.cwiseMin(b), a.cwiseMax(b)};
    }
    const double unit = bodies.sizes().maxCoeff();
    Vec3 low = Vec3::Constant(numbers[1] * unit), high = low;
    const int axis = axis_of(wind);
    low[axis] = numbers[is_upwards(wind) ? 0 : 2] * unit;
    high[axis] = numbers[is_upwards(wind) ? 2 : 0] * unit;
    return {bodies.min() - low, bodies.max() + high};
}

std::array<std::array<std::string, 2>, 3> names_of_faces(Wind wind, const std::optional<Plane>& ground) {
    std::array<std::array<std::string, 2>, 3> names;
    for (int axis = 0; axis < 3; ++axis)
        names[axis] = {fmt::format("side_{}_min", axis_names[axis]), fmt::format("side_{}_max", axis_names[axis])};
    names[axis_of(wind)] = {"inlet", "outlet"};
    if (!is_upwards(wind)) std::swap(names[axis_of(wind)][0], names[axis_of(wind)][1]);
    if (ground) names[ground->axis][0] = Enclosure::ground;
    return names;
}

Box wake_of(const Box& bodies, const Box& air, Wind wind) {
    const int axis = axis_of(wind);
    const Vec3 more = wake_widening * bodies.sizes();
    Box wake(bodies.min() - more, bodies.max() + more);
    const double length = wake_lengths * bodies.sizes().maxCoeff(), middle = bodies.center()[axis];
    wake.min()[axis] = is_upwards(wind) ? middle : bodies.min()[axis] - length;
    wake.max()[axis] = is_upwards(wind) ? bodies.max()[axis] + length : middle;
    return wake.intersection(air);
}

void refuse_facets(const Enclosure& placed) {
    const Vec3 n = placed.box.sizes() / placed.edge;
    const double facets = 4 * (n.x() * n.y() + n.y() * n.z() + n.z() * n.x());
    if (facets > most_facets_of_box)
        throw Error(ErrorCode::usage,
                    fmt::format("The box would have {:.2g} facets with edges of {:.3g}. Give a larger --box-size.",
                                facets, placed.edge));
}

}  // namespace

bool Enclosure::has_face(const std::string& patch) const {
    return std::any_of(face_names.begin(), face_names.end(),
                       [&](const auto& ends) { return std::find(ends.begin(), ends.end(), patch) != ends.end(); });
}

void EnclosureOptions::check() const {
    require_in(air_edge_range, "box-size", edge.number());
    require_in(air_edge_range, "wake", wake.number());
    if (encloses()) {
        numbers_of_box(box);
        if (!ground.empty() && ground_of(ground).axis == axis_of(wind))
            throw Error(ErrorCode::usage, fmt::format("--ground is {}, but the wind blows along that axis. Choose the "
                                                      "other with --wind, as x, -x or y.",
                                                      ground));
        return;
    }
    const EnclosureOptions none;
    const auto refuse = [](const char* option) {
        throw Error(ErrorCode::usage,
                    fmt::format("--{} is for a box of air around the body. Give --box, too, or leave it out.", option));
    };
    if (wind != none.wind) refuse("wind");
    if (!ground.empty()) refuse("ground");
    if (edge.number() > 0) refuse("box-size");
    if (wake.number() > 0) refuse("wake");
}

Enclosure enclosure_around(const Box& bodies, const EnclosureOptions& options) {
    options.check();
    Enclosure placed;
    placed.bodies = bodies;
    placed.box = box_of(numbers_of_box(options.box), bodies, options.wind);
    std::optional<Plane> ground;
    if (!options.ground.empty()) {
        ground = ground_of(options.ground);
        placed.box.min()[ground->axis] = ground->at;
    }
    if (!(placed.box.sizes().minCoeff() > 0))
        throw Error(
            ErrorCode::usage,
            fmt::format("--box {}{} is a box from ({:.6g}) to ({:.6g}), which has no volume. The body lies from "
                        "({:.6g}) to ({:.6g}).",
                        options.box, ground ? fmt::format(" with --ground {}", options.ground) : "",
                        fmt::join(placed.box.min(), ", "), fmt::join(placed.box.max(), ", "),
                        fmt::join(bodies.min(), ", "), fmt::join(bodies.max(), ", ")));
    placed.face_names = names_of_faces(options.wind, ground);
    const double edge = options.edge.of(placed.diagonal());
    placed.edge = edge > 0 ? edge : share_of_longest_side * placed.box.sizes().maxCoeff();
    refuse_facets(placed);
    if (options.wake.number() > 0) {
        placed.wake = wake_of(bodies, placed.box, options.wind);
        placed.wake_edge = options.wake.of(placed.diagonal());
        if (placed.wake->isEmpty() || !(placed.wake->sizes().minCoeff() > 0))
            throw Error(ErrorCode::usage,
                        "--wake is for the space behind the body, but none of it is in the box. Make "
                        "the box longer, or leave it out.");
    }
    return placed;
}

}  // namespace kerf

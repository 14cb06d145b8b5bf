// The elements of one of Gmsh's files, one by one.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "files/io/inside/gmsh_model.h"
#include "files/io/inside/gmsh_sides.h"
#include "files/io/inside/gmsh_source.h"
#include "files/io/soup_builder.h"

namespace kerf::gmsh {

enum class Shape { point, line, triangle, quadrangle, tetrahedron, hexahedron, prism, pyramid, unknown };

struct ElementType {
    Shape shape = Shape::unknown;
    std::int64_t nodes = 0;
};

/// Takes the elements one by one: faces and tetrahedra, with their corners alone where the order is higher. All other
/// elements are only counted.
class Elements {
 public:
    Elements(Source& source, SoupBuilder& builder, const Model& model)
        : source_(source), builder_(builder), model_(model) {}

    /// The elements that follow are of this type.
    void set_type(std::int64_t number);
    /// Announces so many elements of the current type, before they are read.
    void announce(std::int64_t count) const {
        if (is_face()) builder_.announce_facets(count);
    }
    void set_patch(std::int64_t group, std::int64_t entity);
    /// Reads the nodes of one element.
    template <class NextNode>
    void read(std::int64_t tag, const NextNode& next_node) {
        ++counts_[static_cast<std::size_t>(type_.shape)];
        last_corners_.swap(corners_);
        corners_.clear();
        const std::int64_t corners = is_taken() ? corner_count() : 0;
        for (std::int64_t i = 0; i < type_.nodes; ++i) {
            const std::int64_t node = next_node();
            if (i < corners) corners_.push_back(to_vertex(tag, node));
        }
        if (is_taken() && !repeats_last()) add_element();
    }
    /// Ends the elements: notes those that were ignored, and gives the builder the names of volumes and the sides of
    /// surfaces, which only all elements tell.
    void finish() const;

 private:
    void note_ignored() const;
    bool is_face() const { return type_.shape == Shape::triangle || type_.shape == Shape::quadrangle; }
    bool is_taken() const { return is_face() || type_.shape == Shape::tetrahedron; }
    /// Returns the number of corners of an element that is taken; they are its first nodes.
    std::int64_t corner_count() const { return type_.shape == Shape::triangle ? 3 : 4; }
    // MSH 2 writes an element of several groups once for each, one directly behind the other.
    bool repeats_last() const {
        return corners_ == last_corners_ && patch_.second == last_patch_.second && patch_.first != last_patch_.first;
    }
    void add_element();
    std::int32_t volume();
    const std::int64_t* find_vertex(std::int64_t node) const;
    std::int64_t to_vertex(std::int64_t element, std::int64_t node) const;

    Source& source_;
    SoupBuilder& builder_;
    const Model& model_;
    ElementType type_;
    std::pair<std::int64_t, std::int64_t> patch_ = {-1, -1}, last_patch_ = {-1, -1};  // group, entity
    std::int32_t volume_ = -1;                          // number of the volume of patch_; -1: not known yet
    std::vector<SurfaceRun> surfaces_;                  // runs of faces by their surface
    std::vector<std::int64_t> corners_, last_corners_;  // corners of this element, and of the last one
    std::array<std::int64_t, static_cast<std::size_t>(Shape::unknown)> counts_{};
};

}  // namespace kerf::gmsh

// The meaning of colours in a scene: the scale of values, and words.
#pragma once

#include <set>

#include "viewer/scene/inside/layer_sink.h"

namespace kerf::view {

/// Sets Scene::scale, and the members of the legend that tell of it.
class ScaleMaker {
 public:
    ScaleMaker(const SceneContext& context, LayerSink& sink, BuiltScene& built)
        : context_(context), sink_(sink), built_(built) {}

    /// Sets the range by the view and by the distribution of all values of a run, where that is known.
    void begin();
    /// Sets the range by the values that are drawn, where begin() could not know it.
    void follow_layers();
    /// Adds points at the least and the largest value that are drawn, if the view asks for them.
    void mark_extremes();

 private:
    void set_range(const ValueRange& range);
    template <class Visit>
    void for_drawn_values(Visit visit) const;
    ValueRange range_of_most_values(const ValueRange& all);
    void follow(ValueRange drawn);

    const SceneContext& context_;
    LayerSink& sink_;
    BuiltScene& built_;
};

/// Explains the layers of a scene that is otherwise finished.
class LegendMaker {
 public:
    LegendMaker(const SceneContext& context, const Scene& scene, std::vector<NodeId> drawn_parts, Legend& legend)
        : context_(context), scene_(scene), drawn_parts_(std::move(drawn_parts)), legend_(legend) {}

    void run();

 private:
    std::string title_of_values() const;
    Color drawn_color_of(NodeId part) const;
    std::set<int> drawn_categories() const;
    std::set<std::int32_t> drawn_patches() const;
    void explain(const std::string& text, const Color& color, LegendEntry::Mark mark = LegendEntry::Mark::area);
    void explain_layer(const Layer* layer, const std::string& text, const Color& color);
    void explain_kind(LayerKind kind, const std::string& text, const Color& color) {
        explain_layer(scene_.find(kind), text, color);
    }
    void explain_origins();
    void explain_patches();
    void explain_regions();
    void explain_parts();
    void explain_coloring();
    void explain_axes();
    void explain_interfaces();

    const SceneContext& context_;
    const Scene& scene_;
    const std::vector<NodeId> drawn_parts_;
    Legend& legend_;
};

}  // namespace kerf::view

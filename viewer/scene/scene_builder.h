// Builds the scene that is drawn from the open document and the state of the view.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "viewer/model/session.h"
#include "viewer/model/view_state.h"
#include "viewer/scene/legend.h"

namespace kerf::view {

/// A scene with its legend and its boxes.
struct BuiltScene {
    Scene scene;
    Legend legend;
    Frame frame;
    Eigen::AlignedBox3d box;    ///< box of all that is drawn, moved parts included; coordinates of the file
    std::vector<Vec3> outline;  ///< outermost points of all that is drawn, by which it is fitted into the picture
    Eigen::AlignedBox3d left;   ///< box of the rest that the clip plane leaves of the body; empty without one
    bool pending = false;       ///< something is still being fetched: build again when it has arrived
};

/// Remembers geometry by a key that tells how it was made and the value that it was made from.
class GeometryCache {
 public:
    /// Returns the geometry that make() has made for this key and source, or makes it now. It is made anew if the
    /// source is another object than before.
    template <class Make>
    std::shared_ptr<const Geometry> get(const std::string& key, std::shared_ptr<const void> source, Make make) {
        Entry& entry = entries_[key];
        if (!entry.geometry || entry.source != source) {
            entry.geometry = make();
            entry.source = std::move(source);
            ++made_;
        }
        entry.last_use = now_;
        return entry.geometry;
    }

    /// Forgets the geometries that were not used for longest when there is much; called once per scene.
    void age();
    /// Returns the number of geometries that had to be made so far.
    std::int64_t made() const { return made_; }

 private:
    struct Entry {
        std::shared_ptr<const void> source;
        std::shared_ptr<const Geometry> geometry;
        std::int64_t last_use = 0;
    };
    std::map<std::string, Entry> entries_;
    std::int64_t now_ = 0, made_ = 0;
};

/// Makes the layers, of kinds (LayerKind) that suit step and view.
///
/// The scene is a function of state and document alone. Geometry that was drawn before costs no more than a look-up.
class SceneBuilder {
 public:
    BuiltScene build(const ViewState& state, Session& session);
    /// Returns the number of geometries that had to be made so far; it stays as it is when one goes back.
    std::int64_t geometry_made() const { return cache_.made(); }

 private:
    GeometryCache cache_;
};

/// Returns the offset of a part or half when the parts below `root` are pulled apart: a sum along the normals of the
/// cuts above the part, up to that of `root`. `explode` is Explosion::amount. Coordinates of the file.
Vec3 explosion_offset(const Tree& tree, NodeId part, NodeId root, double explode, double diagonal);

}  // namespace kerf::view

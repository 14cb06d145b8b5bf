// Draws scenes and the user interface with OpenGL 3.3 into a framebuffer of its own.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "viewer/model/camera.h"
#include "viewer/render/image.h"
#include "viewer/render/seen_lines.h"
#include "viewer/render/widest_places.h"
#include "viewer/scene/layer.h"

struct ImDrawData;
struct ImFontAtlas;

namespace kerf::view {

struct Gl;

/// A primitive under a pixel.
struct PickHit {
    std::size_t layer = 0;       ///< its number in the scene
    NodeId owner = 0;            ///< of the range
    std::uint32_t range = 0;     ///< index in Layer::ranges
    std::int32_t primitive = 0;  ///< number in the geometry, not in the range
    std::int32_t element = 0;    ///< Geometry::element of it
    Eigen::Vector3f point;       ///< on it, in draw coordinates before the range's offset
    Eigen::Vector3f rest = {};   ///< where this point is when nothing is deformed
    float value = 0;             ///< there, of a layer with Fill::scale; else, or where there is none, NaN
};

/// What a layer has drawn.
struct DrawnLayer {
    LayerKind kind = LayerKind::surface;
    NodeId owner = 0;
    std::int64_t triangles = 0, segments = 0, points = 0;
};

/// All calls need the context of `gl` to be current. The same calls give the same pixels, whatever made the context,
/// as long as the driver is the same.
class Renderer {
 public:
    /// `shader_folder` holds the .vert and .frag files. Throws Error(io) if one is missing, Error(internal) with the
    /// driver's words if one does not compile or the context is older than 3.3.
    Renderer(const Gl& gl, const std::string& shader_folder);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// Makes the picture this large; what it held is lost. Throws Error(usage) beyond the largest size of the driver.
    void resize(int width, int height);

    /// Fills the picture with one colour.
    void clear(const Color& color);
    /// Background and layers inside of the projection's viewport. Geometry that was not drawn for a while leaves the
    /// GPU's memory.
    void draw(const Scene& scene, const Projection& projection);
    /// On top of the picture. `fonts` must be built (ImGui wants that before its first frame); it is uploaded when it
    /// has been built anew, gets its texture's name and loses its copy of the pixels.
    void draw_ui(const ImDrawData& ui, ImFontAtlas& fonts);

    /// A picture that draw_ui() can draw, as an ImTextureID, as long as this lives.
    void* add_picture(const Image& picture);

    /// The foremost pickable primitive at a pixel (from the top left), by an id buffer: exact, whatever is drawn over
    /// it. Layers that are not opaque are passed over. Draws only around the pixel.
    std::optional<PickHit> pick(const Scene& scene, const Projection& projection, int x, int y);

    /// Where each patch that is seen (Layer::patch) has most room for its number, in pixels from the top left. Draws
    /// the scene once more.
    std::vector<NumberPlace> places_of_patches(const Scene& scene, const Projection& projection);

    /// The pieces of isolines that nothing covers. Draws the scene once more.
    std::vector<SeenSegment> seen_isolines(const Scene& scene, const Projection& projection);

    /// What the last draw() drew, in the order of its layers.
    const std::vector<DrawnLayer>& drawn() const;

    /// The picture.
    Image read();
    /// Copies the picture to the framebuffer of the window, which has the same size.
    void present();

    std::string driver() const;  ///< name and version, for error reports

 private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace kerf::view

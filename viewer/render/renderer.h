// The renderer: it draws scenes and the user interface with OpenGL 3.3 into a framebuffer of its own.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "viewer/model/camera.h"
#include "viewer/render/image.h"
#include "viewer/render/inside/seen_lines.h"
#include "viewer/render/inside/widest_places.h"
#include "viewer/scene/layer.h"

struct ImDrawData;
struct ImFontAtlas;

namespace kerf::view {

struct Gl;

/// A primitive under a pixel.
struct PickHit {
    std::size_t layer = 0;       ///< number of the layer in the scene
    NodeId owner = no_node;      ///< owner of the range
    std::uint32_t range = 0;     ///< index in Layer::ranges
    std::int32_t primitive = 0;  ///< number of the primitive in the geometry, not in the range
    std::int32_t element = 0;    ///< Geometry::element of the primitive
    Eigen::Vector3f point;       ///< the point on the primitive, in draw coordinates before the range's offset
    Eigen::Vector3f rest = {};   ///< place of this point without deformation
    float value = 0;             ///< value at this point in a layer with Fill::scale; NaN: there is none
};

/// The numbers of primitives that a layer has drawn.
struct DrawnLayer {
    LayerKind kind = LayerKind::surface;
    NodeId owner = no_node;
    std::int64_t triangles = 0, segments = 0, points = 0;
};

/// A renderer of scenes. All calls need the context of `gl` to be current. The same calls give the same pixels,
/// whatever made the context, as long as the driver is the same.
class Renderer {
 public:
    /// Loads the shaders. `shader_folder` holds the .vert and .frag files. Throws Error(io) if one is missing,
    /// Error(internal) with the driver's words if one does not compile or the context is older than 3.3.
    Renderer(const Gl& gl, const std::string& shader_folder);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// Makes the picture this large; its content is lost if the size changes. Throws Error(usage) beyond the largest
    /// size of the driver.
    void resize(int width, int height);

    /// Fills the picture with one colour.
    void clear(const Color& color);
    /// Draws background and layers inside of the projection's viewport. Geometry that was not drawn for a while leaves
    /// the GPU's memory.
    void draw(const Scene& scene, const Projection& projection);
    /// Draws the user interface on top of the picture. `fonts` must be built (ImGui wants that before its first frame);
    /// it is uploaded when it has been built anew, gets its texture's name and loses its copy of the pixels.
    void draw_ui(const ImDrawData& ui, ImFontAtlas& fonts);

    /// Returns a picture that draw_ui() can draw, as an ImTextureID that is valid as long as the renderer lives.
    void* add_picture(const Image& picture);

    /// Returns the foremost pickable primitive at a pixel (from the top left), by an id buffer: exact, whatever is
    /// drawn over it. Layers that are not opaque are passed over. Draws only that pixel.
    std::optional<PickHit> pick(const Scene& scene, const Projection& projection, int x, int y);

    /// Returns for each visible patch (Layer::patch) the place with most room for its number, in pixels from the top
    /// left. Draws the scene once more.
    std::vector<NumberPlace> places_of_patches(const Scene& scene, const Projection& projection);

    /// Returns the pieces of isolines that nothing covers, in pixels from the top left. Draws the scene once more.
    std::vector<SeenSegment> seen_isolines(const Scene& scene, const Projection& projection);

    /// Returns the numbers of primitives of the last draw(), in the order of its layers.
    const std::vector<DrawnLayer>& drawn() const;

    /// Waits until all that was asked for has been drawn.
    void finish();
    /// Returns the picture.
    Image read();
    /// Copies the picture to the framebuffer of the window, which has the same size.
    void present();

    std::string driver() const;  ///< returns name and version of the driver, for error reports

 private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace kerf::view

// Corners of triangles, with their colour and light: a software driver shades whole blocks of 4 x 4 pixels for every
// small triangle, so that what can be done here must not be done per pixel.
//
// EDGES: lines along the edges. SMOOTH: shading by the corners' normals. SCALE, CATEGORIES: colour by value.
// IDS: no colour, but which triangle it is.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 triangle_normal;
layout(location = 2) in vec3 corner_normal;
layout(location = 3) in uint edges;
layout(location = 4) in float value;

uniform mat4 transform;    // draw coordinates to clip coordinates
uniform vec3 offset;
uniform vec4 clip_plane;   // before the offset
uniform vec4 eye;          // where the eye is (w = 1) or in which direction (w = 0), in draw coordinates
uniform vec3 key_light, fill_light, up;  // directions in draw coordinates, seen from the surface
uniform vec4 color;        // of the range; with SCALE and CATEGORIES: where there is no value
uniform bool two_sided;
uniform float shading;     // 0: as bright everywhere; 1: by the light
uniform vec2 value_range;  // the low end, 1 / (high - low)
uniform sampler2D colors;  // with SCALE: the scale; with CATEGORIES: the palette

#ifdef SMOOTH
#define PASSED out
#else
#define PASSED flat out
#endif
#ifdef IDS
flat out uint primitive;
#elif defined(SCALE)
PASSED vec2 tone;      // brightness; 1 for the back, 0 for the front
out float amount;      // 0 at the low end of the scale, 1 at the high end; far below where there is no value
#else
PASSED vec3 lit_color;
#endif
#ifdef EDGES
// Distance from edge i, 1 at the opposite corner; linear on the screen. An edge that is not drawn is far away.
noperspective out vec3 heights;
#endif

bool is_nan(float x) { return (floatBitsToUint(x) & 0x7fffffffu) > 0x7f800000u; }

vec3 base_color() {
#ifdef CATEGORIES
    if (is_nan(value)) return color.rgb;
    int size = textureSize(colors, 0).x;
    int index = int(floor(value + 0.5)) % size;
    return texelFetch(colors, ivec2(index < 0 ? index + size : index, 0), 0).rgb;
#else
    return color.rgb;
#endif
}

// Wraps around the surface and ends softly, so that coarse meshes can be shaded by their corners.
float lamp(float cosine) {
    float wrapped = max(0.3 + 0.7 * cosine, 0);
    return 0.5 * (wrapped + wrapped * wrapped);
}

#if defined(SCALE) || defined(CATEGORIES)
// From the eye and weak: a face that is seen from the front has the colour of the legend, and none is far from it.
float brightness(vec3 n, vec3 to_eye) { return 0.64 + 0.36 * max(dot(n, normalize(to_eye)), 0); }
#else
// A lamp at the upper left, a weak one against it, one at the eye, and a sky that is brighter above.
float brightness(vec3 n, vec3 to_eye) {
    float light = 0.32 + 0.07 * dot(n, up) + 0.62 * lamp(dot(n, key_light)) + 0.10 * lamp(dot(n, fill_light)) +
                  0.22 * max(dot(n, normalize(to_eye)), 0);
    float above = max(light - 0.85, 0);  // what is bright saturates softly
    return min(light - above * above, 1.03);
}
#endif

vec3 back_color(vec3 c) { return 0.62 * mix(c, vec3(dot(c, vec3(0.299, 0.587, 0.114))), 0.6); }

void main() {
    vec3 place = position + offset;
    gl_Position = transform * vec4(place, 1);
    gl_ClipDistance[0] = dot(clip_plane, vec4(position, 1));
#ifdef IDS
    primitive = uint(gl_VertexID) / 3u;
#else
    vec3 normal = triangle_normal;
#ifdef SMOOTH
    if (corner_normal != vec3(0)) normal = corner_normal;
#endif
    vec3 to_eye = eye.xyz - eye.w * place;
    bool back = dot(triangle_normal, to_eye) < 0;
    float light = mix(1.0, brightness(back ? -normal : normal, to_eye), shading);
    bool greyed = back && !two_sided;
#ifdef SCALE
    tone = vec2(light, greyed ? 1 : 0);
    amount = is_nan(value) ? -1e9 : clamp((value - value_range.x) * value_range.y, -1e3, 1e3);
#else
    vec3 base = base_color();
    lit_color = light * (greyed ? back_color(base) : base);
#endif
#endif
#ifdef EDGES
    int corner = gl_VertexID % 3;
    heights = vec3(corner == 2, corner == 0, corner == 1) + 8 * vec3(~uvec3(edges, edges >> 1, edges >> 2) & 1u);
#endif
}

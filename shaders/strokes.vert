// Lines (SEGMENTS) and discs (POINTS) of a size in pixels: one rectangle each, facing the screen.
//
// A stroke is drawn nearer than it is, by as much as a steep surface rises within its width, so that a line on a
// surface is not eaten by it. Only its depth changes, never its place on the screen.
#ifdef SEGMENTS
layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
#else
layout(location = 0) in vec3 center;
#endif

uniform mat4 view, projection;
uniform vec3 offset;
uniform vec4 clip_plane;  // before the offset
uniform vec2 viewport;    // in pixels
uniform float radius;     // of the disc, half of the line's width, in pixels
uniform float nearer;     // in pixels

out vec2 place;  // in pixels: along the line from its start, and beside it; from the centre of the disc
#ifdef SEGMENTS
flat out float length_px;
#endif
#ifdef IDS
flat out uint primitive;
#endif

const vec4 nowhere = vec4(0, 0, 2, 1);

// Of the rectangle: -1 or 1 along x and y. Its two triangles share a diagonal.
vec2 corner() {
    int i = gl_VertexID % 6;
    return vec2(i == 1 || i >= 4 ? 1 : -1, i == 2 || i == 3 || i == 5 ? 1 : -1);
}

float depth_before(vec4 eye, float clip_w) {
    float pixel = 2 * clip_w / (projection[1][1] * viewport.y);
    eye.z += min(nearer * pixel, 0.5 * clip_w);
    vec4 clip = projection * eye;
    return max(clip.z / clip.w, -1);
}

float plane_distance(vec3 p) { return dot(clip_plane, vec4(p, 1)); }

void place_at(vec2 pixel, float depth) { gl_Position = vec4(2 * pixel / viewport, depth, 1); }

#ifdef SEGMENTS

// The part of the segment on the visible side of the plane; false if there is none.
bool clip_segment(inout vec3 a, inout vec3 b) {
    float da = plane_distance(a), db = plane_distance(b);
    if (da < 0 && db < 0) return false;
    vec3 p = a;
    if (da < 0) a = mix(a, b, da / (da - db));
    if (db < 0) b = mix(b, p, db / (db - da));
    return true;
}

// The part before the eye.
bool clip_near(inout vec4 a, inout vec4 b) {
    vec4 near = vec4(0, 0, 1, 1) * projection;
    float da = dot(near, a), db = dot(near, b);
    if (da < 0 && db < 0) return false;
    vec4 p = a;
    if (da < 0) a = mix(a, b, da / (da - db));
    if (db < 0) b = mix(b, p, db / (db - da));
    return true;
}

void main() {
    gl_Position = nowhere;
    place = vec2(0);
    length_px = 0;
    vec3 start = from, end = to;
    if (!clip_segment(start, end)) return;
    vec4 a = view * vec4(start + offset, 1), b = view * vec4(end + offset, 1);
    if (!clip_near(a, b)) return;
    vec4 clip_a = projection * a, clip_b = projection * b;
    vec2 pixel_a = 0.5 * viewport * clip_a.xy / clip_a.w, pixel_b = 0.5 * viewport * clip_b.xy / clip_b.w;
    length_px = distance(pixel_a, pixel_b);
    vec2 along = length_px > 1e-4 ? (pixel_b - pixel_a) / length_px : vec2(1, 0);
    vec2 beside = vec2(-along.y, along.x);
    float reach = radius + 1;
    bool at_end = corner().x > 0;
    place = vec2(at_end ? length_px + reach : -reach, corner().y * reach);
    place_at(pixel_a + along * place.x + beside * place.y,
             at_end ? depth_before(b, clip_b.w) : depth_before(a, clip_a.w));
}

#else

void main() {
    gl_Position = nowhere;
    place = vec2(0);
#ifdef IDS
    primitive = uint(gl_VertexID) / 6u;
#endif
    vec4 eye = view * vec4(center + offset, 1);
    vec4 clip = projection * eye;
    if (plane_distance(center) < 0 || clip.z < -clip.w) return;
    place = (radius + 1) * corner();
    place_at(0.5 * viewport * clip.xy / clip.w + place, depth_before(eye, clip.w));
}

#endif

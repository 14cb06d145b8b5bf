// Colour and edge lines of triangles; see triangles.vert for the switches.
uniform float opacity;
uniform vec4 edge;         // its alpha is the strength of the lines
uniform vec3 edge_widths;  // in pixels: of a line; height of a triangle below which there is none; 1 / what it takes
                           // above that until there is all of it
#ifdef SCALE
uniform vec4 color;        // where there is no value
uniform sampler2D colors;
#endif

#ifdef SMOOTH
#define PASSED in
#else
#define PASSED flat in
#endif
#ifdef SCALE
PASSED vec2 tone;
in float amount;
#else
PASSED vec3 lit_color;
#endif
#ifdef EDGES
noperspective in vec3 heights;
#endif

out vec4 pixel;

#ifdef SCALE
vec3 back_color(vec3 c) { return 0.62 * mix(c, vec3(dot(c, vec3(0.299, 0.587, 0.114))), 0.6); }

vec3 lit() {
    int size = textureSize(colors, 0).x;
    vec3 base = texelFetch(colors, ivec2(clamp(int(amount * float(size - 1) + 0.5), 0, size - 1), 0), 0).rgb;
    if (amount < -1e4) base = color.rgb;
    return tone.x * mix(base, back_color(base), tone.y);
}
#else
vec3 lit() { return lit_color; }
#endif

#ifdef EDGES
// Each of the two triangles at an edge draws one half of its line. Lines vanish where the triangle is only a few
// pixels high, so that dense meshes keep their colour.
float edge_coverage() {
    vec3 dx = dFdx(heights), dy = dFdy(heights);
    vec3 size = inversesqrt(max(dx * dx + dy * dy, 1e-12));  // height of the triangle over the edge, in pixels
    vec3 line = clamp(0.5 * edge_widths.x + 0.5 - heights * size, 0, 1) *
                clamp((size - edge_widths.y) * edge_widths.z, 0, 1);
    return max(line.x, max(line.y, line.z)) * edge.a;
}
#endif

void main() {
    pixel = vec4(lit(), opacity);
#ifdef EDGES
    float line = edge_coverage();
    pixel = mix(pixel, vec4(edge.rgb, mix(opacity, 1, 0.5 * opacity)), line);
#endif
}

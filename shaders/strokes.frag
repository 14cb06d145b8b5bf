// Lines with round ends (SEGMENTS) and discs with a dark rim (POINTS), with soft borders; IDS: which disc it is.
uniform vec4 color;
uniform float radius;    // in pixels
uniform vec2 coverages;  // what is covered less than the first or not less than the second is left out
uniform float rim;       // of discs, in pixels
#ifdef IDS
uniform uint layer, range;
#endif

in vec2 place;
#ifdef SEGMENTS
flat in float length_px;
#endif
#ifdef IDS
flat in uint primitive;
out uvec4 id;
#else
out vec4 pixel;
#endif

void main() {
#ifdef SEGMENTS
    float d = length(place - vec2(clamp(place.x, 0, length_px), 0));
#else
    float d = length(place);
#endif
    float coverage = clamp(radius + 0.5 - d, 0, 1);
    if (coverage < coverages.x || coverage >= coverages.y) discard;
#ifdef IDS
    id = uvec4(layer, primitive, range, 0u);
#else
    pixel = vec4(color.rgb, color.a * coverage);
#ifndef SEGMENTS
    pixel.rgb *= mix(1.0, 0.25, clamp(d - (radius - rim) + 0.5, 0, 1));
#endif
#endif
}

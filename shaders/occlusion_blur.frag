// The mean of 4 x 4 pixels, of which each has looked in other directions, as far as they lie at one depth.
uniform sampler2D depths, occlusion;
uniform vec4 corner;       // of the viewport: left, lower, width, height, in pixels
uniform vec4 depth_terms;  // depth z in eye coordinates from that of the buffer
uniform int step;

in vec2 place;
out vec4 pixel;

float eye_depth(ivec2 at) {
    ivec2 last = ivec2(corner.zw) - 1;
    float d = 2 * texelFetch(depths, ivec2(corner.xy) + clamp(at * step, ivec2(0), last), 0).r - 1;
    return (d * depth_terms.x + depth_terms.y) / (d * depth_terms.z + depth_terms.w);
}

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy), last = textureSize(occlusion, 0) - 1;
    float here = eye_depth(at);
    float slope = abs(eye_depth(at + ivec2(1, 0)) - here) + abs(eye_depth(at + ivec2(0, 1)) - here);
    float near = min(3 * slope, 0.05) + 0.004;
    float sum = 0, weights = 0;
    for (int y = -2; y < 2; ++y)
        for (int x = -2; x < 2; ++x) {
            ivec2 other = clamp(at + ivec2(x, y), ivec2(0), last);
            float weight = max(0.001, 1 - abs(eye_depth(other) - here) / near);
            sum += weight * texelFetch(occlusion, other, 0).r;
            weights += weight;
        }
    pixel = vec4(sum / weights);
}

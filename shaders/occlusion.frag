// Which share of the half space above a place lies behind other things nearby, seen by the depth of the picture alone.
uniform sampler2D depths;
uniform vec4 corner;        // of the viewport: left, lower, width, height, in pixels
uniform vec4 depth_terms;   // depth z in eye coordinates from that of the buffer
uniform vec4 place_terms;   // of the projection: diagonal, third column
uniform vec2 place_shift;   // and the fourth
uniform float perspective;  // 1, else 0
uniform vec2 reach;         // of hollows, in eye coordinates; its largest in heights of the viewport
uniform int step;           // pixels of the picture per pixel

in vec2 place;
out vec4 pixel;

const int samples = 14;
const float turn = 2.399963, circle = 6.2831853;

float depth_at(ivec2 at) { return texelFetch(depths, ivec2(corner.xy) + at, 0).r; }

vec3 eye_at(ivec2 at) {
    at = clamp(at, ivec2(0), ivec2(corner.zw) - 1);
    float d = 2 * depth_at(at) - 1;
    float z = (d * depth_terms.x + depth_terms.y) / (d * depth_terms.z + depth_terms.w);
    vec2 on_screen = 2 * (vec2(at) + 0.5) / corner.zw - 1;
    float w = mix(1, -z, perspective);
    return vec3((on_screen * w - place_terms.zw * z - place_shift) / place_terms.xy, z);
}

// Towards the neighbour that lies on the same surface.
vec3 along(ivec2 at, ivec2 way, vec3 here) {
    vec3 on = eye_at(at + way) - here, back = here - eye_at(at - way);
    return abs(on.z) < abs(back.z) ? on : back;
}

void main() {
    ivec2 low = ivec2(gl_FragCoord.xy), at = min(low * step, ivec2(corner.zw) - 1);
    pixel = vec4(0);
    if (depth_at(at) == 1) return;
    vec3 here = eye_at(at);
    vec3 normal = normalize(cross(along(at, ivec2(step, 0), here), along(at, ivec2(0, step), here)));
    float scale = 0.5 * place_terms.y * corner.w / mix(1, -here.z, perspective);  // pixels of a length
    float pixels = min(reach.x * scale, reach.y * corner.w), radius = pixels / scale;
    int pattern = (low.x & 1) << 3 | ((low.x ^ low.y) & 1) << 2 | (low.x & 2) | ((low.x ^ low.y) & 2) >> 1;
    float first = float(pattern) / 16.0, sum = 0;
    for (int i = 0; i < samples; ++i) {
        float angle = turn * float(i) + circle * first, far = pow((float(i) + 0.5 + 0.5 * first) / float(samples), 1.4);
        vec3 to = eye_at(at + ivec2(round(pixels * far * vec2(cos(angle), sin(angle))))) - here;
        float square = dot(to, to);
        float rise = dot(to, normal) * inversesqrt(square + 1e-12);
        sum += max(0, rise - 0.08) * max(0, 1 - 0.4 * square / (radius * radius));
    }
    pixel = vec4(1 - exp(-4.2 * sum / float(samples)));
}

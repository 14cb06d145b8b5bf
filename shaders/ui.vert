// Dear ImGui's vertices.
layout(location = 0) in vec2 position;
layout(location = 1) in vec2 texture_place;
layout(location = 2) in vec4 tint;

uniform vec4 area;  // left, top, width, height of what is shown

out vec2 place;
out vec4 color;

void main() {
    place = texture_place;
    color = tint;
    vec2 p = (position - area.xy) / area.zw;
    gl_Position = vec4(2 * p.x - 1, 1 - 2 * p.y, 0, 1);
}

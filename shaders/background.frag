// A gradient from the bottom to the top.
uniform vec4 bottom, top;

in vec2 place;
out vec4 pixel;

void main() { pixel = vec4(mix(bottom.rgb, top.rgb, place.y), 1); }

// How bright a hollow is, for all colours alike, so that their hue stays.
uniform sampler2D occlusion;
uniform float strength;

in vec2 place;
out vec4 pixel;

void main() { pixel = vec4(vec3(1 - strength * texture(occlusion, place).r), 1); }

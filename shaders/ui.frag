uniform sampler2D image;

in vec2 place;
in vec4 color;
out vec4 pixel;

void main() { pixel = color * texture(image, place); }

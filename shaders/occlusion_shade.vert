// One triangle that covers the viewport, as far away as the background.
out vec2 place;

void main() {
    place = vec2(gl_VertexID == 1 ? 2 : 0, gl_VertexID == 2 ? 2 : 0);
    gl_Position = vec4(2 * place - 1, 1, 1);
}

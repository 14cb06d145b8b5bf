// Which triangle a pixel belongs to.
uniform uint layer;  // 1 and up; 0: may hide others, but is not picked
uniform uint range;

flat in uint primitive;
out uvec4 id;

void main() { id = uvec4(layer, primitive, range, 0u); }

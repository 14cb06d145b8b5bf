// consumer SURFACE: what the four parts of a body hold.
#include <fmt/format.h>

#include "decompose/decomposition.h"
#include "prepare/input.h"

int main(int, char** argv) {
    const kerf::Input input = kerf::read_input(argv[1]);
    const kerf::Decomposition parts = kerf::decompose(input.surface, {.parts = 4, .cut = {}}, {0, 4});
    for (const kerf::Leaf& part : parts.leaves)
        fmt::print("part {}: {} facets, volume {:.6g}\n", part.id, part.surface.facets.size(), part.volume);
}

#include "viewer/model/inside/shown.h"

#include <utility>

namespace kerf::view {

namespace {

constexpr std::size_t bytes_aside = std::size_t{1} << 30;

}  // namespace

void ShownPair::set_aside(Document before) {
    other = Shown();
    other->document = std::move(before);
    other->replayer = now.replayer;
    other->folder_parts = now.folder_parts;
    other->scratch = now.scratch;
    std::swap(other->store, now.store);
    other->store.shrink(bytes_aside);
    shows_before = false;
}

void ShownPair::swap() {
    std::swap(*other, now);
    other->store.shrink(bytes_aside);
    shows_before = !shows_before;
}

}  // namespace kerf::view

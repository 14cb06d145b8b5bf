// What every command does with a file before it cuts: read, weld, diagnose and, if it is clean, orient.
#include <string>

#include "fuzzed.h"
#include "io/surface_reader.h"
#include "surface/diagnosis.h"
#include "surface/orientation.h"

namespace kerf {

namespace {

void check(const std::string& bytes) {
    Soup soup = read_surface_bytes(bytes, "fuzzed");
    weld_exactly(soup);
    const Diagnosis diagnosis = diagnose(soup);
    if (diagnosis.summary().empty()) std::abort();
    if (!diagnosis.clean()) return;
    drop_unused_vertices(soup);
    orient(soup);
}

}  // namespace

}  // namespace kerf

extern "C" int LLVMFuzzerTestOneInput(const char* data, std::size_t size) {
    kerf::test::run_fuzzed([&] { kerf::check(std::string(data, size)); });
    return 0;
}

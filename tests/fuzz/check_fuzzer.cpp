// What every command does with a file before it cuts: read, weld, diagnose and, if it is clean, orient.
#include <string>

#include "files/io/surface_reader.h"
#include "fuzzed.h"
#include "run/prepare/input.h"

namespace kerf {

namespace {

void check(const std::string& bytes) {
    CheckedSoup checked = check_soup(read_surface_bytes(bytes, "fuzzed"));
    if (checked.diagnosis.summary(checked.soup).empty()) std::abort();
    if (checked.diagnosis.clean()) apply_repairs(checked);
}

}  // namespace

}  // namespace kerf

extern "C" int LLVMFuzzerTestOneInput(const char* data, std::size_t size) {
    kerf::test::run_fuzzed([&] { kerf::check(std::string(data, size)); });
    return 0;
}

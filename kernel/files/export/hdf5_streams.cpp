// HDF5's static library is compiled for programs: it takes the streams of stdio for variables of its own program, which
// they cannot be in a shared library. There the linker gives it these instead (--wrap); programs do not link this file.
#include <cstdio>

extern std::FILE* real_stdout asm("__real_stdout");
extern std::FILE* real_stderr asm("__real_stderr");

[[gnu::visibility("hidden")]] extern std::FILE* stdout_of_library asm("__wrap_stdout");
[[gnu::visibility("hidden")]] extern std::FILE* stderr_of_library asm("__wrap_stderr");
std::FILE* stdout_of_library = real_stdout;
std::FILE* stderr_of_library = real_stderr;

// Checks of the preconditions that headers state, in the builds for developers (KERF_CHECKS: all presets but release).
#pragma once

#include <cstdio>
#include <cstdlib>

namespace kerf {

#ifdef KERF_CHECKS
inline constexpr bool has_checks = true;
#else
inline constexpr bool has_checks = false;
#endif

namespace detail {
[[noreturn]] inline void fail_check(const char* file, int line, const char* condition) {
    std::fprintf(stderr, "%s:%d: this must hold, but does not: %s\n", file, line, condition);
    std::abort();
}
}  // namespace detail

/// Ends the process, naming file, line and condition, if the condition does not hold. It is for mistakes of the caller
/// alone: mistakes of a file or a user are an Error. The condition must have no effect, because builds without checks
/// leave it out, and should cost no more than the code that it guards.
#define KERF_CHECK(...)                                        \
    (!kerf::has_checks || (__VA_ARGS__) ? static_cast<void>(0) \
                                        : kerf::detail::fail_check(__FILE__, __LINE__, #__VA_ARGS__))

}  // namespace kerf

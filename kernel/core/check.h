// The preconditions that headers state, checked in the builds for developers (KERF_CHECKS: all presets but release).
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

/// Ends the process, naming file, line and condition, if the condition does not hold. For mistakes of the caller alone:
/// what a file or a user may get wrong is an Error. It must have no effect, because builds without checks leave it out;
/// it should cost no more than what it guards.
#define KERF_CHECK(...)                                        \
    (!kerf::has_checks || (__VA_ARGS__) ? static_cast<void>(0) \
                                        : kerf::detail::fail_check(__FILE__, __LINE__, #__VA_ARGS__))

}  // namespace kerf

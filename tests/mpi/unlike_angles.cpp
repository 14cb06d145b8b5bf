// Angles as the mathematical library of another host may give them: otherwise, and so much that every cut shows it.
#include <dlfcn.h>

#include <cmath>

namespace {

constexpr double unlike = 0.5;

template <class Function>
Function usual(const char* name) {
    return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" double atan2(double y, double x) noexcept {
    static const auto function = usual<double (*)(double, double)>("atan2");
    return function(y, x) * unlike;
}

extern "C" double tan(double angle) noexcept {
    static const auto function = usual<double (*)(double)>("tan");
    return function(angle) * unlike;
}

#include "base/parallel/processors.h"

#include <sched.h>

#include <algorithm>
#include <map>
#include <memory>
#include <thread>

namespace kerf {

namespace {

constexpr int most_processors = 1 << 20;  // of the largest set that is tried

struct FreeSet {
    void operator()(cpu_set_t* set) const { CPU_FREE(set); }
};

}  // namespace

// The system refuses a set that is smaller than its own, and does not tell how large that is.
std::vector<int> allowed_processors(pid_t process) {
    std::vector<int> allowed;
    for (int size = CPU_SETSIZE; size <= most_processors; size *= 2) {
        const std::unique_ptr<cpu_set_t, FreeSet> set(CPU_ALLOC(size));
        const std::size_t bytes = CPU_ALLOC_SIZE(size);
        CPU_ZERO_S(bytes, set.get());
        if (::sched_getaffinity(process, bytes, set.get()) != 0) continue;
        for (int i = 0; i < size; ++i)
            if (CPU_ISSET_S(i, bytes, set.get())) allowed.push_back(i);
        break;
    }
    return allowed;
}

void allow_processors(const std::vector<int>& processors) {
    if (processors.empty()) return;
    const int size = std::max(CPU_SETSIZE, *std::max_element(processors.begin(), processors.end()) + 1);
    const std::unique_ptr<cpu_set_t, FreeSet> set(CPU_ALLOC(size));
    const std::size_t bytes = CPU_ALLOC_SIZE(size);
    CPU_ZERO_S(bytes, set.get());
    for (const int processor : processors) CPU_SET_S(processor, bytes, set.get());
    ::sched_setaffinity(0, bytes, set.get());
}

int machine_processors() { return std::max<int>(1, std::thread::hardware_concurrency()); }

int share_of_processors(const std::vector<std::vector<int>>& allowed, std::size_t process) {
    std::map<int, int> users;
    for (const std::vector<int>& processors : allowed)
        for (const int processor : processors) ++users[processor];
    double share = 0;
    for (const int processor : allowed[process]) share += 1.0 / users[processor];
    constexpr double rounding = 1e-6;  // so that three thirds make a whole
    return std::max(1, static_cast<int>(share + rounding));
}

}  // namespace kerf

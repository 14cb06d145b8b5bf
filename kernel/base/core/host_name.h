// The name of the machine, for locks and messages.
#pragma once

#include <unistd.h>

#include <string>

namespace kerf {

/// Returns the name of the machine, empty if the system does not tell it.
inline std::string host_name() {
    char name[256] = "";
    ::gethostname(name, sizeof name - 1);
    return name;
}

}  // namespace kerf

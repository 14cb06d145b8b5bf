// The name of the machine, as locks and messages give it.
#pragma once

#include <unistd.h>

#include <string>

namespace kerf {

/// Empty if the system does not tell it.
inline std::string host_name() {
    char name[256] = "";
    ::gethostname(name, sizeof name - 1);
    return name;
}

}  // namespace kerf

// The test whether memory has run out, which libraries report in more than one way.
#pragma once

#include <exception>
#include <new>
#include <system_error>

namespace kerf {

/// Whether an exception means that memory has run out. A thread that cannot be started counts, too: its stack is
/// memory.
inline bool is_out_of_memory(const std::exception& e) {
    if (dynamic_cast<const std::bad_alloc*>(&e)) return true;
    const auto* error = dynamic_cast<const std::system_error*>(&e);
    return error && (error->code() == std::errc::resource_unavailable_try_again ||
                     error->code() == std::errc::not_enough_memory);
}

}  // namespace kerf

// What an action says when reading or writing fails.
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "base/core/error.h"

namespace kerf::test {

/// The message of the Error(io) that the action throws; empty if it throws none.
template <class Action>
std::string io_error(Action action) {
    try {
        action();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::io) << error.what();
        return error.what();
    }
    return "";
}

}  // namespace kerf::test

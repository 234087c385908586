#pragma once
// What a refused action says.
#include <gtest/gtest.h>

#include <string>

#include "fissura/core/error.hpp"

namespace fissura::support {

/// The text of the error, whose kind is checked; "accepted" where there is none.
std::string refusal(core::Failure kind, auto const& action) {
  try {
    action();
  } catch (core::Error const& e) {
    EXPECT_EQ(e.failure, kind) << e.what();
    return e.what();
  }
  return "accepted";
}

} // namespace fissura::support

#pragma once
#include <string>

#include <CLI/CLI.hpp>

namespace fissura::app {

/// Refuses what is no finite number from `least` to `most`; the words in `or_word` pass as they are.
CLI::Validator number_within(double least, double most, std::string const& or_word = "");

} // namespace fissura::app

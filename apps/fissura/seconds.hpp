#pragma once
#include <string>

namespace fissura::app {

/// Seconds, as a plain number or as a text with its unit, "3 ms". Throws core::Error that names the option,
/// also for what is negative or not finite.
double seconds(std::string const& option, std::string const& text);

} // namespace fissura::app

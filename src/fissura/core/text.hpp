#pragma once
// Small pieces of text that many messages need.
#include <string>
#include <string_view>
#include <vector>

namespace fissura::core {

/// The texts one after the other with `between` between two of them.
std::string joined(std::vector<std::string> const& texts, std::string_view between);

} // namespace fissura::core

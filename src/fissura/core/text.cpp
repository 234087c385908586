#include "fissura/core/text.hpp"

namespace fissura::core {

std::string joined(std::vector<std::string> const& texts, std::string_view between) {
  std::string all;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (i > 0) all += between;
    all += texts[i];
  }
  return all;
}

} // namespace fissura::core

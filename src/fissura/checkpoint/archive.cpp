#include "fissura/checkpoint/archive.hpp"

#include <fmt/core.h>

#include "fissura/core/error.hpp"

namespace fissura::checkpoint {

void Loader::refuse(std::string const& reason) const {
  throw core::InputError({path_}, fmt::format("this checkpoint cannot be used: {}", reason));
}

void Loader::finish() const {
  if (!rest_.empty()) refuse(fmt::format("{} bytes are left over", rest_.size()));
}

void Loader::raw(void* data, std::size_t size) {
  if (size > rest_.size()) refuse("it ends too early");
  if (size > 0) std::memcpy(data, rest_.data(), size);
  rest_.remove_prefix(size);
}

std::size_t Loader::count() {
  std::uint64_t n = 0;
  raw(&n, sizeof n);
  if (n > rest_.size()) refuse("it ends within a list");
  return static_cast<std::size_t>(n);
}

void Loader::expect(std::size_t size) {
  std::uint64_t n = 0;
  raw(&n, sizeof n);
  if (n != size) refuse(fmt::format("a list of {} items should have {}", n, size));
}

} // namespace fissura::checkpoint

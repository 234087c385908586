#pragma once
// The numbers of a page: named arrays and one JSON object, packed into one compressed text that stands in the
// HTML. Layout before compression: length of the JSON text (UInt32), the text, zeros up to a multiple of 8,
// then the arrays, each from a multiple of 8. The text is {"meta": ..., "arrays": {name: [type, offset,
// count]}} with offsets from the first array. All little endian; report/src/data.js reads it.
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "fissura/output/json.hpp"

namespace fissura::report {

class Blob {
 public:
  output::Json meta = output::Json::object();

  void add(std::string const& name, std::span<float const> values) {
    append(name, "f4", std::as_bytes(values), values.size());
  }
  void add(std::string const& name, std::span<std::uint32_t const> values) {
    append(name, "u4", std::as_bytes(values), values.size());
  }
  void add(std::string const& name, std::span<std::uint16_t const> values) {
    append(name, "u2", std::as_bytes(values), values.size());
  }
  void add(std::string const& name, std::span<std::int16_t const> values) {
    append(name, "i2", std::as_bytes(values), values.size());
  }
  void add(std::string const& name, std::span<std::uint8_t const> values) {
    append(name, "u1", std::as_bytes(values), values.size());
  }

  /// Adds the values as 16-bit whole numbers and returns what one of them stands for: the largest magnitude
  /// over 32767. Values that are not finite become 0.
  double add_quantised(std::string const& name, std::span<float const> values);

  /// Everything, compressed (zlib) and as base64.
  std::string text() const;

 private:
  void append(std::string const& name, char const* type, std::span<std::byte const> bytes, std::size_t count);
  output::Json arrays_ = output::Json::object();
  std::string bytes_;
};

/// RFC 4648, with padding, without line breaks.
std::string base64(std::string_view bytes);

} // namespace fissura::report

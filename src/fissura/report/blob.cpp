#include "fissura/report/blob.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <vector>
#include <zlib.h>

#include "fissura/core/ensure.hpp"

namespace fissura::report {

static_assert(std::endian::native == std::endian::little, "arrays are written as they lie in memory");

namespace {

void pad(std::string& bytes) {
  bytes.resize((bytes.size() + 7) / 8 * 8, '\0');
}

} // namespace

void Blob::append(std::string const& name, char const* type, std::span<std::byte const> bytes,
                  std::size_t count) {
  pad(bytes_);
  arrays_[name] = output::Json::array({type, bytes_.size(), count});
  bytes_.append(reinterpret_cast<char const*>(bytes.data()), bytes.size());
}

double Blob::add_quantised(std::string const& name, std::span<float const> values) {
  double largest = 0;
  for (float const v : values)
    if (std::isfinite(v)) largest = std::max(largest, std::abs(static_cast<double>(v)));
  double const scale = largest / 32767;
  std::vector<std::int16_t> whole;
  whole.reserve(values.size());
  for (float const v : values)
    whole.push_back(std::isfinite(v) && scale > 0 ? static_cast<std::int16_t>(std::lround(v / scale))
                                                  : std::int16_t{0});
  add(name, std::span<std::int16_t const>(whole));
  return scale;
}

std::string Blob::text() const {
  output::Json const head = {{"meta", meta}, {"arrays", arrays_}};
  std::string const json = head.dump(-1, ' ', false, output::Json::error_handler_t::replace);
  auto const length = static_cast<std::uint32_t>(json.size());
  std::string all(reinterpret_cast<char const*>(&length), sizeof length);
  all += json;
  pad(all);
  all += bytes_;

  uLongf size = ::compressBound(all.size());
  std::string packed(size, '\0');
  int const status = ::compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                                 reinterpret_cast<Bytef const*>(all.data()), all.size(), 6);
  core::ensure(status == Z_OK, ::zError(status));
  packed.resize(size);
  return base64(packed);
}

std::string base64(std::string_view bytes) {
  constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::size_t const left = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (k < left ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += k <= left ? letters[word >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

} // namespace fissura::report

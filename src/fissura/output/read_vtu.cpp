#include "fissura/output/read_vtu.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <fmt/core.h>
#include <fstream>
#include <iterator>
#include <pugixml.hpp>
#include <stdexcept>
#include <zlib.h>

#include "fissura/core/error.hpp"
#include "fissura/output/atomic_file.hpp"

namespace fissura::output {

namespace {

/// A block holds at most 128 KiB as written; a header that says far more is damaged.
constexpr std::uint64_t largest_block = std::uint64_t{1} << 26;

std::uint64_t word(std::string_view bytes, std::size_t at) {
  if (at > bytes.size() || bytes.size() - at < sizeof(std::uint64_t))
    throw std::runtime_error("it ends in the middle of an array");
  std::uint64_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

std::string read_file(std::string const& path) {
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) throw_io_error("open", path, errno);
  return {std::istreambuf_iterator<char>(in), {}};
}

template <class From, class To> std::vector<To> converted(std::string const& raw) {
  std::vector<To> out(raw.size() / sizeof(From));
  for (std::size_t i = 0; i < out.size(); ++i) {
    From value{};
    std::memcpy(&value, raw.data() + i * sizeof(From), sizeof value);
    out[i] = static_cast<To>(value);
  }
  return out;
}

template <class To> std::vector<To> converted_from(std::string const& type, std::string const& raw) {
  if (type == "Float32") return converted<float, To>(raw);
  if (type == "Float64") return converted<double, To>(raw);
  if (type == "UInt8") return converted<std::uint8_t, To>(raw);
  if (type == "Int32") return converted<std::int32_t, To>(raw);
  return converted<std::int64_t, To>(raw);
}

} // namespace

std::string inflate_blocks(std::string_view bytes, std::size_t at) {
  std::uint64_t const blocks = word(bytes, at), full = word(bytes, at + 8), last = word(bytes, at + 16);
  if (blocks > bytes.size() || full > largest_block || last > full)
    throw std::runtime_error("an array has no valid header");
  std::size_t from = at + 8 * (3 + static_cast<std::size_t>(blocks));
  std::string out;
  out.reserve(static_cast<std::size_t>(blocks * full));
  std::string block;
  for (std::uint64_t b = 0; b < blocks; ++b) {
    auto const packed = static_cast<std::size_t>(word(bytes, at + 24 + 8 * static_cast<std::size_t>(b)));
    if (from > bytes.size() || packed > bytes.size() - from)
      throw std::runtime_error("it ends in the middle of an array");
    uLongf size = static_cast<uLongf>(b + 1 == blocks && last > 0 ? last : full);
    block.resize(size);
    uLongf const wanted = size;
    int const status = ::uncompress(reinterpret_cast<Bytef*>(block.data()), &size,
                                    reinterpret_cast<Bytef const*>(bytes.data() + from), packed);
    if (status != Z_OK || size != wanted) throw std::runtime_error("a compressed block is damaged");
    out += block;
    from += packed;
  }
  return out;
}

void VtuFile::refuse(std::string const& why) const {
  throw core::Error(core::Failure::io, fmt::format("cannot read '{}': {}", path_, why));
}

VtuFile::VtuFile(std::string path) : path_(std::move(path)), bytes_(read_file(path_)) {
  constexpr std::string_view mark = "<AppendedData encoding=\"raw\">";
  std::size_t const appended = bytes_.find(mark);
  std::size_t const begin =
      appended == std::string::npos ? std::string::npos : bytes_.find('_', appended + mark.size());
  if (begin == std::string::npos) refuse("no VTU file with raw appended data");
  data_ = begin + 1;

  pugi::xml_document document;
  std::string const xml = bytes_.substr(0, appended) + "</VTKFile>";
  if (!document.load_buffer(xml.data(), xml.size())) refuse("its XML header is damaged");
  pugi::xml_node const root = document.child("VTKFile");
  if (std::string_view(root.attribute("compressor").value()) != "vtkZLibDataCompressor" ||
      std::string_view(root.attribute("header_type").value()) != "UInt64" ||
      std::string_view(root.attribute("byte_order").value()) != "LittleEndian")
    refuse("expected zlib blocks with UInt64 headers, little endian");
  pugi::xml_node const piece = root.child("UnstructuredGrid").child("Piece");
  points_ = static_cast<std::size_t>(piece.attribute("NumberOfPoints").as_ullong());
  cells_ = static_cast<std::size_t>(piece.attribute("NumberOfCells").as_ullong());
  for (char const* section : {"PointData", "CellData", "Points", "Cells"})
    for (pugi::xml_node const a : piece.child(section).children("DataArray")) {
      std::string const name = a.attribute("Name").value();
      auto const components = static_cast<std::size_t>(a.attribute("NumberOfComponents").as_ullong(1));
      std::string_view const place = section;
      std::size_t const count = place == "PointData" || place == "Points"    ? points_
                                : name == "connectivity" && place == "Cells" ? 0
                                                                             : cells_;
      entries_[fmt::format("{}/{}", section, name)] = {
          a.attribute("type").value(), static_cast<std::size_t>(a.attribute("offset").as_ullong()),
          count * components};
    }
}

bool VtuFile::has(std::string const& section, std::string const& name) const {
  return entries_.contains(section + "/" + name);
}

template <class To> std::vector<To> VtuFile::read(std::string const& section, std::string const& name) const {
  auto const found = entries_.find(section + "/" + name);
  if (found == entries_.end()) refuse(fmt::format("it has no array '{}' under {}", name, section));
  Entry const& e = found->second;
  std::string raw;
  try {
    raw = inflate_blocks(bytes_, data_ + e.offset);
  } catch (std::runtime_error const& error) {
    refuse(fmt::format("array '{}': {}", name, error.what()));
  }
  auto values = converted_from<To>(e.type, raw);
  if (e.values > 0 && values.size() != e.values)
    refuse(fmt::format("array '{}' has {} values instead of {}", name, values.size(), e.values));
  return values;
}

std::vector<float> VtuFile::floats(std::string const& section, std::string const& name) const {
  return read<float>(section, name);
}
std::vector<double> VtuFile::doubles(std::string const& section, std::string const& name) const {
  return read<double>(section, name);
}
std::vector<std::int64_t> VtuFile::integers(std::string const& section, std::string const& name) const {
  return read<std::int64_t>(section, name);
}

} // namespace fissura::output

#include "fissura/output/read_frame.hpp"

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <iterator>
#include <pugixml.hpp>
#include <stdexcept>
#include <type_traits>
#include <zlib.h>

#include "fissura/core/error.hpp"
#include "fissura/output/atomic_file.hpp"

namespace fissura::output {

namespace {

/// A block holds at most 128 KiB as written; a header that says far more is damaged.
constexpr std::uint64_t largest_block = std::uint64_t{1} << 26;
/// zlib makes nothing smaller than a 1032nd: what says that it unpacks to more would only fill the memory.
constexpr std::uint64_t most_packed = 1040;
constexpr std::size_t most_components = 9;

std::uint64_t word(std::string_view bytes, std::size_t at) {
  if (at > bytes.size() || bytes.size() - at < sizeof(std::uint64_t))
    throw std::runtime_error("it ends in the middle of an array");
  std::uint64_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

/// A pipe or a device would never end.
void check_kind(std::string const& path) {
  std::error_code ec;
  auto const status = std::filesystem::status(path, ec);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw core::Error(core::Failure::io, fmt::format("cannot read '{}': it is no file", path));
}

std::string read_file(std::string const& path) {
  check_kind(path);
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
  if constexpr (std::is_floating_point_v<To>) { // a fraction as a number of something is damage
    if (type == "Float32") return converted<float, To>(raw);
    if (type == "Float64") return converted<double, To>(raw);
  }
  if (type == "UInt8") return converted<std::uint8_t, To>(raw);
  if (type == "Int32") return converted<std::int32_t, To>(raw);
  if (type == "Int64") return converted<std::int64_t, To>(raw);
  throw std::runtime_error(fmt::format("it cannot be of type '{}'", type));
}

} // namespace

std::string inflate_blocks(std::string_view bytes, std::size_t at, std::size_t most) {
  std::uint64_t const blocks = word(bytes, at), full = word(bytes, at + 8), last = word(bytes, at + 16);
  if (blocks > bytes.size() || full > largest_block || last > full ||
      blocks * full > most_packed * bytes.size() + largest_block)
    throw std::runtime_error("an array has no valid header");
  if (blocks > 0 && (blocks - 1) * full + (last > 0 ? last : full) > most)
    throw std::runtime_error("it holds more than its header says");
  std::size_t from = at + 8 * (3 + static_cast<std::size_t>(blocks));
  std::string out, block;
  for (std::uint64_t b = 0; b < blocks; ++b) {
    auto const packed = static_cast<std::size_t>(word(bytes, at + 24 + 8 * static_cast<std::size_t>(b)));
    if (from > bytes.size() || packed > bytes.size() - from)
      throw std::runtime_error("it ends in the middle of an array");
    uLongf size = static_cast<uLongf>(b + 1 == blocks && last > 0 ? last : full);
    if (size > most_packed * packed) throw std::runtime_error("a compressed block is damaged");
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

void FrameFile::refuse(std::string const& why) const {
  throw core::Error(core::Failure::io, fmt::format("cannot read '{}': {}", path_, why));
}

FrameFile::FrameFile(std::string path) : path_(std::move(path)), bytes_(read_file(path_)) {
  constexpr std::string_view mark = "<AppendedData encoding=\"raw\">";
  std::size_t const appended = bytes_.find(mark);
  std::size_t const begin =
      appended == std::string::npos ? std::string::npos : bytes_.find('_', appended + mark.size());
  if (begin == std::string::npos) refuse("no frame with raw appended data");
  data_ = begin + 1;
  describe(bytes_.substr(0, appended) + "</VTKFile>");
}

std::size_t FrameFile::count_of(std::string const& text, char const* what) const {
  std::size_t value = 0;
  auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  // Every point and every cell takes at least a byte before it is packed.
  if (error != std::errc{} || end != text.data() + text.size() || value > most_packed * bytes_.size())
    refuse(fmt::format("its header says '{}' for {}", text, what));
  return value;
}

void FrameFile::describe(std::string const& header) {
  pugi::xml_document document;
  if (!document.load_buffer(header.data(), header.size())) refuse("its XML header is damaged");
  pugi::xml_node const root = document.child("VTKFile");
  if (std::string_view(root.attribute("compressor").value()) != "vtkZLibDataCompressor" ||
      std::string_view(root.attribute("header_type").value()) != "UInt64" ||
      std::string_view(root.attribute("byte_order").value()) != "LittleEndian")
    refuse("expected zlib blocks with UInt64 headers, little endian");
  pugi::xml_node const piece = root.child(root.attribute("type").value()).child("Piece");
  auto const number = [&](char const* name, bool required) {
    pugi::xml_attribute const a = piece.attribute(name);
    return a || required ? count_of(a.value(), name) : 0;
  };
  points_ = number("NumberOfPoints", true);
  std::map<std::string, std::size_t> const cells{{"Cells", number("NumberOfCells", false)},
                                                 {"Verts", number("NumberOfVerts", false)},
                                                 {"Lines", number("NumberOfLines", false)},
                                                 {"Strips", number("NumberOfStrips", false)},
                                                 {"Polys", number("NumberOfPolys", false)}};
  for (auto const& [section, count] : cells) cells_ += count;
  for (pugi::xml_node const section : piece.children())
    for (pugi::xml_node const a : section.children("DataArray")) {
      std::string const place = section.name(), name = a.attribute("Name").value();
      Entry e{.type = a.attribute("type").value(),
              .offset = count_of(a.attribute("offset").value(), "an offset"),
              .components = count_of(a.attribute("NumberOfComponents").as_string("1"), "NumberOfComponents"),
              .tuples = {}};
      if (e.components < 1 || e.components > most_components)
        refuse(fmt::format("array '{}' has {} components", name, e.components));
      if (place == "PointData" || place == "Points")
        e.tuples = points_;
      else if (place == "CellData")
        e.tuples = cells_;
      else if (cells.contains(place) && name != "connectivity")
        e.tuples = cells.at(place);
      entries_[place + "/" + name] = e;
    }
}

bool FrameFile::has(std::string const& section, std::string const& name) const {
  return entries_.contains(section + "/" + name);
}

template <class To>
std::vector<To> FrameFile::read(std::string const& section, std::string const& name,
                                std::size_t components) const {
  auto const found = entries_.find(section + "/" + name);
  if (found == entries_.end()) refuse(fmt::format("it has no array '{}' under {}", name, section));
  Entry const& e = found->second;
  if (e.components != components)
    refuse(fmt::format("array '{}' has {} components instead of {}", name, e.components, components));
  // No type has more than eight bytes, and no cell that is written more points than four or than there are.
  std::size_t const most = 8 * components * e.tuples.value_or(points_ + 4 * cells_);
  std::vector<To> values;
  try {
    values = converted_from<To>(e.type, inflate_blocks(bytes_, data_ + e.offset, most));
  } catch (std::runtime_error const& error) {
    refuse(fmt::format("array '{}': {}", name, error.what()));
  }
  if (e.tuples && values.size() != *e.tuples * components)
    refuse(
        fmt::format("array '{}' has {} values instead of {}", name, values.size(), *e.tuples * components));
  return values;
}

std::vector<float> FrameFile::floats(std::string const& section, std::string const& name,
                                     std::size_t components) const {
  return read<float>(section, name, components);
}
std::vector<double> FrameFile::doubles(std::string const& section, std::string const& name,
                                       std::size_t components) const {
  return read<double>(section, name, components);
}
std::vector<std::int64_t> FrameFile::integers(std::string const& section, std::string const& name) const {
  return read<std::int64_t>(section, name, 1);
}

CellList FrameFile::cell_list(std::string const& section) const {
  CellList list{integers(section, "connectivity"), integers(section, "offsets")};
  std::int64_t last = 0;
  for (std::int64_t const end : list.offsets) {
    if (end < last) refuse("the offsets of its cells decrease");
    last = end;
  }
  if (last != static_cast<std::int64_t>(list.connectivity.size()))
    refuse(fmt::format("its last cell ends at {} of {} corners", last, list.connectivity.size()));
  for (std::int64_t const point : list.connectivity)
    if (point < 0 || point >= static_cast<std::int64_t>(points_))
      refuse(fmt::format("a cell names point {} of {}", point, points_));
  return list;
}

} // namespace fissura::output

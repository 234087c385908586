#pragma once
// A reader of .vtu files that shares nothing with the writer: plain string search, block by block inflation.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>
#include <zlib.h>

namespace fissura::output::testing {

struct ReadArray {
  std::string type, section, unit;
  int components = 0;
  std::uint64_t blocks = 0;
  std::string bytes;

  template <class T> std::vector<T> as() const {
    std::vector<T> values(bytes.size() / sizeof(T));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
    return values;
  }
};

inline std::string attribute(std::string const& tag, std::string const& name) {
  std::size_t const at = tag.find(" " + name + "=\"");
  if (at == std::string::npos) throw std::runtime_error("no attribute " + name + " in " + tag);
  std::size_t const begin = at + name.size() + 3;
  return tag.substr(begin, tag.find('"', begin) - begin);
}

class VtuReader {
 public:
  explicit VtuReader(std::string const& file) : file_(file) {
    std::string const mark = "<AppendedData encoding=\"raw\">_";
    std::size_t const at = file.find(mark);
    if (at == std::string::npos) throw std::runtime_error("no appended data");
    data_ = at + mark.size();
    header = file.substr(0, at);
    for (char const* section : {"PointData", "CellData", "Points", "Cells"}) read_section(section);
  }
  std::string header;                      ///< the XML before the data
  std::map<std::string, ReadArray> arrays; ///< by name

 private:
  void read_section(std::string const& section) {
    std::size_t at = header.find("<" + section + ">");
    std::size_t const end = header.find("</" + section + ">");
    if (at == std::string::npos || end == std::string::npos) return; // an empty section: <PointData />
    while ((at = header.find("<DataArray", at)) < end) {
      std::size_t const close = header.find('>', at);
      std::string const tag = header.substr(at, close - at);
      ReadArray a;
      a.section = section;
      a.type = attribute(tag, "type");
      a.components = std::stoi(attribute(tag, "NumberOfComponents"));
      inflate(std::stoull(attribute(tag, "offset")), a);
      std::size_t const next = std::min(header.find("<DataArray", close), end);
      std::size_t const key = header.find("location=\"vtkDataArray\">", close);
      if (key < next) a.unit = header.substr(key + 24, header.find('<', key) - key - 24);
      arrays[attribute(tag, "Name")] = a;
      at = close;
    }
  }

  std::uint64_t word(std::size_t at) const {
    std::uint64_t w = 0;
    std::memcpy(&w, file_.data() + at, sizeof w);
    return w;
  }

  void inflate(std::size_t offset, ReadArray& a) const {
    std::size_t const begin = data_ + offset;
    a.blocks = word(begin);
    std::uint64_t const full = word(begin + 8), last = word(begin + 16);
    std::size_t in = begin + 8 * (3 + a.blocks);
    for (std::uint64_t b = 0; b < a.blocks; ++b) {
      std::uint64_t const packed = word(begin + 8 * (3 + b));
      uLongf size = b + 1 == a.blocks && last != 0 ? last : full;
      uLongf const expected = size;
      std::string block(size, '\0');
      int const status = ::uncompress(reinterpret_cast<Bytef*>(block.data()), &size,
                                      reinterpret_cast<Bytef const*>(file_.data() + in), packed);
      if (status != Z_OK || size != expected) throw std::runtime_error("a block does not inflate");
      a.bytes += block;
      in += packed;
    }
  }

  std::string const& file_;
  std::size_t data_ = 0;
};

} // namespace fissura::output::testing

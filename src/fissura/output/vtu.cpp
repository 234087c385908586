#include "fissura/output/vtu.hpp"

#include <bit>
#include <fmt/core.h>
#include <pugixml.hpp>
#include <span>
#include <sstream>
#include <string_view>
#include <type_traits>

#include "fissura/core/error.hpp"
#include "fissura/output/atomic_file.hpp"
#include "fissura/output/zlib_blocks.hpp"

namespace fissura::output {

namespace {

static_assert(sizeof(Vec3) == 3 * sizeof(double), "points are written as they lie in memory");

template <class T> constexpr char const* vtk_type() {
  if constexpr (std::is_same_v<T, float>)
    return "Float32";
  else if constexpr (std::is_same_v<T, double>)
    return "Float64";
  else if constexpr (std::is_same_v<T, std::uint8_t>)
    return "UInt8";
  else if constexpr (std::is_same_v<T, std::int32_t>)
    return "Int32";
  else
    return "Int64";
}

template <class T> std::string_view bytes_of(std::vector<T> const& values) {
  return {reinterpret_cast<char const*>(values.data()), values.size() * sizeof(T)};
}

/// Collects the compressed arrays and their descriptions in the XML header, each with its offset in the data.
class AppendedData {
 public:
  pugi::xml_node add(pugi::xml_node parent, char const* type, std::string_view name, int components,
                     std::string_view bytes) {
    pugi::xml_node node = parent.append_child("DataArray");
    node.append_attribute("type") = type;
    node.append_attribute("Name") = std::string(name).c_str();
    node.append_attribute("NumberOfComponents") = components;
    node.append_attribute("format") = "appended";
    node.append_attribute("offset") = static_cast<unsigned long long>(size_);
    size_ += chunks_.emplace_back(zlib_blocks(bytes)).size();
    return node;
  }
  std::vector<std::string> const& chunks() const { return chunks_; }

 private:
  std::vector<std::string> chunks_;
  std::size_t size_ = 0;
};

[[noreturn]] void refuse(std::string const& path, std::string const& why) {
  throw core::Error(core::Failure::run, fmt::format("cannot write '{}': {}", path, why));
}

void check_fields(std::string const& path, std::span<Array const> arrays, std::size_t count,
                  char const* place) {
  for (Array const& a : arrays) {
    std::size_t const size = std::visit([](auto const& v) { return v.size(); }, a.values);
    if (a.components < 1 || size != count * static_cast<std::size_t>(a.components)) {
      refuse(path, fmt::format("array '{}' has {} values for {} {} of {} components", a.name, size, count,
                               place, a.components));
    }
  }
}

/// A file that a viewer would crash on must not be written: it would hide the mistake until long after the
/// run.
void check(std::string const& path, Grid const& g) {
  if (g.offsets.size() != g.types.size()) {
    refuse(path, fmt::format("{} cell offsets but {} cell types", g.offsets.size(), g.types.size()));
  }
  std::int64_t begin = 0;
  for (std::int64_t const end : g.offsets) {
    if (end < begin) refuse(path, "cell offsets decrease");
    begin = end;
  }
  if (begin != static_cast<std::int64_t>(g.connectivity.size())) {
    refuse(path,
           fmt::format("the last cell ends at {} of {} connectivity entries", begin, g.connectivity.size()));
  }
  for (std::int64_t const point : g.connectivity) {
    if (point < 0 || point >= static_cast<std::int64_t>(g.points.size())) {
      refuse(path, fmt::format("a cell names point {} of {}", point, g.points.size()));
    }
  }
  check_fields(path, g.point_data, g.points.size(), "points");
  check_fields(path, g.cell_data, g.types.size(), "cells");
}

void add_fields(AppendedData& data, pugi::xml_node parent, std::vector<Array> const& arrays) {
  for (Array const& a : arrays) {
    pugi::xml_node const node = std::visit(
        [&]<class T>(std::vector<T> const& v) {
          return data.add(parent, vtk_type<T>(), a.name, a.components, bytes_of(v));
        },
        a.values);
    if (a.unit.empty()) continue;
    pugi::xml_node key = pugi::xml_node(node).append_child("InformationKey");
    key.append_attribute("name") = "UNITS_LABEL";
    key.append_attribute("location") = "vtkDataArray";
    key.text() = a.unit.c_str();
  }
}

void describe(pugi::xml_node root, Grid const& g, AppendedData& data) {
  root.append_attribute("type") = "UnstructuredGrid";
  root.append_attribute("version") = "1.0";
  root.append_attribute("byte_order") =
      std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
  root.append_attribute("header_type") = "UInt64";
  root.append_attribute("compressor") = "vtkZLibDataCompressor";
  pugi::xml_node piece = root.append_child("UnstructuredGrid").append_child("Piece");
  piece.append_attribute("NumberOfPoints") = static_cast<unsigned long long>(g.points.size());
  piece.append_attribute("NumberOfCells") = static_cast<unsigned long long>(g.types.size());
  add_fields(data, piece.append_child("PointData"), g.point_data);
  add_fields(data, piece.append_child("CellData"), g.cell_data);
  data.add(piece.append_child("Points"), "Float64", "Points", 3, bytes_of(g.points));
  pugi::xml_node cells = piece.append_child("Cells");
  data.add(cells, "Int64", "connectivity", 1, bytes_of(g.connectivity));
  data.add(cells, "Int64", "offsets", 1, bytes_of(g.offsets));
  data.add(cells, "UInt8", "types", 1, bytes_of(g.types));
}

} // namespace

void write_vtu(std::string const& path, Grid const& grid) {
  check(path, grid);
  pugi::xml_document document;
  pugi::xml_node root = document.append_child("VTKFile");
  AppendedData data;
  describe(root, grid, data);
  pugi::xml_node appended = root.append_child("AppendedData");
  appended.append_attribute("encoding") = "raw";
  appended.text() = "_"; // the raw bytes follow this mark, where offsets count from

  std::ostringstream text;
  document.save(text, " ");
  std::string const xml = text.str();
  std::size_t const mark = xml.rfind("_</AppendedData>") + 1;

  AtomicFile file(path);
  file.write(std::string_view(xml).substr(0, mark));
  for (std::string const& chunk : data.chunks()) file.write(chunk);
  file.write(std::string_view(xml).substr(mark));
  file.commit();
}

} // namespace fissura::output

#include "fissura/output/vtk_file.hpp"

#include <bit>
#include <fmt/core.h>
#include <span>
#include <sstream>

#include "fissura/core/error.hpp"
#include "fissura/output/atomic_file.hpp"
#include "fissura/output/zlib_blocks.hpp"

namespace fissura::output {

static_assert(sizeof(Vec3) == 3 * sizeof(double), "points are written as they lie in memory");

namespace {

void check_fields(std::string const& path, std::span<Array const> arrays, std::size_t count,
                  char const* place) {
  for (Array const& a : arrays) {
    std::size_t const size = std::visit([](auto const& v) { return v.size(); }, a.values);
    if (a.components < 1 || size != count * static_cast<std::size_t>(a.components)) {
      refuse_grid(path, fmt::format("array '{}' has {} values for {} {} of {} components", a.name, size,
                                    count, place, a.components));
    }
  }
}

} // namespace

void refuse_grid(std::string const& path, std::string const& why) {
  throw core::Error(core::Failure::run, fmt::format("cannot write '{}': {}", path, why));
}

void check_grid(std::string const& path, Grid const& g) {
  if (g.offsets.size() != g.types.size()) {
    refuse_grid(path, fmt::format("{} cell offsets but {} cell types", g.offsets.size(), g.types.size()));
  }
  std::int64_t begin = 0;
  for (std::int64_t const end : g.offsets) {
    if (end < begin) refuse_grid(path, "cell offsets decrease");
    begin = end;
  }
  if (begin != static_cast<std::int64_t>(g.connectivity.size())) {
    refuse_grid(path, fmt::format("the last cell ends at {} of {} connectivity entries", begin,
                                  g.connectivity.size()));
  }
  for (std::int64_t const point : g.connectivity) {
    if (point < 0 || point >= static_cast<std::int64_t>(g.points.size())) {
      refuse_grid(path, fmt::format("a cell names point {} of {}", point, g.points.size()));
    }
  }
  check_fields(path, g.point_data, g.points.size(), "points");
  check_fields(path, g.cell_data, g.types.size(), "cells");
}

VtkFile::VtkFile(char const* kind) : root_(document_.append_child("VTKFile")) {
  root_.append_attribute("type") = kind;
  root_.append_attribute("version") = "1.0";
  root_.append_attribute("byte_order") =
      std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
  root_.append_attribute("header_type") = "UInt64";
  root_.append_attribute("compressor") = "vtkZLibDataCompressor";
  body_ = root_.append_child(kind);
}

pugi::xml_node VtkFile::add(pugi::xml_node parent, char const* type, std::string_view name, int components,
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

void VtkFile::add_frame_data(Grid const& grid) {
  if (!grid.time && grid.names.empty()) return;
  pugi::xml_node field = body_.append_child("FieldData");
  if (grid.time)
    add(field, "TimeValue", 1, std::vector<double>{*grid.time}).append_attribute("NumberOfTuples") = 1;
  for (Names const& list :
       grid.names) { // as VTK writes text: the number of each byte, a zero after each name
    pugi::xml_node node = field.append_child("Array");
    node.append_attribute("type") = "String";
    node.append_attribute("Name") = list.name.c_str();
    node.append_attribute("NumberOfTuples") = static_cast<unsigned long long>(list.names.size());
    node.append_attribute("format") = "ascii";
    std::string text;
    for (std::string const& name : list.names) {
      for (char const c : name) text += fmt::format("{} ", static_cast<unsigned char>(c));
      text += "0 ";
    }
    node.text() = text.c_str();
  }
}

void VtkFile::add_arrays(pugi::xml_node parent, std::vector<Array> const& arrays) {
  for (Array const& a : arrays) {
    pugi::xml_node const node =
        std::visit([&](auto const& v) { return add(parent, a.name, a.components, v); }, a.values);
    if (a.unit.empty()) continue;
    pugi::xml_node key = pugi::xml_node(node).append_child("InformationKey");
    key.append_attribute("name") = "UNITS_LABEL";
    key.append_attribute("location") = "vtkDataArray";
    key.text() = a.unit.c_str();
  }
}

void VtkFile::add_fields(pugi::xml_node piece, Grid const& grid) {
  add_arrays(piece.append_child("PointData"), grid.point_data);
  add_arrays(piece.append_child("CellData"), grid.cell_data);
  add(piece.append_child("Points"), "Points", 3, grid.points);
}

void VtkFile::save(std::string const& path) {
  pugi::xml_node appended = root_.append_child("AppendedData");
  appended.append_attribute("encoding") = "raw";
  appended.text() = "_"; // the raw bytes follow this mark, where offsets count from

  std::ostringstream text;
  document_.save(text, " ");
  std::string const xml = text.str();
  std::size_t const mark = xml.rfind("_</AppendedData>") + 1;

  AtomicFile file(path);
  file.write(std::string_view(xml).substr(0, mark));
  for (std::string const& chunk : chunks_) file.write(chunk);
  file.write("\n"); // VTK does not ask for it, but meshio reads the data up to the last line break
  file.write(std::string_view(xml).substr(mark));
  file.commit();
}

} // namespace fissura::output

#pragma once
// What the two kinds of frames share: an XML header that describes arrays, and after it the arrays themselves
// as raw data in zlib blocks. Used by vtu.cpp and vtp.cpp alone.
#include <cstdint>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "fissura/output/grid.hpp"

namespace fissura::output {

/// Collects the compressed arrays and their descriptions in the XML header, each with its offset in the data.
/// Arrays lie in the data in the order in which they are described, without gaps: meshio counts on it.
class VtkFile {
 public:
  /// kind: UnstructuredGrid or PolyData.
  explicit VtkFile(char const* kind);
  VtkFile(VtkFile const&) = delete;
  VtkFile& operator=(VtkFile const&) = delete;

  /// What belongs to the frame as a whole: its time, lists of names.
  void add_frame_data(Grid const& grid);
  pugi::xml_node add_piece() { return body_.append_child("Piece"); }
  /// Points with their fields, and the fields of the cells.
  void add_fields(pugi::xml_node piece, Grid const& grid);
  template <class T>
  pugi::xml_node add(pugi::xml_node parent, std::string_view name, int components,
                     std::vector<T> const& values) {
    return add(parent, vtk_type<T>(), name, components,
               {reinterpret_cast<char const*>(values.data()), values.size() * sizeof(T)});
  }
  /// Writes header and data; the file appears whole or not at all.
  void save(std::string const& path);

 private:
  template <class T> static constexpr char const* vtk_type();
  pugi::xml_node add(pugi::xml_node parent, char const* type, std::string_view name, int components,
                     std::string_view bytes);
  void add_arrays(pugi::xml_node parent, std::vector<Array> const& arrays);

  pugi::xml_document document_;
  pugi::xml_node root_, body_;
  std::vector<std::string> chunks_;
  std::size_t size_ = 0;
};

template <class T> constexpr char const* VtkFile::vtk_type() {
  if constexpr (std::is_same_v<T, float>)
    return "Float32";
  else if constexpr (std::is_same_v<T, double> || std::is_same_v<T, Vec3>)
    return "Float64";
  else if constexpr (std::is_same_v<T, std::uint8_t>)
    return "UInt8";
  else if constexpr (std::is_same_v<T, std::int32_t>)
    return "Int32";
  else
    return "Int64";
}

/// Throws core::Error(Failure::run) where the sizes of the grid contradict each other: a viewer would crash
/// on such a file, and hide the mistake until long after the run.
void check_grid(std::string const& path, Grid const& grid);

/// Throws core::Error(Failure::run) "cannot write '<path>': <why>".
[[noreturn]] void refuse_grid(std::string const& path, std::string const& why);

} // namespace fissura::output

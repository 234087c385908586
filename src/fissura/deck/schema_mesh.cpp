// [mesh] and [[mesh.box]].
#include <fmt/core.h>

#include <filesystem>

#include "fissura/deck/fields.hpp"
#include "fissura/deck/files.hpp"

namespace fissura::deck {
namespace {

using model::BoxSpec;
using model::MeshSpec;
using Written = std::optional<std::string>;
using units::Dimension;

void read_length_unit(Reader& r, Node const& n, Key const& k, MeshSpec& mesh) {
  auto const text = read_text(r, n, k);
  if (!text) return;
  // "mm" is what one writes; "25.4 mm" is allowed for drawings in odd units.
  bool const bare = text->empty() || text->find_first_of("0123456789") != 0;
  try {
    mesh.length_unit = units::to_si(bare ? "1 " + *text : *text, Dimension::length);
    if (!(mesh.length_unit > 0)) r.error(n, "`length_unit` must be > 0 m");
  } catch (core::Error const& e) {
    r.error(n, fmt::format("`length_unit` = {}: {}; here only the unit is meant, e.g. \"mm\"", shown(n),
                           e.what()));
  }
}

void check_file(Reader& reader, MeshSpec& mesh) {
  auto const place = reader.place(&mesh, "file");
  std::string const written = mesh.file;
  auto const extension = std::filesystem::path(written).extension();
  if (extension != ".msh" && extension != ".geo" && extension != ".inp")
    return reader.error(place, fmt::format("the mesh file \"{}\" must end in .msh, .geo or .inp", written));
  mesh.file = resolve_file(reader, place, written, mesh.allow_outside, "mesh file", "[mesh]");
}

void finish_mesh(Reader& reader, Node const& table, void* record) {
  auto& mesh = *static_cast<MeshSpec*>(record);
  Node const* boxes = table.find("box");
  bool const file = reader.given(record, "file");
  if (file && boxes)
    reader.error(boxes->key_place, "a mesh is either a `file` or [[mesh.box]] tables, not both");
  if (!file && !boxes) reader.error(table, "[mesh] needs a `file` or [[mesh.box]] tables");
  for (auto const key : {"length_unit", "element_size", "allow_outside"})
    if (!file && reader.given(record, key))
      reader.error(reader.place(record, key), fmt::format("`{}` belongs to `file`", key));
  if (!file || !reader.good(record, {"file"})) return;
  if (!reader.given(record, "length_unit"))
    reader.error(table,
                 "[mesh] needs `length_unit`: a mesh file carries no unit; write e.g. length_unit = \"mm\"");
  check_file(reader, mesh);
}

Section mesh_section() {
  Section s = single_section(
      "mesh", &model::Case::mesh,
      "The tetrahedral mesh: a file of gmsh, Abaqus or CalculiX, or boxes built in. Groups of the mesh are "
      "named in materials and selectors.");
  s.finish = finish_mesh;
  auto const has_file = [](MeshSpec const& m) { return !m.file.empty(); };
  Fields<MeshSpec> f(s.keys);
  f.text("file", &MeshSpec::file,
         "A gmsh mesh (.msh 2.2 or 4.1) or geometry (.geo), or an Abaqus or CalculiX mesh (.inp: C3D4, T3D2, "
         "sets, parts and instances), "
         "relative to the folder of the deck. The echo names it by its full path.")
      .default_is("none: boxes")
      .echoed_if(has_file);
  f.custom("length_unit", "a unit of length, e.g. `mm`",
           "Length unit of the file. Required with `file`: mesh files carry no unit.", read_length_unit,
           [](MeshSpec const& m) -> Written { return write_quantity(m.length_unit, Dimension::length); })
      .default_is("none")
      .echoed_if(has_file);
  f.quantity("element_size", &MeshSpec::element_size, Dimension::length,
             "Target element size for a .geo file; 0 leaves it to the file.")
      .not_negative()
      .echoed_if(has_file);
  // The echo lies in the run's folder and names the file by its full path: it must allow that.
  f.flag("separate", &MeshSpec::separate,
         "`true`: bodies of the file that touch without matching faces are apart and meet by contact.")
      .echoed_if(has_file);
  f.custom(
       "allow_outside", "`true` or `false`", "Lets `file` lie outside the folder of the deck.",
       [](Reader& r, Node const& n, Key const& k, MeshSpec& m) {
         m.allow_outside = read_flag(r, n, k).value_or(false);
       },
       [](MeshSpec const&) -> Written { return write_flag(true); })
      .default_is("`false`")
      .echoed_if(has_file);
  return s;
}

template <class Item, std::size_t n> std::string write_three(std::array<Item, n> const& values) {
  std::vector<std::string> items;
  for (auto const v : values) items.push_back(write_number(v));
  return write_array(items);
}

void read_cells(Reader& r, Node const& n, Key const& k, BoxSpec& box) {
  if (!read_array(r, n, k, 3)) return;
  for (std::size_t i = 0; i < 3; ++i)
    box.cells[i] = static_cast<int>(read_integer(r, n.items[i], k).value_or(1));
}

void read_grading(Reader& r, Node const& n, Key const& k, BoxSpec& box) {
  if (!read_array(r, n, k, 3)) return;
  for (std::size_t i = 0; i < 3; ++i) box.grading[i] = read_number(r, n.items[i], k).value_or(1);
}

void finish_box(Reader& reader, Node const& table, void* record) {
  auto const& box = *static_cast<BoxSpec const*>(record);
  bool const flat = box.from.x == box.to.x || box.from.y == box.to.y || box.from.z == box.to.z;
  if (flat && reader.good(record, {"from", "to"}))
    reader.error(table, "the box has no volume: `from` and `to` agree in a coordinate");
  constexpr double most_cells = 5e7;
  double const cells = 1.0 * box.cells[0] * box.cells[1] * box.cells[2];
  if (cells > most_cells)
    reader.error(reader.place(record, "cells"),
                 fmt::format("`cells` make {:.3g} cells; at most {:.0e} are allowed", cells, most_cells));
}

Section box_section() {
  Section s;
  s.path = "mesh.box";
  s.many = true;
  s.doc = "A box of cells, cut into tetrahedra. Boxes that share a face must have the same cells there. "
          "Several boxes may have the same name.";
  s.make = [](model::Case& c, std::size_t n) { c.mesh.boxes.resize(n); };
  s.count = [](model::Case const& c) { return c.mesh.boxes.size(); };
  s.record = [](model::Case& c, std::size_t i) -> void* { return &c.mesh.boxes[i]; };
  s.set_place = [](void* record, core::Place const& place) { static_cast<BoxSpec*>(record)->place = place; };
  s.finish = finish_box;
  Fields<BoxSpec> f(s.keys);
  f.name("name", &BoxSpec::name, "Volume group of its tetrahedra.");
  f.name("body", &BoxSpec::body,
         "Boxes of different bodies are not joined; they touch by contact, and their cells need not match.")
      .default_is("one body");
  f.point("from", &BoxSpec::from, "One corner.").required();
  f.point("to", &BoxSpec::to, "The opposite corner.").required();
  f.custom("cells", "three whole numbers", "Cells along x, y and z; at most 5e7 in all.", read_cells,
           [](BoxSpec const& b) -> Written { return write_three(b.cells); })
      .range({1, 1e6})
      .required();
  f.custom(
      "tets_per_cell", "6 or 24",
      "6: Kuhn's division, all planes of the grid are crack planes; 24: symmetric about the centre of the "
      "cell.",
      [](Reader& r, Node const& n, Key const& k, BoxSpec& box) {
        auto const value = read_integer(r, n, Wanted(k.name));
        if (value && *value != 6 && *value != 24)
          r.error(n, fmt::format("`tets_per_cell` must be 6 or 24, not {}", *value));
        box.tets_per_cell = value && *value == 24 ? 24 : 6;
      },
      [](BoxSpec const& b) -> Written { return std::to_string(b.tets_per_cell); });
  f.custom("grading", "three numbers",
           "Length of the last cell over that of the first, along each axis from `from` to `to`.",
           read_grading, [](BoxSpec const& b) -> Written { return write_three(b.grading); })
      .range({1e-3, 1e3});
  return s;
}

} // namespace

std::vector<Section> mesh_sections() {
  return {mesh_section(), box_section()};
}

} // namespace fissura::deck

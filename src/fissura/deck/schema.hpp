#pragma once
// The schema of the deck: every section and key, once. The checks, the defaults, the echo and the reference
// page are all read from here; a default is the initial value of the field in model/case.hpp and stands
// nowhere else.
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fissura/deck/node.hpp"
#include "fissura/model/case.hpp"
#include "fissura/units/dimension.hpp"

namespace fissura::deck {

class Reader;

/// Admissible values [SI]; an open end is itself not admissible.
struct Range {
  double min = -HUGE_VAL, max = HUGE_VAL;
  bool min_open = false, max_open = false;

  bool contains(double x) const { return (min_open ? x > min : x >= min) && (max_open ? x < max : x <= max); }
  bool limited() const { return std::isfinite(min) || std::isfinite(max); }
};
/// "> 0", "-1 < x < 0.5": for messages and the reference page.
std::string to_string(Range const& range, units::Dimension dimension);

/// One key of a section. A record is the struct of case.hpp that the section fills in.
struct Key {
  std::string name;
  std::string type; ///< for the reference page: "a pressure", "`x`, `y` or `z`"
  std::string doc;
  bool required = false;
  std::string default_note; ///< said instead of the initial value where that is a stand-in
  Range range;
  units::Dimension dimension = units::Dimension::none;
  std::function<void(Reader&, Node const&, Key const&, void* record)> read;
  /// The TOML text of the value; nothing where the echo leaves the key out.
  std::function<std::optional<std::string>(void const* record)> write;
};

/// An inline table that several keys share: where something is, or how it changes in time.
struct Shape {
  std::string name, doc;
  std::vector<Key> keys;
  std::function<void(Reader&, Node const&, void* record)> finish;
};

struct Section {
  std::string path;  ///< "concrete", "mesh.box"; empty for the keys at the top of the deck
  bool many = false; ///< [[concrete]] instead of [run]
  std::string doc;
  std::vector<Key> keys;
  std::function<void(model::Case&, std::size_t)> make; ///< makes room for so many records
  std::function<std::size_t(model::Case const&)> count;
  std::function<void*(model::Case&, std::size_t)> record;
  std::function<void(void* record, core::Place const&)> set_place;
  std::function<void(Reader&, Node const&, void* record)> finish; ///< checks across the keys of one record
};

/// "[run]", "[[bar]]", "the top of the deck".
std::string title(Section const& section);

/// All sections in the order of the echo and of the reference page; what is referred to comes first.
std::vector<Section> const& schema();

Shape const& selector_shape();
/// Its record is a model::PathSpec.
Shape const& path_shape();
/// Its record is a model::RecordSpec.
Shape const& record_shape();
/// Its record is a CurveDraft: the dimension of the values depends on the key that holds the curve.
Shape const& curve_shape();
struct CurveDraft {
  model::Curve curve;
  units::Dimension dimension = units::Dimension::none;
  std::string key{}; ///< that holds the curve
  std::string file{};
  bool allow_outside = false;
  int time_column = 1, value_column = 2; ///< of the file
  double time_step = 0, unit = 1;
};

/// What the readings of a gauge are.
units::Dimension dimension_of(model::GaugeSpec const& gauge);

// The parts of schema(), one file each.
std::vector<Section> mesh_sections();
std::vector<Section> material_sections();
std::vector<Section> bar_sections();
std::vector<Section> load_sections();
std::vector<Section> rigid_sections();
std::vector<Section> contact_sections();
std::vector<Section> run_sections();
std::vector<Section> gauge_sections();

} // namespace fissura::deck

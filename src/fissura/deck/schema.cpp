#include "fissura/deck/schema.hpp"

#include <fmt/core.h>

#include "fissura/deck/fields.hpp"
#include "fissura/units/units.hpp"

namespace fissura::deck {
namespace {

Section top_section() {
  Section s;
  s.doc = "Keys before the first section.";
  s.make = [](model::Case&, std::size_t) {};
  s.count = [](model::Case const&) { return std::size_t{1}; };
  s.record = [](model::Case& c, std::size_t) -> void* { return &c; };
  s.set_place = [](void*, core::Place const&) {};
  Fields<model::Case>(s.keys).text("title", &model::Case::title,
                                   "One line for the log, the report and the pictures.");
  return s;
}

} // namespace

std::string to_string(Range const& range, units::Dimension dimension) {
  auto const text = [&](double x) { return x == 0 ? "0" : units::from_si(x, dimension); };
  bool const below = std::isfinite(range.max), above = std::isfinite(range.min);
  if (above && below)
    return fmt::format("{} {} x {} {}", text(range.min),
                       range.min_open ? "<" : "<=", range.max_open ? "<" : "<=", text(range.max));
  if (above) return fmt::format("{} {}", range.min_open ? ">" : ">=", text(range.min));
  if (below) return fmt::format("{} {}", range.max_open ? "<" : "<=", text(range.max));
  return {};
}

std::string title(Section const& section) {
  if (section.path.empty()) return "the top of the deck";
  return section.many ? fmt::format("[[{}]]", section.path) : fmt::format("[{}]", section.path);
}

std::vector<Section> const& schema() {
  static std::vector<Section> const sections = [] {
    std::vector<Section> all{top_section()};
    for (auto part : {mesh_sections, material_sections, bar_sections, load_sections, contact_sections,
                      rigid_sections, run_sections, gauge_sections})
      for (auto& section : part()) all.push_back(std::move(section));
    return all;
  }();
  return sections;
}

} // namespace fissura::deck

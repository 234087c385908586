#include "fissura/deck/files.hpp"

#include <filesystem>
#include <fmt/core.h>

#include "fissura/deck/values.hpp"

namespace fissura::deck {
namespace {

bool lies_below(std::filesystem::path const& file, std::filesystem::path const& folder) {
  auto const inside = file.lexically_relative(folder);
  return !inside.empty() && *inside.begin() != "..";
}

} // namespace

std::string resolve_file(Reader& reader, core::Place const& place, std::string const& written,
                         bool allow_outside, std::string const& what, std::string const& table) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  fs::path const folder = fs::weakly_canonical(reader.the_case.folder, ignored);
  fs::path const file = fs::weakly_canonical(folder / fs::path(written), ignored);
  if (!allow_outside && !lies_below(file, folder))
    reader.error(place, fmt::format("the {} \"{}\" lies outside the deck's folder; move it there or set "
                                    "allow_outside = true in {}",
                                    what, written, table));
  else if (!fs::is_regular_file(file, ignored))
    reader.error(place,
                 fmt::format("there is no {} \"{}\" in {}", what, written, file.parent_path().string()));
  return file.string();
}

void read_columns(Reader& r, Node const& n, Key const& k, std::string const& value, int& time_column,
                  int& value_column) {
  bool const fits = n.kind == Node::Kind::array && (n.items.size() == 1 || n.items.size() == 2);
  if (!fits)
    return r.error(
        n, fmt::format("`columns` must be [time, {0}] or [{0}], numbered from 1, not {1}", value, shown(n)));
  value_column = static_cast<int>(read_integer(r, n.items.back(), k).value_or(1));
  time_column = n.items.size() == 2 ? static_cast<int>(read_integer(r, n.items.front(), k).value_or(1)) : 0;
  if (time_column == value_column) r.error(n, "`columns` names the same column twice");
}

std::optional<double> read_unit(Reader& r, Node const& n, Key const& k, units::Dimension dimension,
                                std::string const& example) {
  auto const text = read_text(r, n, k);
  if (!text) return std::nullopt;
  bool const bare = text->empty() || text->find_first_of("0123456789") != 0;
  try {
    double const unit = units::to_si(bare ? "1 " + *text : *text, dimension);
    if (unit > 0) return unit;
    r.error(n, fmt::format("`unit` = {} is no unit; give e.g. {}", shown(n), example));
  } catch (core::Error const& e) {
    r.error(
        n, fmt::format("`unit` = {}: {}; here only the unit is meant, e.g. {}", shown(n), e.what(), example));
  }
  return std::nullopt;
}

} // namespace fissura::deck

#include "fissura/deck/files.hpp"

#include <filesystem>
#include <fmt/core.h>

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

} // namespace fissura::deck

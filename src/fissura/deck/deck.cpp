#include "fissura/deck/deck.hpp"

#include <fmt/core.h>

#include <fstream>
#include <iterator>
#include <map>

#include "fissura/deck/cages.hpp"
#include "fissura/deck/checks.hpp"
#include "fissura/deck/fields.hpp"
#include "fissura/deck/reader.hpp"
#include "fissura/deck/scan.hpp"

namespace fissura::deck {
namespace {

std::string read_file(std::filesystem::path const& file) {
  std::error_code error;
  if (std::filesystem::is_regular_file(file / "case.toml", error))
    throw core::Error(core::Failure::input, fmt::format("{} is a folder; its deck is \"{}\"", file.string(),
                                                        (file / "case.toml").string()));
  if (!std::filesystem::is_regular_file(file, error))
    throw core::Error(core::Failure::input, fmt::format("there is no deck \"{}\"", file.string()));
  if (std::filesystem::file_size(file, error) > largest_deck)
    throw core::InputError({file.string()},
                           fmt::format("the deck is larger than {} MiB", largest_deck >> 20U));
  std::ifstream in(file, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (!in || in.bad())
    throw core::Error(core::Failure::io, fmt::format("cannot read the deck \"{}\"", file.string()));
  return text;
}

/// Applies all overrides and gathers what is wrong with each of them.
void apply_overrides(Reader& reader, Node& root, std::vector<std::string> const& overrides) {
  for (auto const& text : overrides) try {
      apply_override(root, text);
    } catch (core::InputError const& e) {
      for (auto const& d : e.diagnostics) reader.error(d.place, d.message);
    }
}

} // namespace

model::Case read_case_text(std::string_view text, std::string const& name,
                           std::vector<std::string> const& overrides) {
  namespace fs = std::filesystem;
  model::Case result;
  result.deck_file = name;
  result.folder = fs::absolute(fs::path(name)).parent_path().lexically_normal().string();
  Reader reader(result);
  Node root = parse(text, name);
  apply_overrides(reader, root, overrides);
  read_sections(reader, root);
  name_the_unnamed(result); // before the checks: a name given here may be taken
  make_cages(reader);
  check_case(reader);
  reader.throw_findings();
  hand_over_cages(result);
  return result;
}

model::Curve read_load_curve(std::string_view value, std::string const& key) {
  using units::Dimension;
  static std::map<std::string, Dimension, std::less<>> const dimensions{
      {"displacement", Dimension::length},
      {"velocity", Dimension::velocity},
      {"force", Dimension::force},
      {"traction", Dimension::pressure},
      {"acceleration", Dimension::acceleration}};
  auto const dimension = dimensions.find(key);
  if (dimension == dimensions.end())
    throw core::Error(
        core::Failure::input,
        fmt::format("a load has no `{}`: give displacement, velocity, force, traction or acceleration", key));
  model::Case nothing;
  Reader reader(nothing);
  Node const root = parse(fmt::format("{} = {}", key, value), key);
  Key wanted;
  wanted.name = key;
  model::Curve curve;
  read_curve(reader, root.items.at(0), wanted, dimension->second, curve);
  reader.throw_findings();
  return curve;
}

model::Case read_case(std::filesystem::path const& file, std::vector<std::string> const& overrides) {
  return read_case_text(read_file(file), file.string(), overrides);
}

} // namespace fissura::deck

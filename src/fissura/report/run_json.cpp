#include "fissura/report/run_json.hpp"

#include <algorithm>
#include <fmt/core.h>
#include <stdexcept>

#include "fissura/output/json.hpp"

namespace fissura::report {

using output::Json;

namespace {

constexpr int deepest = 32; ///< run.json has four levels; writing what has thousands would overrun the stack

/// How deep brackets stand in each other, outside of strings.
int depth_of(std::string const& text) {
  int depth = 0, most = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    char const c = text[i];
    if (quoted && c == '\\')
      ++i;
    else if (c == '"')
      quoted = !quoted;
    else if (!quoted && (c == '{' || c == '['))
      most = std::max(most, ++depth);
    else if (!quoted && (c == '}' || c == ']'))
      --depth;
  }
  return most;
}

constexpr char const* words[] = {"status",    "reason", "version", "title", "kernels", "stable_dt_limiter",
                                 "state_hash"};
constexpr char const* numbers[] = {"threads",
                                   "tets",
                                   "joints",
                                   "bar_elements",
                                   "bar_joints",
                                   "dt",
                                   "steps",
                                   "time",
                                   "mean_pace",
                                   "wall_seconds",
                                   "joints_damaged",
                                   "joints_cracked",
                                   "joints_broken",
                                   "bar_joints_activated",
                                   "bar_joints_yielded",
                                   "bars_broken",
                                   "added_mass",
                                   "total_mass",
                                   "energy_residual",
                                   "max_kinetic_ratio",
                                   "quasi_static_share",
                                   "force_imbalance",
                                   "tet_steps_per_second"};

void check_number(Json const& in, std::string const& key, std::string const& name) {
  auto const found = in.find(key);
  if (found != in.end() && !found->is_number() && !found->is_null())
    throw std::runtime_error(fmt::format("`{}` is no number", name));
}

/// What the page says of the pieces.
void check_fragments(Json const& run) {
  auto const found = run.find("fragments");
  if (found == run.end()) return;
  if (!found->is_object()) throw std::runtime_error("`fragments` is no object");
  check_number(*found, "count", "fragments.count");
  check_number(*found, "mass", "fragments.mass");
  auto const largest = found->find("largest");
  if (largest == found->end() || !largest->is_array() || largest->empty())
    throw std::runtime_error("`fragments.largest` is no list of pieces");
  for (Json const& piece : *largest) {
    if (!piece.is_object()) throw std::runtime_error("`fragments.largest` is no list of pieces");
    check_number(piece, "mass", "fragments.largest.mass");
  }
}

} // namespace

Json parse_run_json(std::string const& text) {
  if (depth_of(text) > deepest) throw std::runtime_error("its brackets stand too deep in each other");
  Json run = Json::parse(text, nullptr, false);
  if (!run.is_object()) throw std::runtime_error("no JSON object");
  for (char const* key : words)
    if (auto const found = run.find(key); found != run.end() && !found->is_string())
      throw std::runtime_error(fmt::format("`{}` is no text", key));
  if (!run.contains("status")) throw std::runtime_error("it has no `status`");
  for (char const* key : numbers) check_number(run, key, key);
  check_fragments(run);
  return run;
}

} // namespace fissura::report

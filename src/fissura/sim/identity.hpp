#pragma once
// What a checkpoint belongs to: deck, mesh, loads, program.
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "fissura/checkpoint/archive.hpp"
#include "fissura/model/model.hpp"

namespace fissura::sim {

struct Identity {
  std::string version, kernels; ///< of the program; of the instruction set
  std::string deck;             ///< echo without the keys that may change between two parts of a run
  std::string settings;         ///< echo with all of them
  std::uint64_t mesh = 0;       ///< hash of the mesh as it was read
  std::uint64_t records = 0;    ///< hash of the curves of loads, which may come from files
  double dt = 0;                ///< [s]
  static auto fields(auto& self) {
    return std::tie(self.version, self.kernels, self.deck, self.settings, self.mesh, self.records, self.dt);
  }
};

Identity identify(model::Model const& m, std::string const& version);

/// To be called after a load was changed in mid-run, which no deck tells: a restart is refused then.
void note_changed_loads(Identity& identity, model::Model const& m);

/// What two echoes of a deck do not have in common, a key a line: "[run] end_time = 2 s (was 1 s)".
std::vector<std::string> changed_keys(std::string const& saved, std::string const& now);

/// Refuses a checkpoint of another deck, mesh or record; returns warnings about what may change the last
/// digits.
std::vector<std::string> compare(Identity const& saved, Identity const& now, checkpoint::Loader const& from);

} // namespace fissura::sim

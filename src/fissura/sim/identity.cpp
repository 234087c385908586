#include "fissura/sim/identity.hpp"

#include <cmath>
#include <fmt/core.h>
#include <map>
#include <sstream>

#include "fissura/concrete/kernels.hpp"
#include "fissura/core/hash.hpp"
#include "fissura/deck/deck.hpp"

namespace fissura::sim {

using model::Model;

namespace {

/// Another kernel set finds nearly the same largest step, and goes on with the old one; more than this is
/// another model.
constexpr double admitted_difference = 1e-4;

class Fingerprint {
 public:
  template <class T> void add(std::vector<T> const& list) {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_same_v<T, bool>);
    add_number(list.size());
    hash_.add(list.data(), list.size() * sizeof(T));
  }
  void add(std::string const& text) {
    add_number(text.size());
    hash_.add(text.data(), text.size());
  }
  void add_number(std::uint64_t n) { hash_.add(&n, sizeof n); }
  std::uint64_t value() const { return hash_.value(); }

 private:
  core::Hash hash_;
};

std::uint64_t mesh_hash(mesh::Mesh const& mesh) {
  Fingerprint f;
  f.add(mesh.points);
  f.add(mesh.tets);
  f.add(mesh.tet_group);
  f.add(mesh.tet_body);
  f.add(mesh.input_id);
  for (auto const& name : mesh.volume_groups) f.add(name);
  for (auto const& g : mesh.face_groups) f.add(g.name), f.add(g.triangles);
  for (auto const& g : mesh.line_groups) f.add(g.name), f.add(g.segments);
  for (auto const& g : mesh.point_groups) f.add(g.name), f.add(g.points);
  return f.value();
}

std::uint64_t record_hash(Model const& m) {
  Fingerprint f;
  auto add = [&](model::TimedCurve const& timed) {
    auto const& c = timed.curve;
    f.add(c.times), f.add(c.values), f.add(c.slopes), f.add(c.peaks);
    f.add(std::vector<double>{timed.start, c.value, c.over, c.from, c.period});
    f.add_number(static_cast<std::uint64_t>(c.kind));
  };
  for (auto const& p : m.prescribed) add(p.motion), f.add_number(p.is_velocity);
  for (auto const& p : m.forces) add(p.curve);
  add(m.gravity.curve);
  return f.value();
}

/// Meshes and records are known by their contents, not by the names of their files.
model::Case without_file_names(Model const& m) {
  model::Case c = m.source;
  if (!c.mesh.file.empty()) c.mesh.file = "mesh";
  c.mesh.allow_outside = false;
  for (auto& motion : c.motions)
    if (motion.record) motion.record->file = "record", motion.record->allow_outside = false;
  return c;
}

/// Whether a path turns where this gauge says.
bool steers(Model const& m, std::string const& gauge) {
  for (auto const& motion : m.source.motions)
    if (motion.path)
      for (auto const& target : motion.path->targets)
        if (target.gauge == gauge) return true;
  return false;
}

/// What the state depends on. It knows nothing of the end of the run, of what is read and written on the way,
/// of threads and limits of one sitting: docs/reference/restart.md.
std::string deck_of(Model const& m) {
  model::Case c = without_file_names(m);
  model::RunSpec const usual;
  c.title.clear();
  c.run.end_time = usual.end_time, c.run.threads = usual.threads, c.run.max_steps = usual.max_steps;
  c.run.residual_warn = usual.residual_warn, c.run.residual_stop = usual.residual_stop;
  if (!c.stages.empty()) c.stages.back().duration = 0;
  std::erase_if(c.gauges, [&](auto const& gauge) { return !steers(m, gauge.name); });
  c.stops.clear();
  c.output = {};
  return deck::echo(c);
}

/// Value by place: "[[bar]] 2, diameter".
using Keys = std::map<std::string, std::string>;

Keys keys_of(std::string const& echo) {
  Keys keys;
  std::map<std::string, int> count;
  std::istringstream in(echo);
  std::string section;
  for (std::string line; std::getline(in, line);) {
    std::size_t const equals = line.find(" = ");
    if (line.starts_with("[["))
      section = fmt::format("{} {}, ", line, ++count[line]);
    else if (line.starts_with("["))
      section = line + " ";
    else if (!line.starts_with("#") && equals != std::string::npos)
      keys[section + line.substr(0, equals)] = line.substr(equals + 3);
  }
  return keys;
}

} // namespace

std::vector<std::string> changed_keys(std::string const& saved, std::string const& now) {
  auto const was = keys_of(saved), is = keys_of(now);
  std::vector<std::string> changes;
  for (auto const& [key, value] : is) {
    auto const old = was.find(key);
    if (old == was.end())
      changes.push_back(fmt::format("{} = {} (was not there)", key, value));
    else if (old->second != value)
      changes.push_back(fmt::format("{} = {} (was {})", key, value, old->second));
  }
  for (auto const& [key, value] : was)
    if (!is.contains(key)) changes.push_back(fmt::format("{} is gone (was {})", key, value));
  return changes;
}

Identity identify(Model const& m, std::string const& version) {
  return {version,
          std::string(concrete::kernels().name),
          deck_of(m),
          deck::echo(without_file_names(m)),
          mesh_hash(m.mesh),
          record_hash(m),
          m.dt};
}

void note_changed_loads(Identity& identity, Model const& m) {
  identity.records = record_hash(m);
}

std::vector<std::string> compare(Identity const& saved, Identity const& now, checkpoint::Loader const& from) {
  if (saved.deck != now.deck) {
    auto const changes = changed_keys(saved.deck, now.deck);
    from.refuse(
        fmt::format("the deck has changed since, and the state depends on it: {}{}; run it anew, or with the "
                    "deck as it was (what may change: the end of the run, output, gauges, stops)",
                    changes.empty() ? "the order of its items" : changes.front(),
                    changes.size() > 1 ? fmt::format(" and {} more", changes.size() - 1) : ""));
  }
  if (saved.mesh != now.mesh)
    from.refuse("the mesh has changed since; run it anew, or with the mesh as it was");
  if (saved.records != now.records)
    from.refuse("a record of a load has changed since, or a program has changed a load in mid-run; run it "
                "anew, or with the "
                "record as it was");
  if (!(std::abs(saved.dt - now.dt) <= admitted_difference * now.dt))
    from.refuse(fmt::format("the time step is {:.9g} s now and was {:.9g} s: the program finds another one, "
                            "go on with the version that wrote it ({})",
                            now.dt, saved.dt, saved.version));
  std::vector<std::string> warnings;
  if (saved.version != now.version)
    warnings.push_back(
        fmt::format("the checkpoint was written by version {}; this is {}: the last digits may "
                    "differ from those of an uninterrupted run",
                    saved.version, now.version));
  if (saved.kernels != now.kernels)
    warnings.push_back(fmt::format("the checkpoint was written with kernels {}; these are {}: results agree "
                                   "to rounding, not to the last bit (FISSURA_KERNELS chooses)",
                                   saved.kernels, now.kernels));
  return warnings;
}

} // namespace fissura::sim

#include "fissura/sim/identity.hpp"

#include <cmath>
#include <fmt/core.h>
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
  auto add = [&](model::Curve const& c) { f.add(c.times), f.add(c.values), f.add(c.slopes); };
  for (auto const& p : m.prescribed) add(p.motion.curve);
  for (auto const& p : m.forces) add(p.curve.curve);
  add(m.gravity.curve.curve);
  return f.value();
}

/// Threads and limits of one sitting, and how often checkpoints are written, may change between two parts of
/// a run. Meshes and records are known by their contents, not by the names of their files.
std::string deck_of(Model const& m) {
  model::Case c = m.source;
  model::OutputSpec const usual;
  c.run.threads = 0, c.run.max_steps = 0;
  c.output.checkpoint_every = usual.checkpoint_every, c.output.checkpoint_steps = usual.checkpoint_steps;
  c.output.hash_every = usual.hash_every;
  if (!c.mesh.file.empty()) c.mesh.file = "mesh";
  for (auto& motion : c.motions)
    if (motion.record) motion.record->file = "record";
  return deck::echo(c);
}

/// The first line in which two decks differ, in words.
std::string difference(std::string const& saved, std::string const& now) {
  std::istringstream a(saved), b(now);
  std::string was, is, section;
  while (true) {
    bool const more_a = static_cast<bool>(std::getline(a, was)),
               more_b = static_cast<bool>(std::getline(b, is));
    if (!more_a) was = "nothing";
    if (!more_b) is = "nothing";
    if (was != is || !(more_a && more_b)) break;
    if (is.starts_with("[")) section = is;
  }
  return fmt::format("{}: now `{}`, then `{}`", section.empty() ? "at its top" : "in " + section, is, was);
}

} // namespace

Identity identify(Model const& m, std::string const& version) {
  return {version, std::string(concrete::kernels().name), deck_of(m), mesh_hash(m.mesh), record_hash(m),
          m.dt};
}

std::vector<std::string> compare(Identity const& saved, Identity const& now, checkpoint::Loader const& from) {
  if (saved.deck != now.deck)
    from.refuse(fmt::format("the deck has changed since, {}; run it anew, or with the deck as it was",
                            difference(saved.deck, now.deck)));
  if (saved.mesh != now.mesh)
    from.refuse("the mesh has changed since; run it anew, or with the mesh as it was");
  if (saved.records != now.records)
    from.refuse("a record of a load has changed since; run it anew, or with the record as it was");
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

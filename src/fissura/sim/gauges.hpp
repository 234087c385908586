#pragma once
// The user's gauges: what each column of history.csv reads.
#include <string>
#include <tuple>
#include <vector>

#include "fissura/model/model.hpp"
#include "fissura/output/csv.hpp"
#include "fissura/state/state.hpp"

namespace fissura::sim {

/// A gauge resolved to what it reads.
struct Gauge {
  model::GaugeSpec spec;
  std::string unit;
  std::vector<int> nodes;      ///< displacement, velocity
  std::vector<int> prescribed; ///< reaction: indices into Model::prescribed
  std::vector<int> forces;     ///< force: indices into Model::forces
  std::vector<int> bodies;     ///< contact_*, impactor_*: indices into Model::rigid
  int bar_element = -1, bar_joint = -1;
  struct Crossing {
    int joint;
    std::array<double, 3> weight; ///< of the joint's three corner pairs
  };
  std::vector<Crossing> crossings; ///< crack_width
  std::vector<int> from, to;       ///< mean_strain: copies of the two end nodes
  Vec3 along;                      ///< unit vector of the gauge's line
  double length = 0;               ///< [m]
  int zero_stage = -1;
  bool reads_forces = false; ///< needs the reactions at u_n: read after the step
};

/// What a checkpoint holds of a gauge.
struct SavedGauge {
  std::string definition; ///< its keys in the deck
  double zero = 0, value = 0;
  bool is_zeroed = false;
  using ListGrows = void;
  static auto fields(auto& self) { return std::tie(self.definition, self.zero, self.value, self.is_zeroed); }
};

class Gauges {
 public:
  /// Throws core::InputError at the gauge's place for names or places that do not exist.
  explicit Gauges(model::Model const& m);

  std::vector<output::Column> columns() const;
  std::size_t size() const { return gauges_.size(); }
  /// Index of a gauge by name, or -1.
  int find(std::string const& name) const;

  /// Displacements, strains and bars at u_n: before the step moves on.
  void read_state(model::Model const& m, state::State const& s);
  /// Reactions and forces at u_n: after the step has found them. `time` is the load time of u_n.
  void read_forces(model::Model const& m, state::State const& s, double time);
  /// Takes the present readings as the zero of the gauges that name the stage that has just begun. (For the
  /// first stage the zero is the first reading.)
  void begin_stage(model::Model const& m, state::State const& s);
  /// The last readings, factor and zero applied.
  std::vector<double> const& values() const { return values_; }

  /// Its keys in the deck: what it is known by.
  std::string const& definition(std::size_t i) const { return definitions_[i]; }

  std::vector<SavedGauge> saved() const;
  /// Goes on from a checkpoint, maybe with other gauges. Throws core::InputError at a new one whose zero
  /// would be the reading at a time that has passed.
  void go_on_from(std::vector<SavedGauge> const& saved, model::Model const& m, state::State const& s);
  /// Whether a gauge was not among those of the checkpoint.
  std::vector<bool> const& is_new() const { return is_new_; }

 private:
  void store(std::size_t i, double raw);
  std::vector<Gauge> gauges_;
  std::vector<double> zero_, values_;
  std::vector<char> zeroed_;
  std::vector<std::string> definitions_;
  std::vector<bool> is_new_;
};

} // namespace fissura::sim

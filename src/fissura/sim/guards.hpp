#pragma once
// Finds out within ten steps that a run has gone wrong, and where. What moves betrays itself: a number that
// is not finite reaches the kinetic energy of the whole model in the same step, which costs one comparison.
// So does an account of a damaged joint, which spoils the joint's forces (concrete/batch_kernel.hpp). What
// else only remembers (bars, contact, loads) is looked at directly, every tenth step. See
// docs/reference/promises.md.
#include <optional>

#include "fissura/model/model.hpp"
#include "fissura/sim/trouble.hpp"
#include "fissura/state/state.hpp"

namespace fissura::sim {

class Guards {
 public:
  static constexpr long interval = 10; ///< steps within which a number that is not finite is found

  explicit Guards(model::Model const& m);

  /// To be called after every step.
  std::optional<Trouble> after_step(model::Model const& m, state::State const& s) const;

  /// Looks at everything at once: before a state is kept for good.
  std::optional<Trouble> look_everywhere(model::Model const& m, state::State const& s) const;

 private:
  std::optional<Trouble> find_runaway(model::Model const& m, state::State const& s) const;
  double fastest_ = 0;         ///< speed of pressure waves in the concrete [m/s]
  double kinetic_at_ease_ = 0; ///< with less kinetic energy no node can be that fast [J]
};

/// Trouble with a number that is not finite, wherever it is; with what made it so, if that can be seen.
Trouble not_finite(model::Model const& m, state::State const& s);
/// The tet that is turned inside out the most (J <= 0), if there is one.
std::optional<Trouble> inverted_tet(model::Model const& m, state::State const& s);

} // namespace fissura::sim

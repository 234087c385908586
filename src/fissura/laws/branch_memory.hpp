#pragma once
// The branches that a cyclic law has left and may come back to. An explicit run rings: a law that starts a
// new branch at each reversal and forgets the old one loses, at the first ripple, the branch the load has
// chosen.
//
// A branch is what a law follows while the strain goes one way. At a reversal the one that is left is
// remembered, and a new one begins. Later, in the same direction, the stress is never beyond a remembered
// branch: where the new one meets it, the old one is resumed as if it had never been left. So an inner loop
// closes, however small, and however many there are. Theory: docs/theory/inner_loops.md.
//
// One text for all laws. A law says what a branch is: see `follow`. It allocates nothing and has a fixed
// size.
#include <array>
#include <cmath>

namespace fissura::laws {

/// One branch of a law, from a reversal on.
struct Branch {
  double strain = 0, stress = 0; ///< where it begins: the last reversal
  double own_1 = 0, own_2 = 0;   ///< what the law alone knows the meaning of
  double left = 0;               ///< how far the path went along or below it; of remembered branches only
};

/// Branches of one direction, the outermost first.
struct BranchList {
  static constexpr int capacity = 4;
  std::array<Branch, capacity> at{};
  int count = 0;

  bool empty() const noexcept { return count == 0; }
  Branch& innermost() noexcept { return at[static_cast<std::size_t>(count - 1)]; }
  void drop_innermost() noexcept { at[static_cast<std::size_t>(--count)] = {}; }
  void remember(Branch const& branch) noexcept { at[static_cast<std::size_t>(count++)] = branch; }
  void forget(int which) noexcept {
    for (int i = which; i + 1 < count; ++i)
      at[static_cast<std::size_t>(i)] = at[static_cast<std::size_t>(i + 1)];
    drop_innermost();
  }
};

namespace detail {

template <class Path> BranchList& remembered(Path& path, int direction) noexcept {
  return direction > 0 ? path.rising : path.falling;
}

/// Remembered branches that do not lie beyond the present stress bound nothing and are dropped; one that does
/// not differ from it is resumed. Says whether one was. None is resumed inside one that a weaker law has left
/// behind: it may have been drawn towards that one (a straight line to its bound), and bounds nothing alone.
template <class Law, class Path> bool sort_out(Law const& law, Path& path, int direction) noexcept {
  auto& list = remembered(path, direction);
  int resumed = -1, passed = BranchList::capacity;
  for (int i = list.count - 1; i >= 0; --i) {
    auto const& branch = list.at[static_cast<std::size_t>(i)];
    double const beyond = direction * (law.stress_on(branch, direction, path.strain) - path.stress);
    if (beyond > law.indifferent()) continue;
    if (beyond < -law.indifferent())
      passed = i;
    else if (resumed < 0)
      path.now = branch, resumed = i;
    list.forget(i);
  }
  return resumed >= 0 && resumed < passed;
}

/// The remembered branch that bounds the stress most, if one does: -1 if the stress is beyond none. All are
/// asked: two branches may cross, and then the outer one is the closer.
template <class Law>
int closest_bound(Law const& law, BranchList const& list, int direction, double strain, double& stress) {
  int closest = -1;
  for (int i = list.count - 1; i >= 0; --i) {
    double const bound = law.stress_on(list.at[static_cast<std::size_t>(i)], direction, strain);
    double const allowed = closest < 0 ? law.indifferent() : 0;
    if (direction * (bound - stress) <= allowed) closest = i, stress = bound;
  }
  return closest;
}

/// Room for one more. Of the two neighbours that differ least in stress here, the inner one gives way (the
/// branch that is just left, if it is that one: then there is no need for room). A loop that would have
/// closed on it closes on the other one: so the error is that difference, and rippling, which fills a list,
/// makes the smallest.
template <class Law>
bool make_room(Law const& law, BranchList& list, int direction, double strain, double stress) {
  int closest = list.count;
  double least = std::abs(law.stress_on(list.innermost(), direction, strain) - stress);
  for (int i = 1; i < list.count; ++i) {
    auto const& outer = list.at[static_cast<std::size_t>(i - 1)];
    auto const& inner = list.at[static_cast<std::size_t>(i)];
    double const gap =
        std::abs(law.stress_on(outer, direction, strain) - law.stress_on(inner, direction, strain));
    if (gap < least) least = gap, closest = i;
  }
  if (closest == list.count) return false;
  list.forget(closest);
  return true;
}

template <class Law, class Path> void leave(Law const& law, Path& path) noexcept {
  auto& list = remembered(path, path.direction);
  for (int i = 0; i < list.count; ++i) {
    auto& left = list.at[static_cast<std::size_t>(i)].left;
    if (path.direction * (path.strain - left) > 0) left = path.strain;
  }
  path.now.left = path.strain;
  if (list.count < BranchList::capacity || make_room(law, list, path.direction, path.strain, path.stress))
    list.remember(path.now);
}

template <class Law, class Path> void turn(Law& law, Path& path, int direction) noexcept {
  bool const first = path.direction == 0;
  if (!first) leave(law, path);
  path.direction = direction;
  if (first || sort_out(law, path, direction)) return;
  path.now = law.branch_from(path.strain, path.stress, direction, remembered(path, direction));
}

} // namespace detail

/// The stress at the next strain. `law` provides
///   stress_on(branch, direction, strain)                  the stress on a branch
///   branch_from(strain, stress, direction, remembered)    the branch that begins at a reversal
///   indifferent()                                         a stress that makes no difference
/// where `remembered` are the branches of the new direction: the innermost is the one to be resumed first.
/// `path` has the last strain and stress, the direction (+1, -1, 0 at the start), the branch of `now` and the
/// remembered ones, `rising` and `falling`.
template <class Law, class Path> double follow(Law& law, Path& path, double strain) noexcept {
  if (strain != path.strain) {
    int const direction = strain > path.strain ? 1 : -1;
    if (direction != path.direction) detail::turn(law, path, direction);
    auto& opposite = detail::remembered(path, -direction);
    while (!opposite.empty() && direction * (strain - opposite.innermost().strain) > 0)
      opposite.drop_innermost(); // behind its beginning: that loop is over
  }
  double stress = law.stress_on(path.now, path.direction, strain);
  if (path.direction != 0) {
    auto& list = detail::remembered(path, path.direction);
    if (int const i = detail::closest_bound(law, list, path.direction, strain, stress); i >= 0) {
      path.now = list.at[static_cast<std::size_t>(i)];
      list.forget(i);
    }
  }
  path.strain = strain, path.stress = stress;
  return stress;
}

/// The law has weakened: of the stress, what is beyond `limit` is lost at the strain reached. A path that
/// unloads begins its branch anew: on the old one it would come back to the stress it has lost, and give back
/// energy that is gone.
template <class Law, class Path> void weaken(Law const& law, Path& path, double limit) noexcept {
  int const sign = path.stress > 0 ? 1 : -1;
  if (sign * (path.stress - limit) <= law.indifferent()) return;
  path.stress = limit;
  if (path.direction == sign) return; // loading on: the law bounds its branch by itself
  if (!detail::sort_out(law, path, -sign))
    path.now = law.branch_from(path.strain, limit, -sign, detail::remembered(path, -sign));
}

} // namespace fissura::laws

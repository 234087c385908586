#pragma once
// The kinetic energy of one step, v(n-1/2) -> v(n+1/2), in two parts.
//
//   at n:   1/2 m v_n^2,  v_n = (v- + v+)/2        what damping and guards ask for
//   kept:   1/2 m v- . v+ = the part at n less 1/8 m (v+ - v-)^2
//
// The part that is kept is what the ledger adds up: with the potential energy at u_n it is constant under
// central differences of a linear body, to rounding and at any step. The part at n alone wavers by
// (omega dt)^2/4 of a vibration's energy, which near the stable step is all of it.
namespace fissura::state {

struct Kinetic {
  double at_n = 0;      ///< [J]
  double of_change = 0; ///< 1/8 m (v+ - v-)^2 [J]; of the tets only where a reading is taken

  double kept() const { return at_n - of_change; }
  /// Adds a component of a node that goes from `before` to `after`; takes it away with a mass below zero.
  void add(double mass, double before, double after) {
    double const sum = before + after, change = after - before;
    at_n += 0.125 * mass * (sum * sum);
    of_change += 0.125 * mass * (change * change);
  }
  Kinetic& operator+=(Kinetic const& b) {
    at_n += b.at_n, of_change += b.of_change;
    return *this;
  }
};

} // namespace fissura::state

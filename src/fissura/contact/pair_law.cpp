#include "fissura/contact/pair_law.hpp"

#include <algorithm>
#include <cmath>

namespace fissura::contact {

namespace {

using state::ContactPair;

double square(Vec3 v) {
  return dot(v, v);
}

Vec3 at_point(TetNow const& t, std::array<Vec3, 4> const& field, Vec3 point) {
  Vec3 sum;
  for (int c = 0; c < 4; ++c) sum += t.lambda(c, point) * field[c];
  return sum;
}

/// The spring of a pair that no longer presses lets go; what it held is lost.
double let_go(ContactPair& memory) {
  double const held = 0.5 * memory.stiffness * square(memory.stretch);
  memory.stiffness = 0;
  memory.stretch = {};
  return held;
}

/// Friction force on a (b feels the opposite); `slide`: b relative to a over the step. Adds to `lost`.
Vec3 friction_force(ContactPair& memory, double stiffness, Vec3 normal, double limit, Vec3 slide,
                    double& lost) {
  // A stiffer spring keeps its force, a softer one its stretch: neither gains energy.
  Vec3 const before = memory.stiffness * memory.stretch;
  double const held = 0.5 * memory.stiffness * square(memory.stretch);
  double const keep = stiffness > memory.stiffness ? memory.stiffness / stiffness : 1;
  Vec3 start = keep * memory.stretch;
  start -= dot(start, normal) * normal; // the contact plane has turned
  lost += std::max(0.0, held - 0.5 * stiffness * square(start));

  Vec3 stretch = start + (slide - dot(slide, normal) * normal);
  double const size = stiffness * norm(stretch);
  if (size > limit) {
    Vec3 const kept = (limit / size) * stretch;
    lost += std::max(0.0, 0.5 * dot(before + stiffness * kept, stretch - kept)); // mean force times slip
    stretch = kept;
  }
  memory.stiffness = stiffness;
  memory.stretch = stretch;
  return stiffness * stretch;
}

} // namespace

PairResult pair_law(state::ContactScratch::PairConstants const& constants, PairNow const& now,
                    ContactPair& memory) {
  PairResult r;
  TetOverlap const o = overlap(now.a, now.b);
  double const energy = constants.stiffness * o.energy;
  if (memory.energy_at_start < 0 || memory.energy_at_start > energy) memory.energy_at_start = energy;
  if (!(energy > memory.energy_at_start)) {
    r.lost = let_go(memory);
    return r;
  }
  double const share = 1 - std::sqrt(memory.energy_at_start / energy), scale = share * constants.stiffness;
  r.stored = share * share * energy;
  double const press = scale * norm(o.force);
  // E = K g^2/2 and F = K g for a flat contact: K = F^2/(2 E)
  double const stiffness = tangential_share * square(constants.stiffness * o.force) / (2 * energy);
  Vec3 const slide = at_point(now.b, now.step_b, o.centroid) - at_point(now.a, now.step_a, o.centroid);
  Vec3 const drag =
      friction_force(memory, stiffness, unit(o.force), constants.friction * press, slide, r.lost);
  r.stored += 0.5 * memory.stiffness * square(memory.stretch);
  r.force.acts = true;
  for (int c = 0; c < 4; ++c) {
    r.force.on_a[c] = scale * o.on_a[c] + now.a.lambda(c, o.centroid) * drag;
    r.force.on_b[c] = scale * o.on_b[c] - now.b.lambda(c, o.centroid) * drag;
  }
  return r;
}

} // namespace fissura::contact

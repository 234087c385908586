#pragma once
// The full law of damaged joints, pack by pack. Included only by the files that are compiled per instruction
// set.
#include <cstddef>

#include "fissura/concrete/joint_frame.hpp"
#include "fissura/concrete/kernels.hpp"
#include "fissura/concrete/least_parting.hpp"

namespace fissura::concrete {
inline namespace FISSURA_ISA {

using state::JointBatch;

/// A pack of lanes of a HistoryRows, to read.
template <class V> struct KnownHistory {
  static constexpr int before = 15, lost = 24, handed_over = 27, farthest_squared = 28;
  static constexpr int accounts = lost; ///< from here on the law does not ask

  state::HistoryRows const& known;
  int lane0;

  V get(int row) const { return core::load<V>(known.row[row].data() + lane0); }
  /// 0 if all accounts are finite, else not a number.
  V zero_if_finite() const {
    V sum = get(accounts);
    for (int i = accounts + 1; i < state::JointHistory::doubles; ++i) sum = sum + get(i);
    return V(0.0) * sum;
  }
  laws::HistoryPack<V> point(int q) const {
    int const r = 5 * q;
    return {get(r), get(r + 1), get(r + 2), get(r + 3), get(r + 4)};
  }
  laws::SeparationPack<V> separation(int q) const {
    int const r = before + 3 * q;
    return {get(r), get(r + 1), get(r + 2)};
  }
};

/// The same, to change. Where faces merely open and close, most rows stay what they are: writing them costs
/// more than looking.
template <class V> struct PackHistory : KnownHistory<V> {
  using Known = KnownHistory<V>;
  using Known::get, Known::lane0, Known::before, Known::lost;

  state::HistoryRows& rows;

  PackHistory(state::HistoryRows& of, int from_lane) : Known{of, from_lane}, rows(of) {}

  void put(int row, V v) const { core::store<V>(rows.row[row].data() + lane0, v); }

  void renew_point(int q, laws::HistoryPack<V> const& was, laws::HistoryPack<V> const& is) const {
    // Not `!=`: what is no number has changed too.
    auto const is_same = is.kappa == was.kappa && is.z == was.z && is.f_s == was.f_s &&
                         is.slid_1 == was.slid_1 && is.slid_2 == was.slid_2;
    if (!core::any(!is_same)) return;
    int const r = 5 * q;
    put(r, is.kappa), put(r + 1, is.z), put(r + 2, is.f_s), put(r + 3, is.slid_1), put(r + 4, is.slid_2);
  }
  void set_separation(int q, laws::SeparationPack<V> const& s) const {
    int const r = before + 3 * q;
    put(r, s.opening), put(r + 1, s.sliding_1), put(r + 2, s.sliding_2);
  }
  /// Per area/3.
  void add_lost(V third, V kept, laws::DissipationPack<V> const& more) const {
    V const zero(0.0);
    auto const is_none = more.mode_I == zero && more.mode_II == zero && more.friction == zero;
    if (!core::any(!is_none)) return;
    put(lost, get(lost) + third * more.mode_I);
    put(lost + 1, get(lost + 1) + third * more.mode_II);
    put(lost + 2, get(lost + 2) + third * kept * more.friction);
  }
};
static_assert(offsetof(state::JointHistory, last) == 15 * sizeof(double));
static_assert(offsetof(state::JointHistory, dissipated) == 24 * sizeof(double));
static_assert(offsetof(state::JointHistory, handed_over) == 27 * sizeof(double));
static_assert(offsetof(state::JointHistory, farthest_squared) == 28 * sizeof(double));

/// One pack out of a batch, to read.
template <class V> struct KnownPack {
  DamagedPass const& pass;
  JointBatch const& known;
  int lane0;

  V row(JointBatch::Row const& r) const { return core::load<V>(r.data() + lane0); }

  JointFrame<V> frame() const {
    Vec<V> a[3], b[3];
    for (int k = 0; k < 3; ++k) {
      a[k] = core::load_vectors<V>(pass.u, known.node[k].data() + lane0);
      b[k] = core::load_vectors<V>(pass.u, known.node[k + 3].data() + lane0);
    }
    auto edge = [&](int i) { return core::load<V>(known.edge[i].data() + lane0); };
    auto f = joint_frame<V>(a, b, {edge(0), edge(1), edge(2)}, {edge(3), edge(4), edge(5)});
    add_axes(f);
    return f;
  }

  laws::LawPack<V> law(bool is_one_for_all) const {
    V four[3][4];
    for (int i = 0; i < 3; ++i) {
      double const* const rows = pass.laws + 4 * i;
      if (is_one_for_all)
        for (int r = 0; r < 4; ++r) four[i][r] = V(rows[known.law[0] + r]);
      else
        core::load_fours(rows, known.law.data() + lane0, four[i]);
    }
    V const one(1.0), per_k = row(known.per_k), strength = row(known.strength);
    V const f_t = strength * four[0][0], straight = four[2][1];
    V o_r = four[0][1];
    if (core::any(strength > one)) o_r = o_r / strength;
    return {row(known.k),
            per_k,
            f_t,
            (one + one - straight) * f_t * per_k,
            o_r,
            strength * four[1][3],
            strength * four[0][2],
            four[0][3],
            four[1][0],
            four[1][1],
            four[1][2],
            four[2][0],
            straight,
            four[2][2],
            four[2][3]};
  }

  /// Recoverable energy [J].
  V energy(state::HistoryRows const& histories) const {
    V const zero(0.0), one(1.0), broken = row(known.broken);
    KnownHistory<V> const history{histories, lane0};
    auto const f = frame();
    auto const p = law(known.has_one_law && !known.needs_care); // lanes that have just changed hands differ
    V sum = zero;
    for (int q = 0; q < 3; ++q)
      sum = sum + laws::stored_energy(p, history.point(q), separation_at(f, q), broken);
    return V(2.0) * row(known.weight) * (one - history.get(history.handed_over)) * sum; // area/3 per point
  }
};

/// The same, to act.
template <class V> struct BatchPack : KnownPack<V> {
  using Known = KnownPack<V>;
  using Known::pass, Known::lane0, Known::row, Known::frame, Known::law;

  JointBatch& batch;
  state::HistoryRows& histories;

  BatchPack(DamagedPass const& damaged, JointBatch& of, state::HistoryRows& rows, int from_lane)
      : Known{damaged, of, from_lane}, batch(of), histories(rows) {}

  void put(JointBatch::Row& r, V v) const { core::store<V>(r.data() + lane0, v); }

  /// Tractions, their forces on both sides, and what the step has dissipated.
  void act() const {
    V const zero(0.0), one(1.0), broken = row(batch.broken);
    auto const f = frame();
    auto const p = law(batch.has_one_law);
    PackHistory<V> const history(histories, lane0);
    // An account that is not finite makes the forces so: nobody has to go round and look (sim/guards.hpp).
    V const weight = row(batch.weight) + history.zero_if_finite();
    V const kept = one - history.get(history.handed_over);
    Vec<V> traction[3];
    laws::DissipationPack<V> lost{zero, zero, zero};
    V most = zero, least = one, farthest_squared = zero;
    for (int q = 0; q < 3; ++q) {
      auto const was = history.point(q);
      auto h = was;
      auto const now = separation_at(f, q);
      auto const t = laws::cohesive_law(p, h, now, history.separation(q), broken, lost);
      history.renew_point(q, was, h);
      history.set_separation(q, now);
      traction[q] = (kept * t.sigma) * f.normal + (kept * t.tau_1) * f.axis_1 + (kept * t.tau_2) * f.axis_2;
      most = core::larger(most, h.kappa), least = core::smaller(least, h.kappa);
      farthest_squared = core::larger(farthest_squared, core::dot(f.jump[q], f.jump[q]));
    }
    history.add_lost(V(2.0) * weight, kept, lost);
    history.put(history.farthest_squared, farthest_squared);
    auto const is_damaged = most > zero || broken > zero;
    note(core::choose(is_damaged, one, zero), core::choose(least >= one, one, zero), farthest_squared);

    // Half of each point's share (area/3) to each node of its edge.
    Vec<V> force[3];
    for (int k = 0; k < 3; ++k) force[k] = weight * (traction[k] + traction[(k + 2) % 3]);
    balance(f, force, core::choose(is_damaged, one, zero));
  }

  void note(V damaged, V failed, V farthest_squared) const {
    constexpr double far_per_weight = 6 * least_parting(1); // the weight is area/6
    if (core::any(damaged > row(batch.damaged) || failed > row(batch.failed) ||
                  farthest_squared >= V(far_per_weight) * row(batch.weight)))
      batch.has_event = true;
    put(batch.damaged, damaged), put(batch.failed, failed);
  }

  /// Adds forces that act alike on both sides of a joint and balance the moment of its tractions. These act
  /// on faces that have moved apart by `jump`, so with opposite forces alone a turning pair would gain or
  /// lose energy. They turn the mid-triangle as a rigid body would: theta x r, r from its centroid.
  void balance(JointFrame<V> const& f, Vec<V> const (&force)[3], V share) const {
    V const zero(0.0);
    Vec<V> const centre = V(1.0 / 3) * (f.edge_1 + f.edge_2);
    Vec<V> const r[3] = {V(-1.0) * centre, f.edge_1 - centre, f.edge_2 - centre};
    Vec<V> moment{zero, zero, zero};
    V xx = zero, yy = zero, zz = zero, xy = zero, yz = zero, zx = zero;
    for (int k = 0; k < 3; ++k) {
      moment = moment + core::cross(f.jump[k], force[k]);
      xx = xx + (r[k].y * r[k].y + r[k].z * r[k].z);
      yy = yy + (r[k].z * r[k].z + r[k].x * r[k].x);
      zz = zz + (r[k].x * r[k].x + r[k].y * r[k].y);
      xy = xy - r[k].x * r[k].y, yz = yz - r[k].y * r[k].z, zx = zx - r[k].z * r[k].x;
    }
    Vec<V> const row_x{xx, xy, zx}, row_y{xy, yy, yz}, row_z{zx, yz, zz}; // inertia, symmetric
    Vec<V> const cofactor = core::cross(row_y, row_z);
    V const half_inverse = V(0.5) * share / core::dot(row_x, cofactor);
    Vec<V> const theta{half_inverse * core::dot(cofactor, moment),
                       half_inverse * core::dot(core::cross(row_z, row_x), moment),
                       half_inverse * core::dot(core::cross(row_x, row_y), moment)};
    Vec<V> on_a[3], on_b[3];
    for (int k = 0; k < 3; ++k) {
      Vec<V> const both = core::cross(theta, r[k]);
      on_a[k] = both + force[k];
      on_b[k] = both - force[k];
    }
    core::store_three<V>(pass.force, batch.force_a.data() + lane0, on_a);
    core::store_three<V>(pass.force, batch.force_b.data() + lane0, on_b);
  }
};

template <class V> void act_batch(DamagedPass const& pass, JointBatch& batch, state::HistoryRows& histories) {
  batch.has_event = false;
  for (int lane = 0; lane < batch.count; lane += core::lanes<V>)
    BatchPack<V>(pass, batch, histories, lane).act();
}

template <class V>
double batch_energy(DamagedPass const& pass, JointBatch const& batch, state::HistoryRows const& histories) {
  V sum(0.0);
  for (int lane = 0; lane < batch.count; lane += core::lanes<V>)
    sum = sum + KnownPack<V>{pass, batch, lane}.energy(histories);
  return core::sum_lanes(sum);
}

} // namespace FISSURA_ISA
} // namespace fissura::concrete

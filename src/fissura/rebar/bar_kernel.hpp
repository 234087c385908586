#pragma once
// How bar elements and bar joints have moved, from the displacements of their host tets, pack by pack.
// Included only by the files that are compiled per instruction set.
#include <cstddef>
#include <type_traits>

#include "fissura/core/pack.hpp"
#include "fissura/rebar/kernels.hpp"

namespace fissura::rebar {
inline namespace FISSURA_ISA {

using core::Vec;

/// A list of structs of doubles and ints, read and written as if it were doubles; `start` says where each
/// lane's struct begins.
template <class V, class Struct> struct Rows {
  using Number = std::conditional_t<std::is_const_v<Struct>, double const, double>;
  Number* base;

  explicit Rows(Struct* list) : base(reinterpret_cast<Number*>(list)) {}

  /// Four doubles from an offset in bytes on.
  void get(std::size_t offset, int const* start, V (&four)[4]) const {
    core::load_fours(base + offset / sizeof(double), start, four);
  }
  Vec<V> get_vector(std::size_t offset, int const* start) const {
    return core::load_vectors<V>(base + offset / sizeof(double), start);
  }
  void put(std::size_t offset, int const* start, V const (&four)[4]) const {
    core::store_fours(base + offset / sizeof(double), start, four);
  }
  void put_vector(std::size_t offset, int const* start, Vec<V> v) const {
    put(offset, start, {v.x, v.y, v.z, V(0.0)});
  }
};

template <class V> inline Vec<V> unit(Vec<V> a) {
  V const square = core::dot(a, a), zero(0.0);
  return core::choose(square > zero, core::inverse_root(square), zero) * a;
}

template <class V> inline Vec<V> displacement(BarPass const& pass, int const* node) {
  return core::load_vectors<V>(pass.u, node);
}
template <class V> inline Vec<V> current(BarPass const& pass, int const* node) {
  return core::load_vectors<V>(pass.position, node) + core::load_vectors<V>(pass.u, node);
}
/// Displacement of the point of a host with weights w.
template <class V> inline Vec<V> displacement(BarPass const& pass, int const* host, V const (&w)[4]) {
  Vec<V> d = w[0] * core::load_vectors<V>(pass.u, host);
  for (int c = 1; c < 4; ++c) d = d + w[c] * core::load_vectors<V>(pass.u + core::per_node * c, host);
  return d;
}

// ---- elements ------------------------------------------------------------------------------------------

/// Elongation l - l_i [m] and current unit direction (Eq. 3).
template <class V> inline void stretch(BarPass const& pass, state::ElementLanes const& lanes, int lane0) {
  using Element = model::BarElement;
  static_assert(offsetof(Element, length) == offsetof(Element, axis) + sizeof(Vec3));
  Rows<V, Element const> const elements(pass.bars->elements.data());
  Rows<V, state::BarScratch::Element> const out(pass.scratch->element.data());
  int const* const element = lanes.element.data() + lane0;
  V w0[4], w1[4], axis_and_length[4];
  elements.get(offsetof(Element, w0), element, w0);
  elements.get(offsetof(Element, w1), element, w1);
  elements.get(offsetof(Element, axis), element, axis_and_length);
  for (int c = 0; c < 4; ++c) w1[c] = w1[c] - w0[c];
  Vec<V> const axis{axis_and_length[0], axis_and_length[1], axis_and_length[2]};
  Vec<V> const du = displacement(pass, lanes.host.data() + lane0, w1), now = axis + du;
  V const length = core::square_root(core::dot(now, now));
  // l^2 - l_i^2 = du.(2 axis + du): no difference of nearly equal lengths
  double elongation[core::lanes<V>];
  core::store<V>(elongation, V(core::dot(du, axis + now) / (length + axis_and_length[3])));
  for (int i = 0; i < core::lanes<V>; ++i) pass.elongation[lanes.index[lane0 + i]] = elongation[i];
  out.put_vector(offsetof(state::BarScratch::Element, direction), lanes.now.data() + lane0, unit(now));
}

/// Gradients of the barycentric coordinates of corners 1, 2 and 3 of the host as it is now [1/m]. Zero in an
/// inverted tet: it has no inside.
template <class V>
inline void find_gradients(BarPass const& pass, state::ElementLanes const& lanes, int lane0) {
  using Result = state::BarScratch::Element;
  int const* const host = lanes.host.data() + lane0;
  Vec<V> x[4];
  for (int c = 0; c < 4; ++c)
    x[c] = core::load_vectors<V>(pass.position + core::per_node * c, host) +
           core::load_vectors<V>(pass.u + core::per_node * c, host);
  Vec<V> const a = x[1] - x[0], b = x[2] - x[0], c = x[3] - x[0], b_c = core::cross(b, c);
  V const det = core::dot(a, b_c), zero(0.0);
  V const inverse = core::choose(det > zero, V(V(1.0) / det), zero);
  Vec<V> const gradient[3] = {inverse * b_c, inverse * core::cross(c, a), inverse * core::cross(a, b)};
  Rows<V, Result> const out(pass.scratch->element.data());
  for (std::size_t k = 0; k < 3; ++k)
    out.put_vector(offsetof(Result, gradients) + k * sizeof(state::BarScratch::Padded),
                   lanes.now.data() + lane0, gradient[k]);
}

template <class V> void stretch_elements(BarPass const& pass, std::size_t begin, std::size_t end) {
  for (std::size_t b = begin; b < end; ++b)
    for (int lane = 0; lane < 8; lane += core::lanes<V>) {
      stretch<V>(pass, pass.scratch->element_lanes[b], lane);
      find_gradients<V>(pass, pass.scratch->element_lanes[b], lane);
    }
}

// ---- joints --------------------------------------------------------------------------------------------

/// Displacement of side b less that of side a where a bar crosses a face.
template <class V> inline Vec<V> jump_at(BarPass const& pass, state::CrossingLanes const& face, int lane0) {
  Vec<V> d{V(0.0), V(0.0), V(0.0)};
  for (std::size_t k = 0; k < 3; ++k)
    d = d + core::load<V>(face.weights[k].data() + lane0) *
                (displacement<V>(pass, face.node_b[k].data() + lane0) -
                 displacement<V>(pass, face.node_a[k].data() + lane0));
  return d;
}

/// 0 where the jumps at all crossings are so small that the faces are surely intact, else 1.
template <class V> inline V may_separate(BarPass const& pass, state::BarJointLanes const& lanes, int lane0) {
  V may(0.0);
  for (int f = lanes.crossings_begin; f < lanes.crossings_end; ++f) {
    auto const& face = pass.scratch->crossing_lanes[static_cast<std::size_t>(f)];
    Vec<V> const d = jump_at<V>(pass, face, lane0);
    may = core::choose(core::dot(d, d) < core::load<V>(face.surely_intact.data() + lane0), may, V(1.0));
  }
  return may;
}

/// Weights of a point of a host, in the host as it is now, once it has moved by `step`. A force at a point
/// common to both tets has no couple only if it is shared out by these. Their change is limited to 1.
template <class V> inline void move_point(BarPass const& pass, int const* element, V (&w)[4], Vec<V> step) {
  using Element = state::BarScratch::Element;
  Rows<V, Element> const elements(pass.scratch->element.data());
  V change[3], largest(1.0);
  for (std::size_t k = 0; k < 3; ++k) {
    std::size_t const gradient = offsetof(Element, gradients) + k * sizeof(state::BarScratch::Padded);
    change[k] = core::dot(step, elements.get_vector(gradient, element));
    largest = core::larger(largest, core::absolute(change[k]));
  }
  V const scale = V(1.0) / largest;
  for (int k = 0; k < 3; ++k) {
    change[k] = scale * change[k];
    w[0] = w[0] - change[k];
    w[k + 1] = w[k + 1] + change[k];
  }
}

/// How far bar joints have opened. The transverse directions turn with tet_a.
template <class V> inline void move(BarPass const& pass, state::BarJointLanes const& lanes, int lane0) {
  using Joint = model::BarJoint;
  using Element = state::BarScratch::Element;
  using Result = state::BarScratch::Joint;
  Rows<V, Joint const> const joints(pass.bars->joints.data());
  Rows<V, Element> const elements(pass.scratch->element.data());
  Rows<V, Result> const out(pass.scratch->joint.data());
  auto at = [&](state::BarLanes const& of) { return of.data() + lane0; };
  V w_a[4], w_b[4];
  joints.get(offsetof(Joint, w_a), at(lanes.joint), w_a);
  joints.get(offsetof(Joint, w_b), at(lanes.joint), w_b);
  Vec<V> const d = displacement(pass, at(lanes.host_b), w_b) - displacement(pass, at(lanes.host_a), w_a);
  Vec<V> const r = unit(elements.get_vector(offsetof(Element, direction), at(lanes.element_a)) +
                        elements.get_vector(offsetof(Element, direction), at(lanes.element_b)));
  Vec<V> const edge = current<V>(pass, at(lanes.frame_1)) - current<V>(pass, at(lanes.frame_0));
  Vec<V> const across_1 = unit(edge - core::dot(edge, r) * r), across_2 = core::cross(r, across_1);
  V const half(0.5);
  int const* const now = at(lanes.now);
  out.put_vector(offsetof(Result, r), now, r);
  out.put_vector(offsetof(Result, across_1), now, across_1);
  out.put_vector(offsetof(Result, across_2), now, across_2);
  static_assert(offsetof(Result, may_separate) == offsetof(Result, axial) + 3 * sizeof(double));
  out.put(offsetof(Result, axial), now,
          {core::dot(d, r), half * core::dot(d, across_1), half * core::dot(d, across_2),
           may_separate<V>(pass, lanes, lane0)});
  move_point(pass, at(lanes.element_a), w_a, half * d);
  out.put(offsetof(Result, w_a), now, w_a);
  move_point(pass, at(lanes.element_b), w_b, V(-0.5) * d);
  out.put(offsetof(Result, w_b), now, w_b);
}

template <class V> void move_joints(BarPass const& pass, std::size_t begin, std::size_t end) {
  for (std::size_t b = begin; b < end; ++b)
    for (int lane = 0; lane < 8; lane += core::lanes<V>) move<V>(pass, pass.scratch->joint_lanes[b], lane);
}

} // namespace FISSURA_ISA
} // namespace fissura::rebar

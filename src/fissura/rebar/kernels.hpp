#pragma once
// How bar elements and bar joints have moved, compiled once per instruction set and chosen at start.
#include <cstddef>
#include <string_view>

#include "fissura/model/model.hpp"
#include "fissura/state/state.hpp"

namespace fissura::rebar {

struct BarPass {
  model::Bars const* bars;
  double const* position; ///< of the nodes at t = 0 (a NodeField) [m]
  double const* u;        ///< displacements of the nodes (a NodeField) [m]
  double* elongation;     ///< BarState::elongation
  state::BarScratch* scratch;
};

BarPass bar_pass(model::Model const& m, state::State& s, state::Scratch& w);

/// [begin, end) are eights of elements or joints: BarScratch::element_lanes, joint_lanes.
struct BarKernels {
  void (*stretch_elements)(BarPass const&, std::size_t begin, std::size_t end); ///< Eq. 3
  void (*move_joints)(BarPass const&, std::size_t begin, std::size_t end);      ///< after all elements
};

BarKernels const& bar_kernels();
/// As core::instruction_set names them.
BarKernels const& bar_kernels(std::string_view name);

} // namespace fissura::rebar

#pragma once
// Numpy arrays of a run: views of raw state that keep their run alive, and copies in input order.
#include <memory>
#include <string>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "fissura/sim/run.hpp"

namespace fissura::python {

namespace py = pybind11;

/// Names that view() knows, with what they are.
std::vector<std::pair<std::string, std::string>> view_names();
/// A read-only array on the memory of the run: it changes as the run goes on, and keeps `owner` alive.
py::array view(sim::Run const& run, std::string const& name, py::handle owner);

/// Names that field() knows, with unit and meaning.
std::vector<std::pair<std::string, std::string>> field_names();
/// A copy with one row per tet, in the order of their numbers in the input.
py::array field(sim::Run const& run, std::string const& name);

/// The arrays of the frames: "cracks" (damaged joints), "bars", "rigid", each as a dictionary of copies.
py::dict grid(sim::Run const& run, std::string const& which);

/// Rows of the history so far, [row][column].
py::array history(sim::Run const& run);

} // namespace fissura::python

// The extension module fissura._core: cases in, runs that are stepped, arrays out. What a user sees is made
// of it in fissura/__init__.py.
#include <chrono>
#include <mutex>
#include <optional>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "fissura/core/error.hpp"
#include "fissura/deck/deck.hpp"
#include "fissura/model/model.hpp"
#include "fissura/sim/check.hpp"
#include "fissura/sim/history.hpp"
#include "fissura/sim/run.hpp"
#include "fissura/sim/state_hash.hpp"
#include "fissura/sim/template_case.hpp"
#include "fissura/state/state.hpp"
#include "fissura/units/units.hpp"

namespace fissura::python {
namespace {

/// Reads a file, or a text that stands for one.
model::Case read(std::string const& text, std::string const& name, bool is_text,
                 std::vector<std::string> const& set) {
  return is_text ? deck::read_case_text(text, name, set) : deck::read_case(name, set);
}

class Run {
 public:
  Run(model::Case const& c, sim::RunOptions options) : run_(prepare(c, std::move(options))) { run_->open(); }
  /// Its threads may be at work for another run.
  ~Run() {
    py::gil_scoped_release const released;
    std::lock_guard const alone(mutex_);
    run_.reset();
  }
  Run(Run const&) = delete;
  Run& operator=(Run const&) = delete;

  /// Up to `steps` steps, or up to the time `until` [s] where there is one; false once the run has ended.
  /// Other Python threads go on meanwhile; Ctrl-C is looked for ten times a second.
  bool advance(long steps, std::optional<double> until) {
    py::gil_scoped_release const released;
    auto last_look = Clock::now();
    for (bool going = true; going && steps > 0;) {
      going = some_steps(steps, until);
      if (!going || Clock::now() - last_look < std::chrono::milliseconds(100)) continue;
      last_look = Clock::now();
      py::gil_scoped_acquire const held;
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    }
    return !run_->ended();
  }

  /// Calls work(run) while no thread steps a run. Waits without Python's own lock: who steps may want it.
  template <class Work> auto still(Work work) {
    std::unique_lock<std::mutex> lock(mutex_, std::defer_lock);
    {
      py::gil_scoped_release const released;
      lock.lock();
    }
    return work(*run_);
  }
  sim::Run const& run() const { return *run_; }

  /// The forecast steps the case a little.
  static std::string check(model::Case const& c) {
    py::gil_scoped_release const released;
    std::lock_guard const alone(mutex_);
    return sim::check_case(c);
  }

 private:
  using Clock = std::chrono::steady_clock;

  /// A few steps of `steps`; false if there is nothing more to do.
  bool some_steps(long& steps, std::optional<double> until) {
    std::lock_guard const alone(mutex_);
    for (int i = 0; i < 16 && steps > 0; ++i, --steps)
      if ((until && run_->state().time >= *until) || !run_->step()) return false;
    return true;
  }

  static std::unique_ptr<sim::Run> prepare(model::Case const& c, sim::RunOptions options) {
    options.version = FISSURA_VERSION;
    options.deck_echo = deck::echo(c);
    py::gil_scoped_release const released;
    std::lock_guard const alone(mutex_);
    return std::make_unique<sim::Run>(c, options);
  }

  std::unique_ptr<sim::Run> run_;
  static inline std::mutex mutex_; ///< the step of one run at a time
};

/// Errors become those of fissura/errors.py, which know their findings.
void translate(std::exception_ptr error) {
  try {
    if (error) std::rethrow_exception(error);
  } catch (core::InputError const& e) {
    py::list findings;
    for (auto const& d : e.diagnostics)
      findings.append(py::make_tuple(d.place.file, d.place.line, d.place.column, d.message));
    auto const type = py::module_::import("fissura.errors").attr("InputError");
    PyErr_SetObject(type.ptr(), type(e.what(), findings).ptr());
  } catch (core::Error const& e) {
    auto const errors = py::module_::import("fissura.errors");
    char const* const name = e.failure == core::Failure::input ? "InputError"
                             : e.failure == core::Failure::io  ? "FileError"
                                                               : "RunError";
    PyErr_SetString(errors.attr(name).ptr(), e.what());
  }
}

void add_run(py::module_& m) {
  py::class_<Run, std::shared_ptr<Run>>(m, "Run")
      .def(py::init([](std::string const& text, std::string const& name, bool is_text,
                       std::vector<std::string> const& set, std::string const& out, int threads, bool force,
                       bool quiet) {
        sim::RunOptions options;
        options.out = out, options.threads = threads, options.force = force, options.quiet = quiet;
        return std::make_shared<Run>(read(text, name, is_text, set), options);
      }))
      .def("advance", &Run::advance)
      .def("finish", [](Run& r) { r.still([](sim::Run& run) { run.finish(); }); })
      .def("change",
           [](Run& r, std::string const& name, std::string const& key, std::string const& value) {
             auto const curve = deck::read_load_curve(value, key);
             r.still([&](sim::Run& run) { run.change_load(name, key, curve); });
           })
      .def("view", [](py::object self,
                      std::string const& name) { return view(self.cast<Run const&>().run(), name, self); })
      .def("field",
           [](Run& r, std::string const& name) {
             return r.still([&](auto& run) { return field(run, name); });
           })
      .def("grid",
           [](Run& r, std::string const& which) {
             return r.still([&](auto& run) { return grid(run, which); });
           })
      .def("history", [](Run& r) { return r.still([](auto& run) { return history(run); }); })
      .def("columns",
           [](Run const& r) {
             std::vector<std::pair<std::string, std::string>> columns;
             for (auto const& c : r.run().history().columns()) columns.emplace_back(c.name, c.unit);
             return columns;
           })
      .def("summary", [](Run& r) { return r.still([](auto& run) { return run.summary(); }); })
      .def_property_readonly(
          "state_hash",
          [](Run& r) { return r.still([](auto& run) { return sim::state_hash(run.model(), run.state()); }); })
      .def_property_readonly("time", [](Run const& r) { return r.run().state().time; })
      .def_property_readonly("steps", [](Run const& r) { return r.run().state().step; })
      .def_property_readonly("dt", [](Run const& r) { return r.run().model().dt; })
      .def_property_readonly("stage",
                             [](Run const& r) {
                               auto const stage = static_cast<std::size_t>(r.run().state().stage);
                               return r.run().model().stages[stage].name;
                             })
      .def_property_readonly("tets", [](Run const& r) { return r.run().model().tet_count(); })
      .def_property_readonly("joints", [](Run const& r) { return r.run().model().joint_count(); })
      .def_property_readonly("title", [](Run const& r) { return r.run().model().source.title; })
      .def_property_readonly("ended", [](Run const& r) { return r.run().ended(); })
      .def_property_readonly(
          "result", [](Run const& r) { return std::pair(r.run().result().status, r.run().result().reason); });
}

} // namespace

PYBIND11_MODULE(_core, m) {
  m.doc() = "Fissura's library; use the package `fissura`.";
  m.attr("version") = FISSURA_VERSION;
  m.attr("most_threads") = sim::most_threads;
  py::register_exception_translator(translate);
  add_run(m);
  m.def("check",
        [](std::string const& text, std::string const& name, bool is_text,
           std::vector<std::string> const& set) { return Run::check(read(text, name, is_text, set)); });
  m.def("echo",
        [](std::string const& text, std::string const& name, bool is_text,
           std::vector<std::string> const& set) { return deck::echo(read(text, name, is_text, set)); });
  m.def("seconds", [](std::string const& text) { return units::to_si(text, units::Dimension::time); });
  m.def("views", &view_names);
  m.def("fields", &field_names);
  m.def("templates", [] {
    std::vector<std::pair<std::string, std::string>> texts;
    for (auto const& t : sim::templates()) texts.emplace_back(t.name, t.text);
    return texts;
  });
}

} // namespace fissura::python

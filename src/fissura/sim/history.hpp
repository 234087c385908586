#pragma once
// history.csv: gauges, reactions, energies and counts over time.
#include <memory>
#include <string>
#include <vector>

#include "fissura/output/csv.hpp"
#include "fissura/sim/fragments.hpp"
#include "fissura/sim/gauges.hpp"
#include "fissura/sim/monitor.hpp"

namespace fissura::sim {

class History {
 public:
  History(std::string const& path, model::Model const& m, Gauges const& gauges);
  void row(double time, model::Model const& m, state::State const& s, Gauges const& gauges,
           step::EnergyBalance const& e, Monitor const& monitor);
  void close() { csv_->close(); }

 private:
  std::unique_ptr<output::CsvWriter> csv_;
  std::vector<double> values_;
  FragmentCount count_fragments_;
};

} // namespace fissura::sim

#pragma once
// history.csv: gauges, reactions, energies and counts over time; kept in memory as well.
#include <memory>
#include <string>
#include <vector>

#include "fissura/output/csv.hpp"
#include "fissura/sim/fragments.hpp"
#include "fissura/sim/gauges.hpp"
#include "fissura/sim/monitor.hpp"
#include "fissura/sim/old_history.hpp"

namespace fissura::sim {

class History {
 public:
  /// An empty path: in memory only. `old`: goes on with the first bytes of a file (see output::CsvWriter).
  History(std::string const& path, model::Model const& m, Gauges const& gauges, OldHistory old = {});
  /// All but the time.
  static std::vector<output::Column> columns_of(model::Model const& m, Gauges const& gauges);
  void row(double time, double load_time, model::Model const& m, state::State const& s, Gauges const& gauges,
           step::EnergyBalance const& e, Monitor const& monitor);
  void close() {
    if (csv_) csv_->close();
  }
  /// How long the file is; what has been written is on the disk afterwards.
  HistoryMark flush();
  /// The time first.
  std::vector<output::Column> const& columns() const { return columns_; }
  /// Row after row, each as long as columns().
  std::vector<double> const& rows() const { return rows_; }

 private:
  std::unique_ptr<output::CsvWriter> csv_;
  bool is_paced_ = false;
  std::vector<output::Column> columns_;
  std::vector<double> values_, rows_;
  FragmentCount count_fragments_;
};

} // namespace fissura::sim

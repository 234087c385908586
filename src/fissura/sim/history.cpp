#include "fissura/sim/history.hpp"

#include <fmt/core.h>
#include <utility>

#include "fissura/sim/columns.hpp"

namespace fissura::sim {

std::vector<output::Column> History::columns_of(model::Model const& m, Gauges const& gauges) {
  auto columns = gauges.columns();
  for (auto& column : own_columns(m)) columns.push_back(std::move(column));
  return columns;
}

History::History(std::string const& path, model::Model const& m, Gauges const& gauges, OldHistory old)
    : is_paced_(m.source.run.pace > 1), rows_(std::move(old.rows)) {
  auto const columns = columns_of(m, gauges);
  if (!path.empty())
    csv_ = old.bytes > 0 ? std::make_unique<output::CsvWriter>(path, columns, old.bytes)
                         : std::make_unique<output::CsvWriter>(path, columns);
  values_.reserve(columns.size());
  columns_.push_back({"time", "s"});
  columns_.insert(columns_.end(), columns.begin(), columns.end());
}

HistoryMark History::flush() {
  if (!csv_) return {};
  csv_->flush();
  return {csv_->bytes(), static_cast<std::int64_t>(rows_.size() / columns_.size()),
          output::csv_header({columns_.begin() + 1, columns_.end()})};
}

void History::row(double time, double load_time, model::Model const& m, state::State const& s,
                  Gauges const& gauges, step::EnergyBalance const& e, Monitor const& monitor) {
  values_.assign(gauges.values().begin(), gauges.values().end());
  values_.insert(values_.end(), s.reaction.begin(), s.reaction.end());
  for (auto const& [name, value] : e.accounts()) values_.push_back(value);
  values_.push_back(monitor.residual_of(e));
  auto const joints = concrete::count_joints(m, s);
  auto const bars = count_bars(s.bars);
  for (int const n : {joints.damaged, joints.cracked, joints.broken, bars.activated, bars.yielded,
                      bars.broken, count_fragments_(m, s, joints.broken)})
    values_.push_back(n);
  if (is_paced_) values_.push_back(load_time), values_.push_back(s.pace);
  rows_.push_back(time);
  rows_.insert(rows_.end(), values_.begin(), values_.end());
  if (csv_) csv_->row(time, values_);
}

} // namespace fissura::sim

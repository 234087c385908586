#include "fissura/sim/history.hpp"

#include <charconv>
#include <fmt/core.h>
#include <fstream>

#include "fissura/core/error.hpp"
#include "fissura/sim/columns.hpp"

namespace fissura::sim {

History::History(std::string const& path, model::Model const& m, Gauges const& gauges, std::uint64_t kept) {
  auto columns = gauges.columns();
  for (auto& column : own_columns(m)) columns.push_back(std::move(column));
  is_paced_ = m.source.run.pace > 1;
  if (!path.empty())
    csv_ = kept > 0 ? std::make_unique<output::CsvWriter>(path, columns, kept)
                    : std::make_unique<output::CsvWriter>(path, columns);
  values_.reserve(columns.size());
  columns_.push_back({"time", "s"});
  columns_.insert(columns_.end(), columns.begin(), columns.end());
  if (csv_ && kept > 0) read_rows(path);
}

/// The rows that are there already.
void History::read_rows(std::string const& path) {
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::size_t const before = rows_.size();
    char const *at = line.data(), *const end = at + line.size();
    for (double value = 0; at < end; ++at) {
      at = std::from_chars(at, end, value).ptr;
      rows_.push_back(value);
      if (at < end && *at != ',') break;
    }
    if (rows_.size() - before != columns_.size())
      throw core::InputError({path}, "the run cannot go on with this file: a row has too few or too many "
                                     "values");
  }
}

std::uint64_t History::flush() {
  if (!csv_) return 0;
  csv_->flush();
  return csv_->bytes();
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

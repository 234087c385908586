#pragma once
// Text files of numbers over time, as loggers, data banks and spreadsheets write them: records of
// accelerations and histories of displacements, velocities and forces.
#include <string>
#include <string_view>
#include <vector>

namespace fissura::model {

/// What the deck says of a file.
struct SeriesFormat {
  std::string what = "file";     ///< in messages: "the record needs ..."
  std::string value = "a value"; ///< "an acceleration"
  int time_column = 1;           ///< from 1; 0 = none, evenly spaced by time_step
  int value_column = 2;          ///< from 1; 0 = all numbers of all rows, without times
  double time_step = 0;          ///< [s]
  /// The deck gives neither columns nor a step: a step named in the header stands for both, unless the first
  /// column holds just these times.
  bool as_header_says = false;
  double unit = 1; ///< SI units per unit of the file
};

/// What the lines before the first row say of themselves; zero or empty where they do not.
struct SeriesHeader {
  double step = 0; ///< [s]
  std::string step_written;
  long count = 0;   ///< number of values
  std::string unit; ///< of an acceleration, as the deck would name it: "g", "cm/s2"
};

struct Series {
  std::vector<double> times, values; ///< in s, as they stand in the file; in SI units
  SeriesHeader header;
  std::vector<std::string> notes, warnings;
};

/// Adds what a line says: "NPTS= 4000, DT= .0050 SEC", "401 POINTS AT .010 SEC, CM/S/S", "Sampling Freq(Hz)
/// 100".
void read_header_line(std::string_view line, SeriesHeader& header);

/// The numbers of a text. Lines that begin with #, %, ! or // and empty lines are skipped anywhere, others
/// that are not numbers before the first row only; a first row "910 0.0100" that counts the values behind it
/// is none of them. Numbers that touch ("-0.12E-02-0.45E-02") are parted where that is beyond doubt, and
/// decimal commas refused. `name` stands in messages. Throws core::InputError with file:line:column.
Series parse_series(std::string_view text, std::string const& name, SeriesFormat const& format);

/// The text of a file, at most 64 MiB. Throws core::Error.
std::string read_series_text(std::string const& file, std::string const& what);

/// "401 values at a step of 0.01 s, 4 s".
std::string extent_of(std::vector<double> const& times);

} // namespace fissura::model

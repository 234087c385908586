#pragma once
// Acceleration records: text files of numbers into a displacement that nodes can follow.
#include <string>
#include <string_view>
#include <vector>

#include "fissura/model/case.hpp"

namespace fissura::model {

/// An acceleration as its file has it, in SI, and the motion that follows from it.
struct Record {
  std::vector<double> times;                ///< from 0, increasing [s]
  std::vector<double> acceleration;         ///< linear between the times [m/s2]
  std::vector<double> velocity;             ///< exact integrals of it, from rest [m/s]
  std::vector<double> displacement;         ///< [m]
  std::vector<std::string> notes, warnings; ///< what its file says of itself, where that is not what was read
};

/// The numbers of a record's text (model/series.hpp), in SI, times from 0; velocity and displacement still
/// empty. `name` stands in messages. Throws core::InputError with file:line:column.
Record parse_record(std::string_view text, std::string const& name, RecordSpec const& spec);

/// Takes the baseline out, scales to the PGA and integrates. The baseline is the polynomial of degree 0
/// (mean), 1 or 2 whose removal leaves the velocity zero at the end, and among those the one that leaves the
/// least mean square of the velocity.
void correct_and_integrate(Record& record, RecordSpec const& spec);

/// Reads and prepares the file of a record. Throws core::InputError.
Record read_record(RecordSpec const& spec);

/// "401 values at a step of 0.01 s, 4 s; PGA 0.216 g (2.12 m/s2)", and the motion that follows from it.
std::string describe(Record const& record);

/// What no quake has and a slip of the pen brings about: a PGA beyond 3 g, a base that moves by metres, a
/// first value far above all others.
std::vector<std::string> doubts(Record const& record);

/// The displacement as a curve: cubic between the rows, which is exact for a linear acceleration.
Curve displacement_curve(Record const& record, double start);

} // namespace fissura::model

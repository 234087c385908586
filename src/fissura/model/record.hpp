#pragma once
// Acceleration records: text files of numbers into a displacement that nodes can follow.
#include <string_view>
#include <vector>

#include "fissura/model/case.hpp"

namespace fissura::model {

/// An acceleration as its file has it, in SI, and the motion that follows from it.
struct Record {
  std::vector<double> times;        ///< from 0, increasing [s]
  std::vector<double> acceleration; ///< linear between the times [m/s2]
  std::vector<double> velocity;     ///< exact integrals of it, from rest [m/s]
  std::vector<double> displacement; ///< [m]
};

/// The numbers of a record's text, in SI, times from 0; velocity and displacement still empty. `name` stands
/// in messages. Lines that begin with #, %, ! or // and empty lines are skipped anywhere, others that are not
/// numbers before the first row only. Throws core::InputError with file:line:column.
Record parse_record(std::string_view text, std::string const& name, RecordSpec const& spec);

/// Takes the baseline out, scales to the PGA and integrates. The baseline is the polynomial of degree 0
/// (mean), 1 or 2 whose removal leaves the velocity zero at the end, and among those the one that leaves the
/// least mean square of the velocity.
void correct_and_integrate(Record& record, RecordSpec const& spec);

/// Reads and prepares the file of a record. Throws core::InputError.
Record read_record(RecordSpec const& spec);

/// The displacement as a curve: cubic between the rows, which is exact for a linear acceleration.
Curve displacement_curve(Record const& record, double start);

} // namespace fissura::model

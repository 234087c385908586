#pragma once
// `fissura report`: one self-contained page from a run folder (docs/reference/report.md).
#include <cstddef>
#include <string>

namespace fissura::report {

class Blob;
class RunFolder;

struct ReportOptions {
  std::string out;            ///< file to write; empty = report.html in the run folder
  std::string version;        ///< of this program
  std::size_t megabytes = 15; ///< largest size of the page: frames are left out to stay below it
};

/// The page of a run, finished or still going on. Throws core::Error(Failure::io) for what cannot be read, or
/// if the program was built without the page.
std::string report_page(std::string const& folder, ReportOptions const& options);
/// Writes the page and returns its path.
std::string write_report(std::string const& folder, ReportOptions const& options);

/// The numbers of the page of one run.
Blob report_numbers(RunFolder const& run, ReportOptions const& options);

} // namespace fissura::report

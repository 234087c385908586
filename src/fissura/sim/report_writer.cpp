#include "fissura/sim/report_writer.hpp"

#include <algorithm>
#include <chrono>

#include "fissura/core/error.hpp"
#include "fissura/output/atomic_file.hpp"
#include "fissura/report/page.hpp"
#include "fissura/report/report.hpp"
#include "fissura/sim/log.hpp"

namespace fissura::sim {

ReportWriter::ReportWriter(std::string folder, std::string version, bool wanted)
    : folder_(std::move(folder)), version_(std::move(version)), wanted_(wanted && !folder_.empty()) {}

bool ReportWriter::write(Log& log) {
  std::string page;
  try {
    page = report::report_page(folder_, {.out = {}, .version = version_});
  } catch (core::Error const& e) {
    log.warning("no report page: {}", e.what());
    wanted_ = false;
    return false;
  }
  output::replace_file(folder_ + "/report.html", page); // a full disk is no small matter of a page
  return true;
}

void ReportWriter::meanwhile(double elapsed, Log& log) {
  if (!wanted_ || elapsed < next_ || report::page_template().empty()) return;
  using clock = std::chrono::steady_clock;
  auto const start = clock::now();
  write(log);
  double const cost = std::chrono::duration<double>(clock::now() - start).count();
  next_ = elapsed + cost + std::max(60.0, 50 * cost);
}

void ReportWriter::at_end(Log& log) {
  if (!wanted_) return;
  if (report::page_template().empty())
    log.info("no report page: none is built into this program; `fissura report` says what is missing");
  else if (write(log))
    log.info("report: {}/report.html", folder_);
}

} // namespace fissura::sim

#include "fissura/sim/report_writer.hpp"

#include <algorithm>
#include <chrono>

#include "fissura/core/error.hpp"
#include "fissura/report/page.hpp"
#include "fissura/report/report.hpp"

namespace fissura::sim {

ReportWriter::ReportWriter(std::string folder, std::string version, bool wanted)
    : folder_(std::move(folder)), version_(std::move(version)), wanted_(wanted && !folder_.empty()) {}

bool ReportWriter::write(spdlog::logger& log) {
  try {
    report::write_report(folder_, {.out = {}, .version = version_});
    return true;
  } catch (core::Error const& e) {
    if (e.failure == core::Failure::io) throw; // a full disk is no small matter of a page
    log.warn("no report page: {}", e.what());
    wanted_ = false;
    return false;
  }
}

void ReportWriter::meanwhile(double elapsed, spdlog::logger& log) {
  if (!wanted_ || elapsed < next_ || report::page_template().empty()) return;
  using clock = std::chrono::steady_clock;
  auto const start = clock::now();
  write(log);
  double const cost = std::chrono::duration<double>(clock::now() - start).count();
  next_ = elapsed + cost + std::max(60.0, 50 * cost);
}

void ReportWriter::at_end(spdlog::logger& log) {
  if (!wanted_) return;
  if (report::page_template().empty())
    log.info("no report page: this program was built without npm (see `fissura report`)");
  else if (write(log))
    log.info("report: {}/report.html", folder_);
}

} // namespace fissura::sim

#include "fissura/report/page.hpp"

#include <array>
#include <ctime>

#include "fissura/core/ensure.hpp"

namespace fissura::report {

namespace {

/// The text with the first `mark` replaced.
void put(std::string& page, std::string_view mark, std::string const& text) {
  std::size_t const at = page.find(mark);
  core::ensure(at != std::string::npos, "the page built into this program has no " + std::string(mark));
  page.replace(at, mark.size(), text);
}

} // namespace

void require_page(std::string_view page) {
  if (page.empty())
    throw core::Error(
        core::Failure::io,
        "this program was built without the report page: its parts (three.js, uPlot) come from npm. "
        "Install nodejs and npm, and build again with `make build` (needs a network once, and FISSURA_PAGE "
        "on)");
}

std::string fill_page(std::string const& title, std::string const& numbers, std::string_view bundled) {
  require_page(bundled);
  std::string page(bundled);
  // From the end to the start: what is put in is never searched.
  put(page, "@@NUMBERS@@", numbers);
  put(page, "@@TITLE@@", escape_html(title));
  return page;
}

std::string local_time() {
  std::time_t const now = std::time(nullptr);
  std::tm parts{};
  localtime_r(&now, &parts);
  std::array<char, 32> text{};
  return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M", &parts)};
}

std::string escape_html(std::string_view text) {
  std::string out;
  for (char const c : text) {
    switch (c) {
    case '&':
      out += "&amp;";
      break;
    case '<':
      out += "&lt;";
      break;
    case '>':
      out += "&gt;";
      break;
    case '"':
      out += "&quot;";
      break;
    case '\'':
      out += "&#39;";
      break;
    default:
      out += c;
    }
  }
  return out;
}

} // namespace fissura::report

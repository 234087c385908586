#pragma once
// The page itself: text, style and program bundled at build time (report/), and the place where the numbers
// go.
#include <string>
#include <string_view>

namespace fissura::report {

/// The page as it was bundled into the program; empty where the build had no npm.
std::string_view page_template();

/// Throws core::Error(Failure::io) that says what is missing and what to do, if the program has no page.
void require_page(std::string_view page = page_template());

/// The page with this title and these numbers (Blob::text()). Throws as above.
std::string fill_page(std::string const& title, std::string const& numbers,
                      std::string_view bundled = page_template());

/// When a page is written: date, hour and minute here and now, "2026-05-31 14:05".
std::string local_time();

/// & < > " ' as HTML writes them.
std::string escape_html(std::string_view text);

} // namespace fissura::report

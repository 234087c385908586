# The page of `fissura report`: three.js and uPlot from npm, bundled into one HTML file and built into the program.
# Without npm (or without a network at the first build) the program is built all the same, with an empty page, and
# `fissura report` says what is missing.
option(FISSURA_PAGE "Bundle the report page with npm, where there is one" ON)

set(page_source ${PROJECT_SOURCE_DIR}/report)
set(page_build ${PROJECT_BINARY_DIR}/report)
set(page_html ${page_build}/page.html)
set(page_embed ${page_build}/page_template.cpp)

find_program(NPM_PROGRAM npm)
find_program(NODE_PROGRAM node)
file(GLOB page_files CONFIGURE_DEPENDS ${page_source}/src/*)
set(page_script)
if(NOT FISSURA_PAGE)
  message(STATUS "FISSURA_PAGE is off: no report page is built in")
elseif(NOT NPM_PROGRAM OR NOT NODE_PROGRAM)
  message(STATUS "npm or node not found: no report page is built in; install nodejs and npm, then build again")
else()
  set(page_script -DNPM=${NPM_PROGRAM} -DNODE=${NODE_PROGRAM})
  # A page that could not be bundled the last time, for want of a network say, is tried again.
  if(EXISTS ${page_html})
    file(SIZE ${page_html} page_size)
    if(page_size EQUAL 0)
      file(REMOVE ${page_html})
    endif()
  endif()
endif()
add_custom_command(
  OUTPUT ${page_html}
  COMMAND ${CMAKE_COMMAND} ${page_script} -DSOURCE=${page_source} -DBUILD=${page_build} -DPAGE=${page_html}
          -P ${PROJECT_SOURCE_DIR}/cmake/bundle_page.cmake
  DEPENDS ${page_files} ${page_source}/package.json ${page_source}/package-lock.json ${page_source}/build.mjs
          ${PROJECT_SOURCE_DIR}/cmake/bundle_page.cmake
  COMMENT "Bundling the report page"
  VERBATIM)

# The page as bytes of the program: an .incbin keeps the compiler out of a megabyte of text.
file(CONFIGURE OUTPUT ${page_embed} CONTENT [[
// Made by cmake/report_page.cmake.
#include "fissura/report/page.hpp"

__asm__(".section .rodata\n"
        "fissura_page_begin:\n"
        ".incbin \"@page_html@\"\n"
        "fissura_page_end:\n"
        ".byte 0\n"
        ".previous\n");

extern "C" {
extern char const fissura_page_begin[], fissura_page_end[];
}

namespace fissura::report {

std::string_view page_template() {
  return {fissura_page_begin, static_cast<std::size_t>(fissura_page_end - fissura_page_begin)};
}

} // namespace fissura::report
]] @ONLY)
set_source_files_properties(${page_embed} PROPERTIES OBJECT_DEPENDS ${page_html})
add_custom_target(report_page DEPENDS ${page_html})
add_dependencies(fissura_report report_page)
target_sources(fissura_report PRIVATE ${page_embed})

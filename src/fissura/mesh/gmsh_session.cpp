#include "fissura/mesh/gmsh_session.hpp"

#include <charconv>
#include <exception>
#include <vector>

#include <gmsh.h>

#include "fissura/core/error.hpp"

namespace fissura::mesh {

namespace {

std::mutex gmsh_in_use;

/// The errors gmsh wrote to its log, joined.
std::string logged_errors() {
  std::vector<std::string> log;
  gmsh::logger::get(log);
  std::string errors;
  for (auto const& line : log)
    if (line.starts_with("Error: ")) errors += (errors.empty() ? "" : "; ") + line.substr(7);
  return errors;
}

/// The line number in "'beam.geo', line 12: ...", or 0.
int line_in(std::string const& message) {
  auto const found = message.find("', line ");
  if (found == std::string::npos) return 0;
  char const* const digits = message.data() + found + 8;
  int line = 0;
  std::from_chars(digits, message.data() + message.size(), line);
  return line;
}

} // namespace

GmshSession::GmshSession(std::filesystem::path file_) : file(std::move(file_)), only_user(gmsh_in_use) {
  gmsh::initialize(0, nullptr, false);
  try {
    prepare();
  } catch (...) { // the destructor of a half-made session does not run
    gmsh::finalize();
    throw;
  }
}

void GmshSession::prepare() const {
  guard([] {
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.NumThreads", 1); // the same mesh on every machine
    // gmsh must not throw out of the middle of its parser: that would leave the parser broken for the next
    // file.
    gmsh::option::setNumber("General.AbortOnError", 0);
    gmsh::logger::start();
  });
}

GmshSession::~GmshSession() {
  try {
    gmsh::logger::stop();
    gmsh::finalize();
  } catch (...) { // nothing more can be done, and a destructor must not throw
  }
}

void GmshSession::rethrow() const {
  std::string message;
  try {
    throw;
  } catch (core::Error const&) {
    throw;
  } catch (std::string const& text) {
    message = text;
  } catch (std::exception const& error) {
    message = error.what();
  } catch (...) { // older calls of the library throw plain numbers
    message = "unknown error";
  }
  std::string const logged = logged_errors();
  refuse(logged.empty() ? message : logged);
}

void GmshSession::check_log() const {
  std::string const logged = logged_errors();
  if (!logged.empty()) refuse(logged);
}

void GmshSession::refuse(std::string const& message) const {
  throw core::InputError({file.string(), line_in(message), 0},
                         "gmsh cannot make a mesh of this file: " + message);
}

} // namespace fissura::mesh

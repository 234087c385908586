#pragma once
// The gmsh library kept on a short lead: one user at a time, silent, its errors turned into ours.
#include <filesystem>
#include <mutex>
#include <string>

namespace fissura::mesh {

/// Holds the gmsh library initialised, without its configuration files and without output to the terminal,
/// for as long as it lives. gmsh is one global object, so a second session waits for the first one's end.
class GmshSession {
 public:
  /// @param file_ named in errors
  explicit GmshSession(std::filesystem::path file_);
  ~GmshSession();
  GmshSession(GmshSession const&) = delete;
  GmshSession& operator=(GmshSession const&) = delete;

  /// Calls work(). What gmsh throws (strings, numbers, exceptions) and what it only notes in its log as an
  /// error becomes core::InputError at the file, with gmsh's words and the line they name; core errors pass
  /// through.
  template <class Work> void guard(Work work) const {
    try {
      work();
    } catch (...) {
      rethrow();
    }
    check_log();
  }

 private:
  void prepare() const;
  [[noreturn]] void rethrow() const;
  [[noreturn]] void refuse(std::string const& message) const;
  void check_log() const;

  std::filesystem::path file;
  std::unique_lock<std::mutex> only_user;
};

} // namespace fissura::mesh

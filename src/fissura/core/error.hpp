#pragma once
// How the library reports what went wrong: it throws, it never prints, exits or aborts.
#include <stdexcept>
#include <string>
#include <vector>

namespace fissura::core {

/// A place in a file the user wrote; line 0 means "the file as a whole". Lines and columns count from 1.
struct Place {
  std::string file;
  int line = 0;
  int column = 0;
};

/// "file:line:column" with the unknown parts left out.
std::string to_string(Place const& place);

/// What a failure means to the shell: 1 failed run, 2 bad input, 3 input/output failure.
enum class Failure { run = 1, input = 2, io = 3 };

class Error : public std::runtime_error {
 public:
  Error(Failure failure_, std::string const& what_arg) : std::runtime_error(what_arg), failure(failure_) {}
  Failure failure;
};

/// One finding about the user's input.
struct Diagnostic {
  Place place;
  std::string message; ///< what is wrong, what was expected, and where known the cure
};

/// All findings of one pass over the input.
class InputError : public Error {
 public:
  explicit InputError(std::vector<Diagnostic> diagnostics_);
  InputError(Place place, std::string message)
      : InputError({Diagnostic{std::move(place), std::move(message)}}) {}
  std::vector<Diagnostic> diagnostics;
};

} // namespace fissura::core

#pragma once
// Reads the numbers of a .msh file one after the other, as text or as bytes, and never beyond its end.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace fissura::mesh {

class MshScanner {
 public:
  MshScanner(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  bool is_binary = false; ///< numbers are bytes from now on

  /// The next word "$Name" of the file; empty at its end.
  std::string_view next_section();
  /// Goes on after "$End<name>", wherever that is.
  void skip_section(std::string_view name);
  /// Expects "$End<name>" here.
  void end_section(std::string_view name);

  /// A number that stands as text in either kind of file. Throw core::InputError, naming `what`, like all
  /// that follow.
  std::int64_t written_integer(char const* what);
  double written_number(char const* what);
  /// Text in quotes.
  std::string quoted(char const* what);
  /// In a file of bytes: the end of the line, after which the bytes begin.
  void begin_bytes();

  /// An int (4 bytes), a size (8 bytes, not negative) or a double, by the kind of the file.
  int integer(char const* what);
  std::uint64_t size(char const* what);
  double number(char const* what);
  /// A size that says how many items follow, each at least so many characters or bytes long: one that cannot
  /// be true is refused here, before room is made for them.
  std::size_t count(char const* what, std::size_t least_characters, std::size_t least_bytes);
  /// The same for a count that stands as text in either kind of file, or is an int among the bytes.
  std::size_t checked(std::int64_t count, char const* what, std::size_t least_characters,
                      std::size_t least_bytes) const;
  /// Passes over so many numbers, doubles where there are bytes.
  void skip_numbers(std::size_t how_many, char const* what);
  /// Text files: the rest of the line.
  void skip_line();

  [[noreturn]] void refuse(std::string message) const;

 private:
  std::string_view word();
  template <class T> T raw(char const* what);
  std::string_view text_;
  std::string file_;
  std::size_t at_ = 0;
};

} // namespace fissura::mesh

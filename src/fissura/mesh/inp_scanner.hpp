#pragma once
// The lines of an .inp file: keyword lines with their parameters, data lines as fields.
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fissura::mesh {

/// Capitals: keywords, parameters and set names do not tell upper from lower case.
std::string in_capitals(std::string_view text);

/// One logical line: comments are skipped. Keywords that end in a comma go on in the next line.
struct InpLine {
  int number = 0;                  ///< of its first line, from 1
  bool keyword = false;            ///< begins with a star
  std::string name;                ///< of a keyword, in capitals without blanks at the ends: "ELEMENT"
  std::vector<std::string> fields; ///< data: trimmed
  std::vector<std::pair<std::string, std::string>>
      parameters; ///< keyword: name in capitals, value as written

  /// Value of a parameter ("" for a flag), or null.
  std::string const* parameter(std::string_view wanted) const;
};

class InpScanner {
 public:
  /// Whether a data line that ends in a comma goes on in the next one: those of elements do.
  enum class Data { one_line, goes_on };
  explicit InpScanner(std::string_view text) : rest(text) {}
  /// False at the end of the text.
  bool next(InpLine& line, Data data = Data::one_line);

 private:
  bool raw(std::string_view& line);
  std::string_view rest;
  int count = 0;
};

} // namespace fissura::mesh

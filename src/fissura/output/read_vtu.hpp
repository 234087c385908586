#pragma once
// Reads the frames that write_vtu has written: the header at once, each array when it is asked for.
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace fissura::output {

class VtuFile {
 public:
  /// Throws core::Error(Failure::io), naming the file, if it cannot be read or is no VTU file of this
  /// program.
  explicit VtuFile(std::string path);

  std::size_t points() const { return points_; }
  std::size_t cells() const { return cells_; }
  /// Whether there is an array of this name under PointData, CellData, Points or Cells.
  bool has(std::string const& section, std::string const& name) const;

  /// All values of one array, converted; throws core::Error(Failure::io) if it is missing or damaged.
  std::vector<float> floats(std::string const& section, std::string const& name) const;
  std::vector<double> doubles(std::string const& section, std::string const& name) const;
  std::vector<std::int64_t> integers(std::string const& section, std::string const& name) const;

 private:
  struct Entry {
    std::string type;
    std::size_t offset = 0, values = 0; ///< values = 0: not known beforehand
  };
  template <class To> std::vector<To> read(std::string const& section, std::string const& name) const;
  [[noreturn]] void refuse(std::string const& why) const;

  std::string path_, bytes_;
  std::size_t data_ = 0; ///< where the appended data begin in bytes_
  std::size_t points_ = 0, cells_ = 0;
  std::map<std::string, Entry> entries_; ///< "section/name"
};

/// Undoes zlib_blocks(); `at`: where the header of the blocks begins. Throws std::runtime_error with the
/// reason.
std::string inflate_blocks(std::string_view bytes, std::size_t at);

} // namespace fissura::output

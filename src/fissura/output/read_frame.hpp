#pragma once
// Reads the frames that write_vtu and write_vtp have written: the header at once, each array when it is asked
// for. Frames come from the disk, and so from anywhere: nothing in one is believed before it has been
// checked.
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fissura::output {

/// Which points the cells of one kind have, one cell after the other.
struct CellList {
  std::vector<std::int64_t> connectivity; ///< numbers of points that are there
  std::vector<std::int64_t> offsets;      ///< per cell: where it ends in connectivity
  std::size_t size() const { return offsets.size(); }
  std::size_t begin(std::size_t cell) const {
    return cell == 0 ? 0 : static_cast<std::size_t>(offsets[cell - 1]);
  }
  std::size_t end(std::size_t cell) const { return static_cast<std::size_t>(offsets[cell]); }
};

class FrameFile {
 public:
  /// Throws core::Error(Failure::io), naming the file, if it cannot be read or is no frame of this program.
  explicit FrameFile(std::string path);

  std::string const& path() const { return path_; }
  std::size_t points() const { return points_; }
  /// Cells of all kinds.
  std::size_t cells() const { return cells_; }
  /// Whether there is an array of this name under PointData, CellData, Points, or a list of cells.
  bool has(std::string const& section, std::string const& name) const;

  /// All values of one array, converted; throws core::Error(Failure::io) if it is missing or damaged, or has
  /// another number of components.
  std::vector<float> floats(std::string const& section, std::string const& name,
                            std::size_t components = 1) const;
  std::vector<double> doubles(std::string const& section, std::string const& name,
                              std::size_t components = 1) const;
  std::vector<std::int64_t> integers(std::string const& section, std::string const& name) const;

  /// The cells under "Cells" (of a .vtu), "Lines" or "Polys" (of a .vtp); throws as above, also where a cell
  /// names a point that is not there.
  CellList cell_list(std::string const& section) const;

  /// Throws "cannot read '<path>': <why>".
  [[noreturn]] void refuse(std::string const& why) const;

 private:
  struct Entry {
    std::string type;
    std::size_t offset = 0, components = 1;
    std::optional<std::size_t> tuples; ///< empty: not known beforehand
  };
  void describe(std::string const& header);
  std::size_t count_of(std::string const& text, char const* what) const;
  template <class To>
  std::vector<To> read(std::string const& section, std::string const& name, std::size_t components) const;

  std::string path_, bytes_;
  std::size_t data_ = 0; ///< where the appended data begin in bytes_
  std::size_t points_ = 0, cells_ = 0;
  std::map<std::string, Entry> entries_; ///< "section/name"
};

/// Undoes zlib_blocks(); `at`: where the header of the blocks begins. Throws std::runtime_error with the
/// reason, and before any memory is asked for where there would be more than `most` bytes.
std::string inflate_blocks(std::string_view bytes, std::size_t at,
                           std::size_t most = std::numeric_limits<std::size_t>::max());

} // namespace fissura::output

#pragma once
// The files of a run folder as a whole: made, and cut back to a checkpoint.
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "fissura/sim/fields.hpp"
#include "fissura/sim/old_history.hpp"

namespace fissura::sim {

/// How far the files had come when a checkpoint was written.
struct FileMarks {
  HistoryMark history;
  std::uint64_t log = 0; ///< bytes
  std::vector<Frame> frames;
  static auto fields(auto& self) { return std::tie(self.history, self.log, self.frames); }
};

/// Throws core::Error(Failure::io) unless a folder may be given to a new run by --force: it is empty or holds
/// a run, and it is neither the root, nor a home, nor where the deck lies. One that is not there may.
void check_may_force(std::string const& folder, std::string const& deck_file);

/// Throws core::Error(Failure::io) where a run that goes on in its folder could not write.
void check_can_go_on_in(std::string const& folder);

/// Makes the folder; with `force` removes what an earlier run has left there. Throws core::Error(Failure::io)
/// if it exists already or cannot be made.
void make_folder(std::string const& folder, bool force);

/// Whether both names mean the same folder.
bool is_same_folder(std::string const& a, std::string const& b);

/// Cuts log and frames of a folder back to the marks and removes run.json and what was left half written;
/// history.csv and the lists of frames are cut by their writers, the lists before this.
void cut_back(std::string const& folder, FileMarks const& marks);

/// Copies what a run goes on with to a new folder: history, log up to the marks, and the frames.
void copy_start(std::string const& from, std::string const& to, FileMarks const& marks);

/// Length of a file; 0 if there is none.
std::uint64_t size_of(std::string const& path);

} // namespace fissura::sim

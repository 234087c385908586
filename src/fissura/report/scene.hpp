#pragma once
#include <cstddef>

#include "fissura/report/blob.hpp"
#include "fissura/report/run_folder.hpp"

namespace fissura::report {

/// Adds body, cracks, bars, rigid bodies and the crack table: meta.frames (times), meta.frames_saved,
/// meta.scene and arrays. Frames are left out evenly, never the first or the last, until the numbers take
/// less than `bytes` before compression. Without frames meta.scene is null.
void add_scene(Blob& blob, RunFolder const& run, std::size_t bytes);

/// `count` of `total` numbers from 0, evenly, first and last among them.
std::vector<std::size_t> spread(std::size_t total, std::size_t count);

} // namespace fissura::report

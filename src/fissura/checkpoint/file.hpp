#pragma once
// A checkpoint on the disk: 16 bytes that name the format, its version, a mark for the order of bytes, the
// contents, their length, a checksum (XXH3, 64 bits) of all that goes before, and a word at the very end.
// docs/decisions/013-checkpoint-format.md.
#include <cstdint>
#include <functional>
#include <string>

#include "fissura/checkpoint/archive.hpp"

namespace fissura::checkpoint {

inline constexpr std::uint32_t format_version = 6;

/// Writes a checkpoint whole or not at all: a temporary file, flushed to the disk, then renamed, then the
/// folder flushed. Throws core::Error(Failure::io).
void write_file(std::string const& path, std::function<void(Saver&)> const& contents);

/// The contents of a checkpoint, as a Loader wants them. Throws core::Error(Failure::io) if the file cannot
/// be read, core::InputError with the reason if it is no checkpoint, of a newer version, cut off or altered.
std::string read_file(std::string const& path);

/// The same check of bytes in memory; the contents are a part of them.
std::string_view contents_of(std::string_view bytes, std::string const& path);

} // namespace fissura::checkpoint

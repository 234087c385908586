#pragma once
// The summary of a run (run.json). Keys keep the order in which they were added; doubles are written with the
// digits that read back as the same value; a value that is not finite becomes null, since JSON has no NaN.
#include <nlohmann/json.hpp>
#include <string>

#include "fissura/output/json_fwd.hpp"

namespace fissura::output {

/// Replaces `path` by the text of `value`, whole or not at all. Bytes that are not UTF-8 (a file name, say)
/// become the replacement character instead of an error at the end of a long run. Throws
/// core::Error(Failure::io).
void write_json(std::string const& path, Json const& value);

} // namespace fissura::output

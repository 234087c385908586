#pragma once
#include <string>

#include "fissura/output/json_fwd.hpp"

namespace fissura::report {

/// run.json from its text. Readers ask it for words and numbers by name: what is there under a known key is a
/// word or a number as the key asks for, or null where a number was not finite. Throws std::runtime_error
/// with what is wrong.
output::Json parse_run_json(std::string const& text);

} // namespace fissura::report

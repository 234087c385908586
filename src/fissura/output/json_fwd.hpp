#pragma once
// The name of a JSON value, for headers that only pass one on: the whole of it (output/json.hpp) takes
// seconds to compile.
#include <nlohmann/json_fwd.hpp>

namespace fissura::output {
using Json = nlohmann::ordered_json;
}

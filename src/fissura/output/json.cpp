#include "fissura/output/json.hpp"

#include "fissura/output/atomic_file.hpp"

namespace fissura::output {

void write_json(std::string const& path, Json const& value) {
  replace_file(path, value.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

} // namespace fissura::output

#pragma once

namespace fissura::support {

/// Number of calls of operator new in this program so far.
long allocations();

} // namespace fissura::support

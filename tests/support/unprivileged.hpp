#pragma once
// For tests of files that may not be read or written: root may do everything.
#include <unistd.h>

namespace fissura::support {

/// While it lives the process is nobody in particular, if it could be made so.
class Unprivileged {
 public:
  Unprivileged() {
    if (was_ == 0) is_ = ::seteuid(65534) == 0;
  }
  ~Unprivileged() {
    if (was_ == 0 && is_) is_ = ::seteuid(0) != 0;
  }
  Unprivileged(Unprivileged const&) = delete;
  Unprivileged& operator=(Unprivileged const&) = delete;
  bool is() const { return is_; }

 private:
  ::uid_t const was_ = ::geteuid();
  bool is_ = was_ != 0;
};

} // namespace fissura::support

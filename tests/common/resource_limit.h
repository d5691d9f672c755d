// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/resource.h>

namespace disflow::test {

/// Limits what this process and programs that are started meanwhile may have of a resource.
class ResourceLimit {
 public:
  /// @param resource As of setrlimit, e.g. RLIMIT_FSIZE: files end there, as on a full disk.
  ResourceLimit(__rlimit_resource resource, rlim_t most) : resource_(resource) {
    (void)::getrlimit(resource_, &before_);
    rlimit limit = before_;
    limit.rlim_cur = most;
    (void)::setrlimit(resource_, &limit);
  }
  ResourceLimit(const ResourceLimit&) = delete;
  ResourceLimit& operator=(const ResourceLimit&) = delete;
  ~ResourceLimit() { (void)::setrlimit(resource_, &before_); }

 private:
  __rlimit_resource resource_;
  rlimit before_{};
};

}  // namespace disflow::test

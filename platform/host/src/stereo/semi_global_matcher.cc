// SPDX-License-Identifier: BSD-3-Clause
#include "semi_global_matcher.h"

#include <dlfcn.h>

#include <filesystem>

namespace disflow::host {

MatchFunction FindSemiGlobalMatcher() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) return nullptr;
  const std::filesystem::path module = program.parent_path() / "disflow_semi_global.so";
  // Never closed: OpenCV starts threads and registers what has to outlive it.
  void* handle = dlopen(module.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) return nullptr;
  return reinterpret_cast<MatchFunction>(dlsym(handle, kMatchFunctionName));
}

}  // namespace disflow::host

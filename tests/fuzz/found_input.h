// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstddef>
#include <cstdint>
#include <string>

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define DISFLOW_HAS_DEATH_CALLBACK
#include <sanitizer/common_interface_defs.h>
#endif
#endif

/// @file
/// The input that ends the program is kept in a file, so that it can go into the corpus.

namespace disflow::test {

/// What is tried at the moment.
struct FoundInput {
  std::string path;  ///< Where it goes.
  std::string told;  ///< What is said of it then.
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;
};

inline FoundInput& TheInput() {
  static FoundInput input;
  return input;
}

/// Called by a signal too, so with nothing but system calls.
inline void KeepInput() noexcept {
  const FoundInput& input = TheInput();
  if (input.data == nullptr) return;
  constexpr int kMode = 0644;
  const int file = ::open(input.path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, kMode);
  const bool kept =
      file >= 0 && ::write(file, input.data, input.size) == static_cast<ssize_t>(input.size);
  const std::string& told = input.told;
  if (kept) (void)!::write(STDERR_FILENO, told.c_str(), told.size());
}

/// From now on whatever ends the program keeps TheInput().
inline void KeepInputThatEndsTheProgram() {
  const auto end = [](int number) {
    KeepInput();
    std::signal(number, SIG_DFL);
    std::raise(number);
  };
  for (const int number : {SIGABRT, SIGILL, SIGTRAP}) std::signal(number, end);
#ifdef DISFLOW_HAS_DEATH_CALLBACK
  __sanitizer_set_death_callback([] { KeepInput(); });
#else
  for (const int number : {SIGSEGV, SIGBUS, SIGFPE}) std::signal(number, end);
#endif
}

}  // namespace disflow::test

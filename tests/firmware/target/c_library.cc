// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What newlib's printf() needs below it, and the way from the start-up code into a C program.

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "semihosting.h"

extern "C" {

int _write(int /*file*/, const char* bytes, int count) {
  char text[65];
  for (int done = 0; done < count; done += 64) {
    const auto part = static_cast<std::size_t>(std::min(count - done, 64));
    std::memcpy(text, bytes + done, part);
    text[part] = '\0';
    disflow::firmware_test::Print(text);
  }
  return count;
}

[[noreturn]] void _exit(int status) {
  disflow::firmware_test::Exit(static_cast<std::uint32_t>(status));
}
[[noreturn]] void abort() { _exit(134); }
// Referred to by tables of virtual functions; never called.
void __cxa_pure_virtual() { abort(); }

int _close(int /*file*/) { return -1; }
int _fstat(int /*file*/, void* /*status*/) { return 0; }
int _isatty(int /*file*/) { return 1; }
int _lseek(int /*file*/, int /*offset*/, int /*from*/) { return 0; }
int _read(int /*file*/, char* /*bytes*/, int /*count*/) { return 0; }
int _kill(int /*process*/, int /*number*/) { return -1; }
int _getpid() { return 1; }

int disflow_c_main();
}

// The start-up code does not expect main() to return.
int main() { _exit(disflow_c_main()); }

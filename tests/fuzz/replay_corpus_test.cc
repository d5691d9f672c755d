// SPDX-License-Identifier: BSD-3-Clause
// A fuzzer whose fault is known: inputs that begin with '!' end it.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 0 && data[0] == '!') std::abort();
  return 0;
}

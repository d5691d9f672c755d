# SPDX-License-Identifier: BSD-3-Clause
# Flags of this project's own targets. Processor flags (-march and the like) belong in toolchain files and presets.

add_library(disflow_warnings INTERFACE)
target_compile_options(disflow_warnings INTERFACE
  -Wall -Wextra -Wconversion -Wshadow -Wdouble-promotion)
# Whoever takes this project in may compile it with another compiler and with flags of their own; one more warning must
# not fail their build. With sanitizers on, gcc warns about problems that do not exist.
if(DISFLOW_WARNINGS_AS_ERRORS AND NOT (DISFLOW_SANITIZED AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU"))
  target_compile_options(disflow_warnings INTERFACE -Werror)
endif()

# What core, hal and everything that runs on bare metal are compiled with; -fno-math-errno: sqrt becomes an instruction.
# (-ffp-contract=off is a property of disflow_core, because its users need it too.)
add_library(disflow_firmware_flags INTERFACE)
target_compile_options(disflow_firmware_flags INTERFACE
  -fno-exceptions -fno-rtti -fno-threadsafe-statics -fno-math-errno)

# NEON of 32-bit ARM has neither division nor square root. Eigen's vectors of four estimate them there, to 16 bits: rotations were
# off by 4e-6, and what lies in one of them and what beside it was rounded otherwise. Its code without vectors rounds as IEEE 754
# says. Whoever includes Eigen beside this library has to see it the same way.
include(CheckCXXSourceCompiles)
check_cxx_source_compiles("
#if !defined(__arm__) || !defined(__ARM_NEON)
#error divides exactly
#endif
int main() { return 0; }" DISFLOW_EIGEN_DIVIDES_BY_ESTIMATE)
if(DISFLOW_EIGEN_DIVIDES_BY_ESTIMATE)
  set(disflow_eigen_definition EIGEN_DONT_VECTORIZE)
  set(disflow_pc_definition " -D${disflow_eigen_definition}")
  add_compile_definitions(${disflow_eigen_definition})
endif()

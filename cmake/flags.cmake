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

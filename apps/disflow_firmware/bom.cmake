# SPDX-License-Identifier: BSD-3-Clause
# The firmware's bill of materials, beside its images; tests/firmware/check_bom.py compares it with the link map and the headers.
# The packages are those of the machine that builds.
include(${PROJECT_SOURCE_DIR}/cmake/bom_component.cmake)
disflow_bom(Eigen MPL-2.0 "compiled in" libeigen3-dev)
# Its COPYING.NEWLIB has some fifty notices like BSD's.
disflow_bom(newlib "BSD-3-Clause AND BSD-2-Clause AND LicenseRef-COPYING.NEWLIB" linked libnewlib-arm-none-eabi)
disflow_bom(libgcc "GPL-3.0-or-later WITH GCC-exception-3.1" linked gcc-arm-none-eabi)
disflow_bom(libstdc++ "GPL-3.0-or-later WITH GCC-exception-3.1" "compiled in" libstdc++-arm-none-eabi-dev)
execute_process(COMMAND dpkg --print-architecture OUTPUT_VARIABLE disflow_debian_architecture
  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
include(${PROJECT_SOURCE_DIR}/cmake/bom_output.cmake)
add_custom_target(disflow_bom ALL COMMAND ${disflow_write_bom} BYPRODUCTS ${disflow_bom_file} VERBATIM)

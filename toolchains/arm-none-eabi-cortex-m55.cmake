# SPDX-License-Identifier: BSD-3-Clause
# Bare-metal Cortex-M55, scalar: the vector extension (Helium) flushes denormals, and the same input must give the same
# bits everywhere. Debian: as for arm-none-eabi-cortex-m7.cmake.
set(DISFLOW_CPU_FLAGS "-mcpu=cortex-m55+nomve -mthumb -mfloat-abi=hard")
# Single precision for the reason given there.
string(APPEND DISFLOW_CPU_FLAGS " -mfpu=fpv5-sp-d16")
set(CMAKE_SYSTEM_PROCESSOR cortex-m55)
include(${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake)

# SPDX-License-Identifier: BSD-3-Clause
# Bare-metal Cortex-M7. Debian: gcc-arm-none-eabi, libnewlib-arm-none-eabi, libstdc++-arm-none-eabi-dev (headers).
set(DISFLOW_CPU_FLAGS "-mcpu=cortex-m7 -mthumb -mfloat-abi=hard")
# Single precision: every Cortex-M7 with an FPU runs it, and a double that slips into the frame path shows in the image
# as a call of __aeabi_d*.
string(APPEND DISFLOW_CPU_FLAGS " -mfpu=fpv5-sp-d16")
set(CMAKE_SYSTEM_PROCESSOR cortex-m7)
include(${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake)

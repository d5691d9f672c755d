# SPDX-License-Identifier: BSD-3-Clause
# Bare-metal Cortex-M7 with double-precision FPU registers. Debian: gcc-arm-none-eabi, libstdc++-arm-none-eabi-newlib.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR cortex-m7)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_CXX_FLAGS_INIT
  "-mcpu=cortex-m7 -mthumb -mfpu=fpv5-d16 -mfloat-abi=hard -ffunction-sections -fdata-sections")
# Eigen's NEON paths do not compile where int32_t is long, and this core has no NEON.
string(APPEND CMAKE_CXX_FLAGS_INIT " -DEIGEN_DONT_VECTORIZE")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)

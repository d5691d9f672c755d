# SPDX-License-Identifier: BSD-3-Clause
# What all bare-metal toolchain files share; they set DISFLOW_CPU_FLAGS and CMAKE_SYSTEM_PROCESSOR and include this.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
# Eigen's NEON paths do not compile where int32_t is long, and these cores have no NEON.
set(CMAKE_CXX_FLAGS_INIT "${DISFLOW_CPU_FLAGS} -fstack-usage -fcallgraph-info=su -ffunction-sections -fdata-sections -DEIGEN_DONT_VECTORIZE")
set(CMAKE_C_FLAGS_INIT "${DISFLOW_CPU_FLAGS} -ffunction-sections -fdata-sections")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)

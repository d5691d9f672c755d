# SPDX-License-Identifier: BSD-3-Clause
# 32-bit ARMv7 Linux with hard float and NEON. Debian: g++-arm-linux-gnueabihf, qemu-user.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR armv7l)
set(CMAKE_C_COMPILER arm-linux-gnueabihf-gcc)
set(CMAKE_CXX_COMPILER arm-linux-gnueabihf-g++)
# Files may be larger than 2 GiB. GCC 12's -Wrestrict reports overlaps in std::string that do not exist.
set(CMAKE_CXX_FLAGS_INIT "-march=armv7-a+neon-vfpv4 -D_FILE_OFFSET_BITS=64 -Wno-psabi -Wno-restrict")
include(${CMAKE_CURRENT_LIST_DIR}/debian_root.cmake)
disflow_use_debian_root(armhf arm-linux-gnueabihf qemu-arm)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)

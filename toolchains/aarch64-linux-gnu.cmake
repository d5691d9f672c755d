# SPDX-License-Identifier: BSD-3-Clause
# 64-bit ARM Linux: Raspberry Pi 3 and later, Jetson, most edge boards. Debian: g++-aarch64-linux-gnu, qemu-user.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
include(${CMAKE_CURRENT_LIST_DIR}/debian_root.cmake)
disflow_use_debian_root(aarch64 aarch64-linux-gnu qemu-aarch64)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)

# SPDX-License-Identifier: BSD-3-Clause
# Included by toolchain files. The target's libraries are where toolchains/debian_root.sh has unpacked them (./dev does, for
# every build of the preset); without that folder they are those that are installed beside this machine's own.
# DISFLOW_DEBIAN_ROOT: that folder, if it is there. disflow_wanted_root: where it would be.
cmake_path(GET CMAKE_CURRENT_LIST_DIR PARENT_PATH disflow_wanted_root)
# disflow_use_debian_root(<preset> <Debian's triplet> <emulator>)
macro(disflow_use_debian_root preset triplet emulator)
  string(APPEND disflow_wanted_root "/build/${preset}-root")
  if(EXISTS ${disflow_wanted_root})
    set(DISFLOW_DEBIAN_ROOT ${disflow_wanted_root})
    set(CMAKE_FIND_ROOT_PATH ${DISFLOW_DEBIAN_ROOT})
    set(CMAKE_LIBRARY_ARCHITECTURE ${triplet})
    set(CMAKE_CROSSCOMPILING_EMULATOR ${emulator} -L ${DISFLOW_DEBIAN_ROOT})
    # What libraries need themselves.
    add_link_options(-Wl,-rpath-link,${DISFLOW_DEBIAN_ROOT}/usr/lib/${triplet}:${DISFLOW_DEBIAN_ROOT}/lib/${triplet})
  else()
    set(CMAKE_CROSSCOMPILING_EMULATOR ${emulator} -L /usr/${triplet})
  endif()
endmacro()

# SPDX-License-Identifier: BSD-3-Clause
# The bill of materials that is installed beside the documents (CycloneDX, JSON): what the programs are compiled of and linked
# with, with licences and versions. Here is what; write_bom.cmake looks for the versions, as late as the package is made.
# tests/integration/bom compares it with the headers and libraries that really went in.
set(disflow_bom_components "")

# disflow_bom(<name> <licence> <use> <Debian package>): use is "compiled in" or "linked".
macro(disflow_bom name licence use package)
  list(APPEND disflow_bom_components "${name}|${licence}|${use}|${package}")
endmacro()

disflow_bom(Eigen MPL-2.0 "compiled in" libeigen3-dev)
disflow_bom(glibc LGPL-2.1-or-later linked libc6)
disflow_bom(libstdc++ "GPL-3.0-or-later WITH GCC-exception-3.1" linked libstdc++6)
disflow_bom(libgcc "GPL-3.0-or-later WITH GCC-exception-3.1" linked libgcc-s1)
if(DISFLOW_BUILD_APPS)
  disflow_bom(CLI11 BSD-3-Clause "compiled in" libcli11-dev)
  disflow_bom("nlohmann json" MIT "compiled in" nlohmann-json3-dev)
  disflow_bom(nanoflann BSD-2-Clause "compiled in" libnanoflann-dev)
  disflow_bom(toml++ MIT linked libtomlplusplus-dev)
  disflow_bom(yaml-cpp MIT linked libyaml-cpp-dev)
  disflow_bom(tinyobjloader MIT linked libtinyobjloader-dev)
  disflow_bom(libpng libpng-2.0 linked libpng-dev)
endif()
if(DISFLOW_WITH_LIBCAMERA)
  disflow_bom(libcamera LGPL-2.1-or-later linked libcamera-dev)
endif()
if(DISFLOW_WITH_DDS)
  disflow_bom("Cyclone DDS" "EPL-2.0 OR BSD-3-Clause" linked cyclonedds-dev)
endif()
if(DISFLOW_WITH_ROSBAG)
  disflow_bom(LZ4 BSD-2-Clause linked liblz4-dev)
  disflow_bom(Zstandard BSD-3-Clause linked libzstd-dev)
  disflow_bom(SQLite blessing linked libsqlite3-dev)
  disflow_bom(zlib Zlib linked zlib1g-dev)
  disflow_bom(bzip2 bzip2-1.0.6 linked libbz2-dev)
endif()
if(DISFLOW_WITH_VIEW)
  disflow_bom(libwebsockets MIT linked libwebsockets-dev)
endif()

set(disflow_bom_page_parts "")
if(TARGET disflow_view_page)
  set(disflow_bom_page_parts "three|MIT;uplot|MIT")
endif()

include(${CMAKE_CURRENT_LIST_DIR}/bom_paths.cmake)
file(CONFIGURE OUTPUT ${disflow_bom_settings} @ONLY CONTENT [[
set(version "@PROJECT_VERSION@")
set(description "@PROJECT_DESCRIPTION@")
set(architecture "@disflow_debian_architecture@")
set(debian_root "@DISFLOW_DEBIAN_ROOT@")
set(components "@disflow_bom_components@")
set(page_parts "@disflow_bom_page_parts@")
set(page_lock "@PROJECT_SOURCE_DIR@/apps/view/package-lock.json")
]])
set(disflow_bom_file ${PROJECT_BINARY_DIR}/disflow.cdx.json)
install(CODE "execute_process(COMMAND ${CMAKE_COMMAND} -DSETTINGS=${disflow_bom_settings} -DOUTPUT=${disflow_bom_file}
  -P ${PROJECT_SOURCE_DIR}/cmake/write_bom.cmake COMMAND_ERROR_IS_FATAL ANY)"
  COMPONENT programs)
install(FILES ${disflow_bom_file} DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT programs)

# SPDX-License-Identifier: BSD-3-Clause
# From disflow_bom_components and disflow_bom_page_parts: disflow_write_bom, the command that writes disflow_bom_file.
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
set(disflow_write_bom ${CMAKE_COMMAND} -DSETTINGS=${disflow_bom_settings} -DOUTPUT=${disflow_bom_file}
  -P ${PROJECT_SOURCE_DIR}/cmake/write_bom.cmake)

# SPDX-License-Identifier: BSD-3-Clause
# find_package(disflow 0.1 CONFIG) gives disflow::core, disflow::hal and, on Linux, disflow::platform_linux. Components are
# Debian's packages (packaging/CMakeLists.txt); `cmake --install` installs all.
include(CMakePackageConfigHelpers)

set(disflow_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/disflow)
set(disflow_installed_targets disflow_core disflow_hal)
if(TARGET disflow_platform_linux)
  list(APPEND disflow_installed_targets disflow_platform_linux)
endif()
foreach(target IN LISTS disflow_installed_targets)
  string(REPLACE disflow_ "" exported_name ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${exported_name})
endforeach()

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)
install(TARGETS ${disflow_installed_targets} EXPORT disflow_targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY core/include/ hal/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
if(TARGET disflow_platform_linux)
  install(DIRECTORY platform/linux/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endif()
set(disflow_pc_library disflow_core)
if(TARGET disflow_shared)
  set(disflow_pc_library disflow)
  list(APPEND disflow_installed_targets disflow_shared)
  install(TARGETS disflow_shared LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development)
endif()
foreach(program disflow_track disflow_sim disflow_eval)
  if(TARGET ${program})
    install(TARGETS ${program} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT programs)
  endif()
endforeach()
# For compilers without CMake: the core, from C++ (with Eigen's headers) and from C.
file(RELATIVE_PATH disflow_pc_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(cmake/disflow.pc.in ${CMAKE_CURRENT_BINARY_DIR}/disflow.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/disflow.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
install(FILES LICENSE CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT documentation)

install(EXPORT disflow_targets NAMESPACE disflow:: DESTINATION ${disflow_package_dir})
configure_package_config_file(cmake/disflow-config.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/disflow-config.cmake
  INSTALL_DESTINATION ${disflow_package_dir})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/disflow-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/disflow-config.cmake ${CMAKE_CURRENT_BINARY_DIR}/disflow-config-version.cmake
  DESTINATION ${disflow_package_dir})

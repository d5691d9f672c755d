# SPDX-License-Identifier: BSD-3-Clause
# libdisflow.so: core and hal for those who link at run time, from C, C++ or another language. Everything else here links the
# static libraries, so the sources are compiled a second time, position-independent; ./dev package does that.
# Before version 1 every minor version may change interfaces, so both numbers are in the SONAME.
add_library(disflow_shared SHARED)
foreach(part disflow_core disflow_hal)
  get_target_property(sources ${part} SOURCES)
  get_target_property(folder ${part} SOURCE_DIR)
  list(TRANSFORM sources PREPEND ${folder}/)
  target_sources(disflow_shared PRIVATE ${sources})
endforeach()
target_include_directories(disflow_shared PRIVATE core/include hal/include)
target_compile_features(disflow_shared PRIVATE cxx_std_20)
target_link_libraries(disflow_shared PRIVATE Eigen3::Eigen disflow_warnings disflow_firmware_flags)
# Same bits as the static library; and calls inside the library need not be replaceable from outside.
target_compile_options(disflow_shared PRIVATE -ffp-contract=off -fno-semantic-interposition)
# Nothing of the C++ run-time library is used.
target_link_options(disflow_shared PRIVATE -Wl,--as-needed -Wl,--no-undefined)
set_target_properties(disflow_shared PROPERTIES
  OUTPUT_NAME disflow
  VERSION ${PROJECT_VERSION}
  SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})

# SPDX-License-Identifier: BSD-3-Clause
# What each Debian package is called, says of itself and needs.
set(maintainer "DisFlow Edge maintainers <maintainers@disflow.invalid>")
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL programs documentation)
set(CPACK_PACKAGE_NAME disflow)
set(CPACK_PACKAGE_CONTACT ${maintainer})
# Its default; anything else would be put before each package's own.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${CMAKE_PROJECT_NAME} built using CMake")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_PREFIX /usr)
set(CPACK_SET_DESTDIR ON)  # some files are outside of /usr
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE ${disflow_debian_architecture})
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(about "DisFlow follows a rigid object that it has never seen before through the
images of a depth camera. For each image it tells the object's pose and
twist with their covariances, and it builds up the object's shape. It
needs no model, no training and no GPU, and it does not allocate memory.
.")

string(TIMESTAMP changelog_date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/changelog "disflow (${PROJECT_VERSION}) unstable; urgency=medium

  * As CHANGELOG.md in the package disflow-doc tells.

 -- ${maintainer}  ${changelog_date}
")
execute_process(COMMAND gzip --best --no-name --stdout ${CMAKE_CURRENT_BINARY_DIR}/changelog
  OUTPUT_FILE ${CMAKE_CURRENT_BINARY_DIR}/changelog.gz COMMAND_ERROR_IS_FATAL ANY)

# disflow_package(COMPONENT NAME SECTION SUMMARY TEXT [FIELD VALUE]...): a component's package, with the fields of dpkg's
# control file that it has beside those.
function(disflow_package component name section summary text)
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_COMPONENT_${upper}_DESCRIPTION "${summary}
${about}
${text}" PARENT_SCOPE)
  while(ARGN)
    list(POP_FRONT ARGN field value)
    set(CPACK_DEBIAN_${upper}_${field} "${value}" PARENT_SCOPE)
  endwhile()
  set(folder ${CMAKE_INSTALL_DATAROOTDIR}/doc/${name})
  # Others' works are compiled in: the project's own licence alone would leave theirs out.
  install(FILES ${CMAKE_CURRENT_SOURCE_DIR}/debian/copyright DESTINATION ${folder} COMPONENT ${component} EXCLUDE_FROM_ALL)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/changelog.gz DESTINATION ${folder} COMPONENT ${component} EXCLUDE_FROM_ALL)
endfunction()

set(soname_version ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
if(DISFLOW_DEBIAN_ROOT)
  # Where dpkg-shlibdeps looks for the libraries; ./dev names it the database that knows their packages.
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS
    ${DISFLOW_DEBIAN_ROOT}/usr/lib/${CMAKE_LIBRARY_ARCHITECTURE} ${DISFLOW_DEBIAN_ROOT}/lib/${CMAKE_LIBRARY_ARCHITECTURE})
endif()
set(scripts ${CMAKE_CURRENT_SOURCE_DIR}/debian)
disflow_package(programs disflow science "pose, twist and shape of a moving object from depth images"
"This package holds the programs disflow_track, disflow_sim and
disflow_eval, and a service for systemd."
  PACKAGE_SHLIBDEPS ON PACKAGE_SUGGESTS disflow-doc)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_CONTROL_EXTRA ${scripts}/conffiles ${scripts}/postinst ${scripts}/prerm)
disflow_package(documentation disflow-doc doc "pose, twist and shape of a moving object from depth images (documentation)"
"This package holds the documentation: tutorials, guides, reference,
method and results."
  PACKAGE_ARCHITECTURE all)
if(TARGET disflow_shared)
  list(APPEND CPACK_COMPONENTS_ALL library development)
  set(control ${CMAKE_CURRENT_BINARY_DIR}/library)
  file(WRITE ${control}/shlibs "libdisflow ${soname_version} libdisflow${soname_version} (>= ${PROJECT_VERSION})\n")
  file(WRITE ${control}/triggers "activate-noawait ldconfig\n")
  disflow_package(library libdisflow${soname_version} libs "pose, twist and shape of a moving object from depth images (library)"
"This package holds the shared library."
    PACKAGE_DEPENDS "libc6 (>= 2.34)")
  set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${control}/shlibs ${control}/triggers)
  disflow_package(development libdisflow-dev libdevel "pose, twist and shape of a moving object from depth images (development)"
"This package holds what programs in C++ and C are compiled with: headers,
static libraries, and files for CMake and pkg-config."
    PACKAGE_DEPENDS "libdisflow${soname_version} (= ${PROJECT_VERSION}), libeigen3-dev (>= 3.4)" PACKAGE_SUGGESTS disflow-doc)
endif()
if(DISFLOW_PYTHON_MODULE)
  # Debian's, for which it was compiled.
  execute_process(COMMAND /usr/bin/python3 -c "import sys; print(sys.version_info.minor, sys.version_info.minor + 1, sep=';')"
    OUTPUT_VARIABLE minors OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  list(GET minors 0 this_python)
  list(GET minors 1 next_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  install(DIRECTORY ${DISFLOW_PYTHON_MODULE}/ DESTINATION lib/python3/dist-packages COMPONENT python EXCLUDE_FROM_ALL
    PATTERN "__pycache__" EXCLUDE PATTERN "INSTALLER" EXCLUDE PATTERN "RECORD" EXCLUDE PATTERN "REQUESTED" EXCLUDE
    PATTERN "direct_url.json" EXCLUDE)
  disflow_package(python python3-disflow python "pose, twist and shape of a moving object from depth images (Python)"
"This package holds the module disflow for Python 3, which takes and gives
arrays of numpy."
    PACKAGE_DEPENDS "python3 (>= 3.${this_python}), python3 (<< 3.${next_python}), python3-numpy, libc6 (>= 2.34), libgcc-s1 (>= 4.3), libstdc++6 (>= 12)")
endif()
include(CPack)

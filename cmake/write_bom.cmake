# SPDX-License-Identifier: BSD-3-Clause
# Writes the bill of materials that bom.cmake describes: cmake -DSETTINGS=FILE -DOUTPUT=FILE -P write_bom.cmake
# The same on every run: it has neither a time nor a number of its own.
cmake_minimum_required(VERSION 3.25)
include(${SETTINGS})

# The version of what is installed, for another processor of what lies in the folder that its libraries are in; empty on
# systems without dpkg.
function(version_of package result)
  set(${result} "" PARENT_SCOPE)
  find_program(dpkg_query dpkg-query)
  if(NOT dpkg_query)
    return()
  endif()
  foreach(database ${debian_root} "")
    foreach(name ${package}:${architecture} ${package}:all)
      execute_process(COMMAND ${dpkg_query} --admindir=${database}/var/lib/dpkg -W -f "\${db:Status-Status} \${Version}" ${name}
        OUTPUT_VARIABLE output ERROR_QUIET RESULT_VARIABLE status)
      if(status EQUAL 0 AND output MATCHES "^installed (.+)$")
        set(${result} ${CMAKE_MATCH_1} PARENT_SCOPE)
        return()
      endif()
    endforeach()
  endforeach()
endfunction()

set(distribution debian)
if(EXISTS /etc/os-release)
  file(STRINGS /etc/os-release lines REGEX "^ID=")
  string(REGEX REPLACE "^ID=\"?([a-z]+)\"?$" "\\1" distribution "${lines}")
endif()

set(items "")
set(references "")

# add_component(<name> <version> <licence> <purl> <use>)
function(add_component name version licence purl use)
  set(version_line "")
  if(version)
    set(version_line "\n      \"version\": \"${version}\",")
  endif()
  if(licence MATCHES " ")
    set(licences "{\"expression\": \"${licence}\"}")
  else()
    set(licences "{\"license\": {\"id\": \"${licence}\"}}")
  endif()
  string(APPEND items ",
    {
      \"type\": \"library\",
      \"bom-ref\": \"${purl}\",
      \"name\": \"${name}\",${version_line}
      \"licenses\": [${licences}],
      \"purl\": \"${purl}\",
      \"properties\": [{\"name\": \"disflow:use\", \"value\": \"${use}\"}]
    }")
  string(APPEND references ",\n        \"${purl}\"")
  set(items "${items}" PARENT_SCOPE)
  set(references "${references}" PARENT_SCOPE)
endfunction()

foreach(component IN LISTS components)
  string(REPLACE "|" ";" fields "${component}")
  list(GET fields 0 name)
  list(GET fields 1 licence)
  list(GET fields 2 use)
  list(GET fields 3 package)
  version_of(${package} found)
  string(REPLACE "+" "%2B" encoded_package "${package}")
  set(purl "pkg:deb/${distribution}/${encoded_package}")
  if(found)
    string(REPLACE "+" "%2B" encoded "${found}")
    string(REPLACE ":" "%3A" encoded "${encoded}")
    string(APPEND purl "@${encoded}")
  endif()
  add_component("${name}" "${found}" "${licence}" "${purl}?arch=${architecture}" "${use}")
endforeach()

if(page_parts)
  file(READ ${page_lock} lock)
endif()
foreach(part IN LISTS page_parts)
  string(REPLACE "|" ";" fields "${part}")
  list(GET fields 0 name)
  list(GET fields 1 licence)
  string(JSON found GET "${lock}" packages node_modules/${name} version)
  add_component("${name}" "${found}" "${licence}" "pkg:npm/${name}@${found}" "part of the live view's page")
endforeach()

string(SUBSTRING "${items}" 1 -1 items)
string(SUBSTRING "${references}" 1 -1 references)
file(WRITE ${OUTPUT} "{
  \"bomFormat\": \"CycloneDX\",
  \"specVersion\": \"1.5\",
  \"version\": 1,
  \"metadata\": {
    \"component\": {
      \"type\": \"application\",
      \"bom-ref\": \"disflow\",
      \"name\": \"disflow\",
      \"version\": \"${version}\",
      \"description\": \"${description}\",
      \"licenses\": [{\"license\": {\"id\": \"BSD-3-Clause\"}}]
    }
  },
  \"components\": [${items}
  ],
  \"dependencies\": [
    {
      \"ref\": \"disflow\",
      \"dependsOn\": [${references}
      ]
    }
  ]
}
")

# SPDX-License-Identifier: BSD-3-Clause
# An incomplete profile gives one error, and the compiler names the missing member; complete, it compiles.
function(compile result_name)
  execute_process(COMMAND ${CXX} -std=c++20 -fsyntax-only -I${CORE_INCLUDE} -isystem ${EIGEN_INCLUDE} ${ARGN} ${SOURCE}
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  set(${result_name} ${result} PARENT_SCOPE)
  set(output "${output}" PARENT_SCOPE)
endfunction()

compile(result -DCOMPLETE)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "the complete profile does not compile:\n${output}")
endif()
compile(result)
string(REGEX MATCHALL "error: " errors "${output}")
list(LENGTH errors count)
if(result EQUAL 0 OR NOT count EQUAL 1 OR NOT output MATCHES "note: [^\n]*kMaxNodes[^\n]*invalid")
  message(FATAL_ERROR "expected one error with a note that names kMaxNodes, got ${count}:\n${output}")
endif()

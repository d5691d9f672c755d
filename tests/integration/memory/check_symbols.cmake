# SPDX-License-Identifier: BSD-3-Clause
# cmake -DNM=nm -DARCHIVES=a.a;b.a -P check_symbols.cmake
foreach(archive IN LISTS ARCHIVES)
  execute_process(COMMAND ${NM} -C --undefined-only ${archive} OUTPUT_VARIABLE symbols RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${NM} cannot read ${archive}")
  endif()
  string(REGEX MATCHALL
    " U (malloc|calloc|realloc|free|aligned_alloc|posix_memalign|operator new[^\n]*|operator delete[^\n]*|__cxa_throw|__cxa_allocate_exception|__cxa_guard[^\n]*|std::[^\n]*ostream[^\n]*|clock_gettime|pthread_[^\n]*)\n"
    found "${symbols}")
  if(found)
    message(FATAL_ERROR "${archive} refers to what firmware must not use:\n${found}")
  endif()
  string(LENGTH "${symbols}" length)
  if(length LESS 100)
    message(FATAL_ERROR "${archive}: nm lists next to nothing; the check would be void")
  endif()
endforeach()

# SPDX-License-Identifier: BSD-3-Clause
# Manual pages of the programs, from what their --help says: help2man, on this processor or under an emulator.
set(disflow_man ${CMAKE_CURRENT_BINARY_DIR}/man)
file(MAKE_DIRECTORY ${disflow_man})
set(disflow_man_pages)
set(summary_disflow_track "pose and twist of an object in front of a depth camera")
set(summary_disflow_sim "write the depth images of a simulated camera, with ground truth")
set(summary_disflow_eval "judge a trajectory by ground truth")
foreach(program disflow_track disflow_sim disflow_eval)
  if(NOT TARGET ${program})
    continue()
  endif()
  set(page ${disflow_man}/${program}.1)
  # help2man starts one command; an emulator with its options is none.
  set(starter ${disflow_man}/${program})
  list(JOIN CMAKE_CROSSCOMPILING_EMULATOR " " emulator)
  file(GENERATE OUTPUT ${starter} CONTENT "#!/bin/sh\nexec ${emulator} $<TARGET_FILE:${program}> \"$@\"\n"
    FILE_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
  add_custom_command(OUTPUT ${page}.gz
    COMMAND help2man --no-info --section=1 --name=${summary_${program}} --source=DisFlow --manual=DisFlow
      --include=${CMAKE_CURRENT_SOURCE_DIR}/man/see_also.h2m --output=${page} ${starter}
    COMMAND gzip --best --no-name --force ${page}
    DEPENDS ${program} ${CMAKE_CURRENT_SOURCE_DIR}/man/see_also.h2m
    COMMENT "Manual page of ${program}" VERBATIM)
  list(APPEND disflow_man_pages ${page}.gz)
endforeach()

# Writes the commit of SOURCE to OUTPUT, a header. Where SOURCE is no git repository itself (an archive, also one that is
# unpacked in another repository) it is COMMIT, or "unknown" where that is not given.
execute_process(
  COMMAND git rev-parse --show-prefix
  WORKING_DIRECTORY ${SOURCE}
  RESULT_VARIABLE failure
  OUTPUT_VARIABLE prefix
  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(failure EQUAL 0 AND prefix STREQUAL "")
  execute_process(
    COMMAND git describe --tags --always --dirty
    WORKING_DIRECTORY ${SOURCE}
    OUTPUT_VARIABLE commit
    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
if(NOT commit)
  set(commit "${COMMIT}")
endif()
if(NOT commit)
  set(commit unknown)
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#define STICKSLIP_COMMIT \"${commit}\"\n") # keeps the file if its content is the same

# Runs two programs and compares the first lines that they print: cmake -D FIRST=... -D SECOND=... -P same_answer.cmake
foreach(program FIRST SECOND)
  execute_process(COMMAND ${${program}} OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCH "^[^\n]+" ${program}_LINE "${output}")
endforeach()
if(NOT FIRST_LINE OR NOT FIRST_LINE STREQUAL SECOND_LINE)
  message(FATAL_ERROR "the programs print\n  ${FIRST_LINE}\n  ${SECOND_LINE}")
endif()
message("${SECOND_LINE}")

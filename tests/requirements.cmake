# Preprocesses each public header by COMPILER with options that stickslip refuses: one #error that says why, and an end.
function(expect_refusal reason)
  file(GLOB_RECURSE headers RELATIVE ${INCLUDE} ${INCLUDE}/*.hpp)
  foreach(header IN LISTS headers)
    file(WRITE ${FOLDER}/refused.cpp "#include \"${header}\"\n")
    execute_process(
      COMMAND ${COMPILER} ${ARGN} -I${INCLUDE} -E ${FOLDER}/refused.cpp
      RESULT_VARIABLE result ERROR_VARIABLE output OUTPUT_QUIET)
    string(REGEX MATCHALL "error: [^\n]*" errors "${output}")
    list(LENGTH errors count)
    list(GET errors 0 first)
    # The second is the end: a header that does not exist.
    if(result EQUAL 0 OR NOT count EQUAL 2 OR NOT first MATCHES "${reason}")
      message(FATAL_ERROR "${header} with ${ARGN}: expected one error with '${reason}', got\n${output}")
    endif()
  endforeach()
endfunction()

expect_refusal("needs C\\+\\+20" -std=c++17)
expect_refusal("needs IEEE 754 arithmetic" -std=c++20 -ffast-math)
expect_refusal("needs IEEE 754 arithmetic" -std=c++20 -Ofast)
expect_refusal("needs IEEE 754 arithmetic" -std=c++20 -ffinite-math-only)

# Preprocesses public headers by COMPILER with options that stickslip refuses: one #error that says why, and an end.
function(expect_refusal headers reason)
  foreach(header IN LISTS ${headers})
    file(WRITE ${FOLDER}/refused.cpp "#include \"${header}\"\n")
    execute_process(
      COMMAND ${COMPILER} ${ARGN} -I${INCLUDE} -E ${FOLDER}/refused.cpp
      RESULT_VARIABLE result ERROR_VARIABLE output OUTPUT_QUIET)
    string(REGEX MATCHALL "error: [^\n]*" errors "${output}")
    list(LENGTH errors count)
    list(APPEND errors "no error")
    list(GET errors 0 first)
    # The second is the end: a header that does not exist.
    if(result EQUAL 0 OR NOT count EQUAL 2 OR NOT first MATCHES "${reason}")
      message(FATAL_ERROR "${header} with ${ARGN}: expected one error with '${reason}', got\n${output}")
    endif()
  endforeach()
endfunction()

# Each header, whichever comes first; and each option, by one of them.
file(GLOB_RECURSE all RELATIVE ${INCLUDE} ${INCLUDE}/*.hpp)
set(core stickslip/core.hpp)
expect_refusal(all "needs IEEE 754 arithmetic" -std=c++20 -ffast-math)
expect_refusal(core "needs IEEE 754 arithmetic" -std=c++20 -Ofast)
expect_refusal(core "needs IEEE 754 arithmetic" -std=c++20 -ffinite-math-only)
expect_refusal(core "needs C\\+\\+20" -std=c++17)

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
expect_refusal(core "needs exceptions" -std=c++20 -fno-exceptions)
expect_refusal(core "needs C\\+\\+20" -std=c++17)

# A class that is not a friction law: one error, which says what is expected.
function(expect_rejected_law resist reason)
  file(WRITE ${FOLDER}/rejected.cpp "#include \"stickslip/core.hpp\"\n"
       "using stickslip::Direction;\n"
       "struct Law { static constexpr bool numeric = true; double ${resist} { return 1; } };\n"
       "const stickslip::Slider slider(Law{});\n")
  execute_process(
    COMMAND ${COMPILER} -std=c++20 -I${INCLUDE} -fsyntax-only ${FOLDER}/rejected.cpp
    RESULT_VARIABLE result ERROR_VARIABLE output OUTPUT_QUIET)
  string(REPLACE ";" "," output "${output}") # else a list
  string(REGEX MATCHALL "error: [^\n]*" errors "${output}")
  list(LENGTH errors count)
  if(result EQUAL 0 OR NOT count EQUAL 1 OR NOT errors MATCHES "${reason}")
    message(FATAL_ERROR "law with ${resist}: expected one error with '${reason}', got\n${output}")
  endif()
endfunction()
expect_rejected_law("resist(double, Direction, double) const" "the order of arguments is resist.x, speed, direction.")
expect_rejected_law("resist(double) const" "must be copyable and define .resist.x, direction. const. or")
expect_rejected_law("resist(double, Direction)" "must be copyable and define .resist.x, direction. const. or")

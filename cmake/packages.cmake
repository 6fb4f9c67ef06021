# Finds libraries, and lists in one message the packages of those that are missing.

# stickslip_find(<name> [VERSION v] APT <package> BREW <package> CONDA <package>): a macro, because packages set
# variables where they are found.
macro(stickslip_find name)
  cmake_parse_arguments(_stickslip "" "VERSION;APT;BREW;CONDA" "" ${ARGN})
  find_package(${name} ${_stickslip_VERSION} QUIET)
  if(NOT ${name}_FOUND)
    list(APPEND stickslip_missing ${name})
    list(APPEND stickslip_apt ${_stickslip_APT})
    list(APPEND stickslip_brew ${_stickslip_BREW})
    list(APPEND stickslip_conda ${_stickslip_CONDA})
  endif()
endmacro()

# stickslip_stop_if_missing(<how to do without>)
function(stickslip_stop_if_missing otherwise)
  if(stickslip_missing)
    list(JOIN stickslip_missing ", " names)
    list(JOIN stickslip_apt " " apt)
    list(JOIN stickslip_brew " " brew)
    list(JOIN stickslip_conda " " conda)
    message(
      FATAL_ERROR
        "stickslip needs what was not found here: ${names}. Install with one of\n"
        "  Debian, Ubuntu:  apt install --no-install-recommends ${apt}\n"
        "  macOS:           brew install ${brew}\n"
        "  conda:           conda install -c conda-forge ${conda}\n"
        "and name an unusual place with -DCMAKE_PREFIX_PATH=... (in conda: $CONDA_PREFIX).\n"
        "${otherwise}")
  endif()
endfunction()

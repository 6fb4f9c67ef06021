// What a number was computed with.
#pragma once

#include <string>

#include "stickslip/detail/requirements.hpp"

namespace stickslip {

/// How the compiled library was made, and the versions of the libraries that are loaded with it.
struct BuildInfo {
  std::string version;         ///< of stickslip
  std::string compiler;        ///< such as "GNU 12.2.0"
  std::string build_type;      ///< such as "Release"
  std::string compiler_flags;  ///< such as "-O3 -DNDEBUG"
  std::string commit;          ///< as `git describe` has it, with "-dirty" where edited; "unknown" outside a repository
  std::string fftw;            ///< at run time, such as "3.3.10-sse2-avx"
  std::string gsl;
  std::string sundials;
};

/// What a bench prints beside its numbers, and what `stickslip --version` shows.
const BuildInfo& build_info();

}  // namespace stickslip

// The build and the libraries with which a number was computed.
#pragma once

#include <string>

#include "stickslip/base/requirements.hpp"

namespace stickslip {

/// The build of the compiled library, and the versions of the libraries loaded with it.
struct BuildInfo {
  std::string version;         ///< of stickslip
  std::string compiler;        ///< such as "GNU 12.2.0"
  std::string build_type;      ///< such as "Release"
  std::string compiler_flags;  ///< such as "-O3 -DNDEBUG"
  std::string commit;          ///< by `git describe`, with "-dirty" if edited; "unknown" outside a repository
  std::string eigen;           ///< headers alone, so at compile time
  std::string fftw;            ///< at run time, such as "3.3.10-sse2-avx"
  std::string gsl;
  std::string highway;  ///< at compile time
  std::string sundials;
};

/// The build information, as benches and `stickslip --version` print it.
const BuildInfo& build_info();

}  // namespace stickslip

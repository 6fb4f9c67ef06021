#include "stickslip/build_info.hpp"

#include <fftw3.h>
#include <gsl/gsl_version.h>
#include <sundials/sundials_version.h>

#include <string>

#include "commit.hpp"

namespace stickslip {
namespace {

// "fftw-3.3.10-sse2-avx": the name is removed; the instruction sets stay because they determine the speed.
std::string fftw() {
  const std::string text = fftw_version;
  return text.starts_with("fftw-") ? text.substr(5) : text;
}

std::string sundials() {
  char text[64];
  return SUNDIALSGetVersion(text, sizeof text) == 0 ? text : "unknown";
}

}  // namespace

const BuildInfo& build_info() {
  static const BuildInfo info{
      .version = STICKSLIP_VERSION,
      .compiler = STICKSLIP_COMPILER,
      .build_type = STICKSLIP_BUILD_TYPE,
      .compiler_flags = STICKSLIP_COMPILER_FLAGS,
      .commit = STICKSLIP_COMMIT,
      .fftw = fftw(),
      .gsl = gsl_version,
      .sundials = sundials(),
  };
  return info;
}

}  // namespace stickslip

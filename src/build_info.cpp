#include "stickslip/build_info.hpp"

#include <fftw3.h>
#include <gsl/gsl_version.h>
#include <hwy/highway.h>
#include <sundials/sundials_version.h>

#include <Eigen/Core>
#include <string>

#include "commit.hpp"

namespace stickslip {
namespace {

// "fftw-3.3.10-sse2-avx": the name is removed; the instruction sets stay because they determine the speed.
std::string fftw() {
  const std::string text = fftw_version;
  return text.starts_with("fftw-") ? text.substr(5) : text;
}

std::string release(int major, int minor, int patch) {
  return std::to_string(major) + '.' + std::to_string(minor) + '.' + std::to_string(patch);
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
      .eigen = release(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION),
      .fftw = fftw(),
      .gsl = gsl_version,
      .highway = release(HWY_MAJOR, HWY_MINOR, HWY_PATCH),
      .sundials = sundials(),
  };
  return info;
}

}  // namespace stickslip

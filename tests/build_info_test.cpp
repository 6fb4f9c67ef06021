#include "stickslip/build_info.hpp"

#include <cctype>

#include "support/catch.hpp"

using namespace stickslip;

TEST_CASE("the build information identifies how a number was computed") {
  const BuildInfo& info = build_info();
  for (const std::string& version : {info.version, info.eigen, info.fftw, info.gsl, info.highway, info.sundials}) {
    CAPTURE(version);
    REQUIRE(!version.empty());
    CHECK(std::isdigit(static_cast<unsigned char>(version[0])));
    CHECK(version.find('.') != std::string::npos);
  }
  CHECK(!info.compiler.empty());
  CHECK(!info.commit.empty());
}

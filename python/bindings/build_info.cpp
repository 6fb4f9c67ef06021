#include "bindings.hpp"

namespace stickslip::python {

void bind_build_info(py::module_& m) {
  m.attr("__version__") = build_info().version;
  m.def(
      "build_info",
      [] {
        const BuildInfo& info = build_info();
        py::dict result;
        result["version"] = info.version;
        result["commit"] = info.commit;
        result["compiler"] = info.compiler;
        result["eigen"] = info.eigen;
        result["fftw"] = info.fftw;
        result["gsl"] = info.gsl;
        result["highway"] = info.highway;
        result["sundials"] = info.sundials;
        return result;
      },
      R"(Version, commit and compiler of this build, and the libraries that it contains.

FFTW and GSL are under the GPL: a binary that contains them is distributed under GPL-3.0-or-later.

Returns
-------
dict of str)");
}

}  // namespace stickslip::python

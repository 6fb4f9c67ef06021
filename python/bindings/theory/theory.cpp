#include "theory/theory.hpp"

#include "parts.hpp"

namespace stickslip::python {

void bind_theory(py::module_& m) {
  using theory::Coverage;
  value_class<Coverage>(m, "Coverage", R"(Whether a theory covers a slider under an excitation and, if not, why.

The result of each theory's `covers`. It is true if `reason` is empty.

Parameters
----------
reason : str, optional
    Why not, in one sentence; empty if the theory covers them.
excitation : bool, optional
    False if the theory is for other kinds of excitation, for any slider; `compare` then omits it.)")
      .def(py::init([](std::string reason, bool excitation) {
             return Coverage{std::move(reason), excitation};
           }),
           py::arg("reason") = "", py::kw_only(), py::arg("excitation") = true)
      .def_readonly("reason", &Coverage::reason, "Why not, in one sentence; '' if the theory covers them.")
      .def_readonly("excitation", &Coverage::excitation,
                    "False if the theory is for other kinds of excitation, for any slider.")
      .def("__bool__", [](const Coverage& self) { return static_cast<bool>(self); })
      .def("__repr__", [](const Coverage& self) {
        return self ? std::string("<Coverage: yes>") : "<Coverage: no, " + self.reason + ">";
      });
}

}  // namespace stickslip::python

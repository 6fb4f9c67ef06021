#include "theory/theory.hpp"

#include "parts.hpp"

namespace stickslip::python {

void bind_theory(py::module_& m) {
  using theory::Coverage;
  value_class<Coverage>(m, "Coverage", R"(Whether a theory covers a slider under an excitation and, if not, why.

What each theory's `covers` answers. It is true where `reason` is empty.

Parameters
----------
reason : str, optional
    Why not, in one sentence; empty where the theory covers them.
excitation : bool, optional
    False where the theory is for excitations of another kind, whatever slides; `compare` then leaves it out.)")
      .def(py::init([](std::string reason, bool excitation) {
             return Coverage{std::move(reason), excitation};
           }),
           py::arg("reason") = "", py::kw_only(), py::arg("excitation") = true)
      .def_readonly("reason", &Coverage::reason, "Why not, in one sentence; '' where the theory covers them.")
      .def_readonly("excitation", &Coverage::excitation,
                    "False where the theory is for excitations of another kind, whatever slides.")
      .def("__bool__", [](const Coverage& self) { return static_cast<bool>(self); })
      .def("__repr__", [](const Coverage& self) {
        return self ? std::string("<Coverage: yes>") : "<Coverage: no, " + self.reason + ">";
      });
}

}  // namespace stickslip::python

#include <concepts>
#include <functional>
#include <string>
#include <tuple>
#include <type_traits>

#include "bindings.hpp"

namespace stickslip::python {
namespace {

// The parts of a law: of each its name, symbol, unit and rule. A part that lists parts itself is replaced by them.
template <WithParts T>
void add_parts(py::list& to) {
  const auto add = [&](const auto& part) {
    using Value = std::remove_cvref_t<std::invoke_result_t<decltype(part.get), const T&>>;
    if constexpr (WithParts<Value>)
      add_parts<Value>(to);
    else
      to.append(py::make_tuple(part.name, part.symbol, part.unit,
                               std::same_as<Value, bool>
                                   ? "true or false"
                                   : (std::integral<Value> ? "a whole number " : "") + part.range.rule()));
  };
  std::apply([&](const auto&... part) { (add(part), ...); }, T::parts());
}

// The laws that describe themselves, by the names that identities have.
py::dict laws() {
  py::dict all;
  LibraryLaws::for_each([&]<class Law>() {
    if constexpr (WithParts<Law>) {
      py::list listed;
      add_parts<Law>(listed);
      all[Law::class_name] = listed;
    }
  });
  return all;
}

}  // namespace

void bind_laws(py::module_& m) {
  py::class_<AnyLaw>(m, "FrictionLaw", R"(The base class of all friction laws, for `isinstance`.

A law gives the friction force per unit mass [m/s^2] where the normal force is g: what it holds at rest, and what
resists sliding. `Slider(law).hold()` and `Slider(law).resist(speed=...)` tell both. To define a law of your own from
functions, use `Law`.)");
  LibraryLaws::for_each([&]<class Law>() {
    if constexpr (!is_static_kinetic<Law>) bind_law<Law>(m);
  });
  bind_static_kinetic(m);
  m.def("_laws", &laws, "The parts of each law that lists them: name, symbol, unit and rule, by the name of the law.");
}

}  // namespace stickslip::python

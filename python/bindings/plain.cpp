// Signatures and errors of the module in plain Python terms: signatures that `inspect` and `help` can read, and
// messages without the vocabulary of the binding library.
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "bindings.hpp"

namespace stickslip::python {
namespace {

/// The end of the bracketed or quoted text that starts at `begin`.
std::size_t end_of(std::string_view text, std::size_t begin) {
  const char open = text[begin];
  if (open == '\'' || open == '"') {
    std::size_t i = begin + 1;
    while (i < text.size() && text[i] != open) i += text[i] == '\\' ? 2 : 1;
    return i + 1;
  }
  std::size_t i = begin + 1;
  while (i < text.size() && std::string_view(")]}").find(text[i]) == std::string_view::npos)
    i = std::string_view("([{'\"").find(text[i]) == std::string_view::npos ? i + 1 : end_of(text, i);
  return i + 1;
}

/// The position of `what` outside brackets and quotes, or the end.
std::size_t find_outside(std::string_view text, std::string_view what) {
  for (std::size_t i = 0; i < text.size();) {
    if (text.substr(i).starts_with(what)) return i;
    i = std::string_view("([{'\"").find(text[i]) == std::string_view::npos ? i + 1 : end_of(text, i);
  }
  return text.size();
}

struct Parameter {
  std::string name, value;  // value: the default, or empty
};

/// A parameter without a name in C++ cannot be passed by name.
bool nameless(std::string_view name) {
  return name.starts_with("arg") && name.find_first_not_of("0123456789", 3) == std::string_view::npos;
}

/// The parameters of a list such as "self: Slider, x: float = 0.0, *, backward: bool = False".
std::vector<Parameter> parameters_of(std::string_view text) {
  std::vector<Parameter> found;
  while (!text.empty()) {
    const std::size_t end = find_outside(text, ", ");
    const std::string_view one = text.substr(0, end), named = one.substr(0, find_outside(one, " = "));
    std::string value(one.substr(std::min(named.size() + 3, one.size())));
    // A default that is not a literal cannot be parsed.
    if (!value.empty() && value != "[]" && value != "()" && value != "None" && value != "True" && value != "False" &&
        std::string_view("0123456789'\"").find(value[value[0] == '-' ? 1 : 0]) == std::string_view::npos)
      value = "...";
    found.push_back({std::string(named.substr(0, find_outside(named, ": "))), std::move(value)});
    text.remove_prefix(std::min(end + 2, text.size()));
  }
  return found;
}

std::string text_of(const std::vector<Parameter>& parameters) {
  std::string text;
  for (const Parameter& one : parameters)
    text += (text.empty() ? "" : ", ") + (nameless(one.name) ? "other, /" : one.name) + (one.value.empty() ? "" : "=") +
            one.value;
  return text;
}

/// The call as a user writes it, without the object of a method.
std::string call_of(const std::string& name, std::vector<Parameter> form) {
  if (!form.empty() && form[0].name == "self") form.erase(form.begin());
  return name + "(" + text_of(form) + ")";
}

/// One signature for all overloads: the longest one, with defaults for parameters that other overloads lack, and then those
/// by name that only others have. If no such signature exists, the result accepts anything, and the text begins with a list of the overloads.
std::string signature_of(const std::string& name, const std::vector<std::vector<Parameter>>& forms, std::string& text) {
  std::vector<Parameter> longest;
  for (const auto& form : forms)
    if (form.size() > longest.size()) longest = form;
  bool after_optional = false, by_name = false, fits = true;
  for (Parameter& one : longest) {
    const auto has = [&](const std::vector<Parameter>& form) {
      return std::ranges::any_of(form, [&](const Parameter& p) { return p.name == one.name; });
    };
    by_name = by_name || one.name == "*";
    if (one.value.empty() && one.name != "*" && one.name != "/") {
      if (!std::ranges::all_of(forms, has))
        one.value = "...";
      else if (after_optional && !by_name)
        fits = false;
    }
    after_optional = after_optional || !one.value.empty();
  }
  for (const auto& form : by_name&& fits ? forms : std::vector<std::vector<Parameter>>())
    for (auto one = std::ranges::find(form, "*", &Parameter::name); one != form.end(); ++one)
      if (std::ranges::find(longest, one->name, &Parameter::name) == longest.end())
        longest.push_back({one->name, one->value.empty() ? "..." : one->value});
  if (fits) return text_of(longest);
  std::string known;
  for (const auto& form : forms) known += call_of(name, form) + "\n";
  text = known + text;
  return "self, *args, **kwargs";
}

/// The documentation by pybind11, with one signature that CPython understands in place of all typed ones.
std::string plain(const std::string& name, const std::string& doc) {
  const auto parameters_at = [&](std::size_t begin) {
    return parameters_of(std::string_view(doc).substr(begin + 1, end_of(doc, begin) - begin - 2));
  };
  const auto after_line = [&](std::size_t i) { return std::min(doc.find('\n', i), doc.size() - 1) + 1; };
  std::vector<std::vector<Parameter>> forms;
  std::string text;
  const std::string overloaded = name + "(*args, **kwargs)\nOverloaded function.\n";
  if (!doc.starts_with(overloaded)) {
    forms.push_back(parameters_at(name.size()));
    text = doc.substr(after_line(end_of(doc, name.size())));
  }
  for (std::size_t i = overloaded.size(), number = 1; doc.starts_with(overloaded); ++number) {
    const auto heading = [&](std::size_t of) { return std::string("\n").append(std::to_string(of)) + ". " + name; };
    const std::string head = heading(number);
    i = doc.find(head + "(", i - 1);
    if (i == std::string::npos) break;
    const std::size_t bracket = i + head.size(), begin = after_line(end_of(doc, bracket));
    const std::size_t next = doc.find(heading(number + 1) + "(", begin - 1);
    forms.push_back(parameters_at(bracket));
    const std::string own = doc.substr(begin, next == std::string::npos ? next : next - begin);
    if (own.find_first_not_of('\n') != std::string::npos)
      text += (text.empty() ? "" : "\n" + call_of(name, forms.back()) + "\n") + own;
    i = begin;
  }
  const std::string signature = signature_of(name, forms, text);
  return name + "(" + signature + ")\n--\n\n" + text.substr(std::min(text.find_first_not_of('\n'), text.size()));
}

/// Full names of functions, by the object that CPython passes to them.
std::unordered_map<PyObject*, std::string>& names() {
  static auto* const names = new std::unordered_map<PyObject*, std::string>;
  return *names;
}

/// Replaces a pybind11 message about rejected arguments by a plain-language one.
void explain(PyObject* function, const py::tuple& args, const py::dict& kwargs) {
  if (PyErr_ExceptionMatches(PyExc_TypeError) == 0) return;
  py::error_already_set error;
  const auto message = py::str(error.value()).cast<std::string>();
  if (message.find("(): incompatible ") == std::string::npos) {
    error.restore();
    return;
  }
  try {
    const py::object text =
        py::module_::import("stickslip._refusals").attr("explain")(names().at(function), args, kwargs);
    PyErr_SetObject(PyExc_TypeError, text.ptr());
  } catch (py::error_already_set& other) {
    other.restore();
  }
}

// pybind11 calls all its functions in one of two ways, which depends on its version.
using FastCall = PyObject* (*)(PyObject*, PyObject* const*, Py_ssize_t, PyObject*);
FastCall fast = nullptr;
PyCFunctionWithKeywords slow = nullptr;

PyObject* call_fast(PyObject* self, PyObject* const* given, Py_ssize_t count, PyObject* keywords) {
  PyObject* const result = fast(self, given, count, keywords);
  if (result != nullptr) return result;
  py::tuple args(static_cast<std::size_t>(count));
  for (Py_ssize_t i = 0; i < count; ++i)
    args[static_cast<std::size_t>(i)] = py::reinterpret_borrow<py::object>(given[i]);
  py::dict kwargs;
  if (keywords != nullptr)
    for (Py_ssize_t i = 0; i < PyTuple_GET_SIZE(keywords); ++i)
      kwargs[py::handle(PyTuple_GET_ITEM(keywords, i))] = py::reinterpret_borrow<py::object>(given[count + i]);
  explain(self, args, kwargs);
  return nullptr;
}

PyObject* call_slow(PyObject* self, PyObject* given, PyObject* keywords) {
  PyObject* const result = slow(self, given, keywords);
  if (result != nullptr) return result;
  explain(self, py::reinterpret_borrow<py::tuple>(given),
          keywords == nullptr ? py::dict() : py::reinterpret_borrow<py::dict>(keywords));
  return nullptr;
}

void make_function_plain(py::handle object, const std::string& owner) {
  if (PyInstanceMethod_Check(object.ptr()) != 0) object = PyInstanceMethod_Function(object.ptr());
  if (Py_IS_TYPE(object.ptr(), &PyStaticMethod_Type)) {
    make_function_plain(object.attr("__func__"), owner);
    return;
  }
  if (PyCFunction_Check(object.ptr()) == 0) return;
  PyMethodDef* const definition = reinterpret_cast<PyCFunctionObject*>(object.ptr())->m_ml;
  PyObject* const self = PyCFunction_GET_SELF(object.ptr());
  const std::string name = definition->ml_name, doc = definition->ml_doc == nullptr ? "" : definition->ml_doc;
  if (self == nullptr || names().contains(self) || !doc.starts_with(name + "(")) return;
  names()[self] = owner + name;
  std::free(const_cast<char*>(definition->ml_doc));  // allocated by pybind11, which also frees the new one
  definition->ml_doc = ::strdup(plain(name, doc).c_str());
  if ((definition->ml_flags & METH_FASTCALL) != 0) {
    const auto call = reinterpret_cast<FastCall>(reinterpret_cast<void (*)()>(definition->ml_meth));
    if (fast == nullptr) fast = call;
    if (call == fast) definition->ml_meth = reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(&call_fast));
  } else {
    const auto call = reinterpret_cast<PyCFunctionWithKeywords>(reinterpret_cast<void (*)()>(definition->ml_meth));
    if (slow == nullptr) slow = call;
    if (call == slow) definition->ml_meth = reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(&call_slow));
  }
}

}  // namespace

namespace {

/// Names the type of the objects to which functions belong, which `help` shows, and which is that of this module alone.
void name_owner(const py::handle& function) {
  PyTypeObject* const type = Py_TYPE(PyCFunction_GET_SELF(function.ptr()));
  if (PyType_HasFeature(type, Py_TPFLAGS_HEAPTYPE) == 0) return;
  const py::handle owner(reinterpret_cast<PyObject*>(type));
  if (!py::str(owner.attr("__name__")).cast<std::string>().starts_with("pybind11_detail_function_record")) return;
  owner.attr("__name__") = "function";
  owner.attr("__qualname__") = "function";
  owner.attr("__module__") = "stickslip";
}

}  // namespace

void make_plain(py::module_& m) {
  for (const auto& [key, thing] : m.attr("__dict__").cast<py::dict>()) {
    if (!py::isinstance<py::type>(thing)) {
      make_function_plain(thing, "");
      if (PyCFunction_Check(thing.ptr()) != 0) name_owner(thing);
      continue;
    }
    const auto name = py::str(key).cast<std::string>();
    if (py::detail::get_type_info(reinterpret_cast<PyTypeObject*>(thing.ptr())) == nullptr) continue;  // an exception
    const auto members = py::dict(thing.attr("__dict__"));
    if (PyInstanceMethod_Check(py::object(members["__init__"]).ptr()) == 0) {  // no constructor is bound
      py::options options;
      options.disable_function_signatures();
      thing.attr("__init__") = py::cpp_function(
          [name](const py::object&, const py::args&, const py::kwargs&) {
            throw py::type_error(name + ": cannot be constructed directly; other functions return it, see help(" +
                                 name + ")");
          },
          py::name("__init__"), py::is_method(thing), "__init__(self, *args, **kwargs)\n--\n\nCannot be called.");
    }
    for (const auto& [member, value] : members) make_function_plain(value, name + ".");
  }
}

}  // namespace stickslip::python

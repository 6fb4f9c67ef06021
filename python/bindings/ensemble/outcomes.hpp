// What runs whose members have outcomes alone, without histories, have in common.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "bindings.hpp"

namespace stickslip::python {

/// Reports progress to Python, and handles Ctrl-C; an exception sets `ended`.
inline std::function<void(std::size_t, std::size_t)> reporting(const py::object& progress, std::atomic<bool>& ended) {
  return [&](std::size_t done, std::size_t all) {
    const py::gil_scoped_acquire held;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (!progress.is_none()) progress(done, all);
    } catch (const py::error_already_set&) {
      ended = true;
      throw;
    }
  };
}

/// The values of a member of each outcome.
template <class Outcome, class T>
std::vector<T> column_of(const std::vector<Outcome>& outcomes, T Outcome::*member) {
  std::vector<T> values;
  values.reserve(outcomes.size());
  for (const Outcome& one : outcomes) values.push_back(one.*member);
  return values;
}

/// The outcomes that failed: (number, message).
template <class Outcome>
py::list failures_of(const std::vector<Outcome>& outcomes) {
  py::list failures;
  for (std::size_t i = 0; i < outcomes.size(); ++i)
    if (!outcomes[i].failure.empty()) failures.append(py::make_tuple(i, outcomes[i].failure));
  return failures;
}

}  // namespace stickslip::python

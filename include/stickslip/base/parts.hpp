// The parts of an object, listed once by their names.
#pragma once
#include "stickslip/base/requirements.hpp"
namespace stickslip {

enum class Listed { always, unless_zero };

/// A part of an object: its name, a data member or a getter, and whether descriptions leave it out while it is zero.
template <class Get>
struct Part {
  constexpr Part(const char* of_part, Get from, Listed when = Listed::always)
      : name(of_part), get(from), listed(when) {}

  const char* name;
  Get get;
  Listed listed;
};

/// A class that lists its parts, in the order of the arguments of its constructor:
///     static constexpr auto parts() { return std::tuple(Part{"slow", &VelocityDependent::slow}, ...); }
template <class T>
concept WithParts = requires {
  T::parts();
};

}  // namespace stickslip

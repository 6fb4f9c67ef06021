// What structures do where the ground falls away from under them.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>

#include "bindings.hpp"

namespace stickslip::python {

/// The argument `contact` of a function of many sliders; structures are always clipped.
/// @param name  as given; nullopt is the default
inline Contact contact_of(const std::optional<std::string>& name, const std::string& owner, bool structures) {
  const Contact contact = name ? contact_of(*name, owner) : structures ? Contact::clipped : Contact::flight;
  if (structures && contact == Contact::flight)
    throw std::invalid_argument(
        owner + ": structures do not leave the ground: contact must be 'clipped' or left out, got 'flight'");
  return contact;
}

}  // namespace stickslip::python

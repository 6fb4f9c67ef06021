// What the members of an ensemble depend on.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "stickslip/detail/requirements.hpp"

namespace stickslip {

/// What the members of an ensemble depend on: names, and values as JSON.
using EnsembleConfiguration = std::vector<std::pair<std::string, std::string>>;

}  // namespace stickslip

// The configuration of an ensemble.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "stickslip/base/requirements.hpp"

namespace stickslip {

/// Everything that the members of an ensemble depend on: names, and values as JSON.
using EnsembleConfiguration = std::vector<std::pair<std::string, std::string>>;

}  // namespace stickslip

// The response of a slider to a ground motion.
#pragma once

#include "stickslip/run/response.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip {

using Event = EventAt<double>;
/// The motion of a slider on one axis under one ground motion.
using Response = ResponseOf<double, State>;
/// Its motion at the samples of the ground motion.
using Histories = HistoriesOf<double>;

}  // namespace stickslip

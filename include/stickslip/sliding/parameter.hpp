// The parameters with respect to which a response can be differentiated.
#pragma once

#include "stickslip/base/requirements.hpp"

namespace stickslip {

/// The parameter with respect to which a response is differentiated.
enum class Parameter {
  slip_level,         ///< the levels of sliding and rest, forward and backward alike [m/s^2]
  kinetic,            ///< the levels of sliding alone [m/s^2]
  static_level,       ///< the levels at rest alone, if above those of sliding [m/s^2]
  natural_frequency,  ///< wn [rad/s]
  damping,            ///< c [1/s]
  slope,              ///< of the ground [degrees]
  scale,              ///< a factor on all components of the ground motion, 1 here
  radius,             ///< of a surface of a MultiPendulum, or of all alike [m]
  mu,                 ///< the coefficient of friction of a surface of a MultiPendulum, or of all alike
  capacity            ///< of a surface of a MultiPendulum, or of all alike [m]
};

}  // namespace stickslip

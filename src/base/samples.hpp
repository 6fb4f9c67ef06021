// Whether a run keeps the motion at the samples.
#pragma once

namespace stickslip::detail {

/// Outcomes of many runs need no samples, nor those up to the rest after a ground motion.
enum class Samples : bool { dropped, kept };

}  // namespace stickslip::detail

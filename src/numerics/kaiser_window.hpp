#pragma once

#include <cstddef>
#include <vector>

namespace stickslip::detail {

/// The Kaiser-Bessel window of velocity spectra, thesis (4.62), with a mean square of one.
/// @param samples  at least 1
/// @param beta     time-bandwidth product
std::vector<double> kaiser_window(std::size_t samples, double beta = 8);

}  // namespace stickslip::detail

// Measured errors and ranges of the linearization theories, as sentences. `remark` gives them; docstrings, headers and
// pages repeat them word for word, which tests/python/test_linearization_ranges.py checks. The tables behind them are
// those of docs/measure_linearization.py.
#pragma once

namespace stickslip::detail {

/// z of thesis (3.30) between these: the caster is breaking loose.
inline constexpr double caster_loose_z = 0.01, caster_held_z = 5;
/// gamma above which the error is below 30 %.
inline constexpr double caster_gamma = 0.05;
inline constexpr char caster_range[] =
    "while a caster breaks loose, for z of (3.30) from 5 to 0.01, its displacement variance is too low by a factor "
    "that grows as gamma falls: at most 1.4 at gamma = 0.03, 3 at 0.01, 10 at 0.005, 40 at 0.003, 2000 at 0.001";

/// Equal levels, white noise, without a spring.
inline constexpr char laplace_white_range[] =
    "under white noise the stationary velocity variance is exact, the growth of the displacement variance 20 % low for "
    "equal levels, 23 % for 1 to 1.3, 34 % for 1 to 2";
/// From this ratio of levels on.
inline constexpr double laplace_unequal = 1.25;
inline constexpr char laplace_unequal_range[] =
    "for levels that differ the displacement variance is too low without a spring: by up to 25 % for levels 1 to 1.5, "
    "35 % for 1 to 2, 50 % for 1 to 3, 65 % for sliding one way only";

/// Fraction of the variance of the ground acceleration below the natural frequency of the spring.
inline constexpr double quasi_static_fraction = 0.25;
/// Damping ratio of the soil above which the velocity is less accurate, and the largest one measured.
inline constexpr double damped_soil = 0.9, most_damped_soil = 1.5;
inline constexpr char stationary_range[] =
    "without a spring, or on one whose natural frequency exceeds those of at most a quarter of the variance of the "
    "ground acceleration, the standard deviation of the velocity is right within 16 % from sigma_n / a = 1.2 on, "
    "within 21 % under Kanai-Tajimi noise with a damping ratio above 0.9; on a stiffer spring it is too low, down to "
    "0.5 of the simulated one at 1.2 and 0.8 at 3";

}  // namespace stickslip::detail

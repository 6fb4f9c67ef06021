// Numbers computed apart from this library; see the note at each table.
#pragma once

namespace reference {

/// Pair coefficients of the symmetric rectangular pulse, Gaussian amplitudes, in units of the slip level and the half
/// width: by a 96-point midpoint rule on +-6 sigma in both amplitudes, four digits.
struct PairRow {
  double sigma;
  double c1, c2, c2_1, c2_2;      // of the growth rate; c2(1), c2(2) on lattices of whole and half steps
  double c1v, c2v, c2v_1, c2v_2;  // of the velocity variance
};
inline constexpr PairRow pair_rows[] = {
    {1.0 / 3, 2.164e-7, 3.892e-4, 6.489e-4, 4.461e-4, 2.995e-5, 8.586e-4, 1.253e-3, 9.241e-4},
    {0.5, 4.360e-5, 6.987e-3, 1.048e-2, 7.762e-3, 1.894e-3, 1.340e-2, 1.750e-2, 1.414e-2},
    {1, .010676, .13494, .18511, .14459, .096343, .20262, .2298, .20779},
    {2, .34206, .68411, .8491, .72297, 1.0462, 1.0885, 1.1487, 1.1037}};

/// Event-exact simulations by an independent program, 100,000 records each: values.json mc.poisson.*; growth rate and
/// velocity variance in units of the slip level and the half width, with their standard errors.
struct ChainRun {
  double sigma, rate;
  double growth, growth_error, velocity_variance, velocity_variance_error;
};
inline constexpr ChainRun chain_runs[] = {
    {1, 1, 0.09815648135079194, 0.0007086068946165036, 0.25194795507743145, 0.0002103388245854761},
    {5, 0.5, 3.531026169631181, 0.025309436674973602, 6.536836261826456, 0.0032938288588152294}};

}  // namespace reference

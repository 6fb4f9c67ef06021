// Independent values for Coulomb friction under white noise, from rest, slip level 1 and S0 = 1: values.json
// white.coulomb.*.
#pragma once

namespace reference {

/// From the closed transition density, in 30 digits.
struct WhiteVelocity {
  double time, square, absolute, fourth;
};
inline constexpr WhiteVelocity white_velocities[] = {
    {0.1, 0.5488569914342067, 0.5841318389293515, 0.9537633026461162},
    {20.0, 18.56835299523263, 3.074383272702323, 1899.9338891595235},
    {50.0, 19.689263563130744, 3.1391214852543445, 2311.414813632788},
};

/// By partial differential equations for the moments, to the relative `error`.
struct WhiteDisplacement {
  double time, q11, q12, q22, error;
};
inline constexpr WhiteDisplacement white_displacements[] = {
    {0.1, 0.0018439162798114658, 0.02704895939562547, 0.5488569914342067, 0.0006},
    {1, 1.3828416636690142, 1.9257501688393974, 4.074316449355364, 2e-05},
    {5, 99.70207429141037, 24.79237318000336, 11.793722129490328, 7.3e-06},
    {20, 2214.2015142977025, 106.78065727805314, 18.56835299523263, 4e-06},
    {100, 25748.560176186093, 154.93710901578476, 19.738760951284107, 3.4e-06},
};

}  // namespace reference

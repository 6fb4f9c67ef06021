// Solution of the covariance equations of equivalent linearization.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "stickslip/theory/equivalent_linearization.hpp"

namespace stickslip::detail {

struct Covariance {
  double q11, q12, q22;
};

struct CovarianceSolution {
  std::vector<Covariance> covariance;  ///< by time
  long steps = 0, evaluations = 0;
};

/// Rejects a law that does not support the requested start.
void check_start(const LinearizedLaw& law, double s0, theory::EquivalentLinearization::Start start);

CovarianceSolution solve_covariance(const LinearizedLaw& law, double natural_frequency, double s0,
                                    std::span<const double> times,
                                    const theory::EquivalentLinearization::Options& options,
                                    const std::function<void()>& progress = {});

/// Without friction: (3.41) to (3.43), and with a spring.
Covariance frictionless_covariance(double natural_frequency, double s0, double time);

}  // namespace stickslip::detail

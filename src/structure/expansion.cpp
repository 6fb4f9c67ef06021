#include "structure/expansion.hpp"

#include <complex>
#include <stdexcept>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "base/digits.hpp"
#include "stickslip/structure/sliding_structure.hpp"

namespace stickslip::detail {
namespace {

using Bernstein = Polynomial;

// Searches [left, left + width], on which b are the Bernstein coefficients of the polynomial c.
double search(const double* c, int degree, Bernstein& b, double left, double width, double least) {
  double bound = 0;
  for (int k = 0; k <= degree; ++k) bound = std::max(bound, std::abs(b[static_cast<std::size_t>(k)]));
  if (bound <= least) return least;
  least = std::max(least, std::max(std::abs(b[0]), std::abs(b[static_cast<std::size_t>(degree)])));
  int changes = 0, last = 0;
  double first = 0;
  for (int k = 1; k <= degree; ++k) {
    const double step = b[static_cast<std::size_t>(k)] - b[static_cast<std::size_t>(k - 1)];
    const int sign = (step > 0) - (step < 0);
    if (sign == 0) continue;
    if (last == 0) first = sign;
    changes += last != 0 && sign != last;
    last = sign;
  }
  if (changes == 0 || bound <= least) return least;
  if (changes == 1) {
    Polynomial slope{};
    for (int k = 1; k <= degree; ++k) slope[static_cast<std::size_t>(k - 1)] = k * c[k];
    const auto f = [&](double u) { return value_at(slope.data(), degree - 1, u); };
    const double right = left + width;
    const double u = numerics::root(f, left, first, right, static_cast<double>(last));
    return std::max(least, std::abs(value_at(c, degree, u)));
  }
  if (width < 0x1p-26) return least;
  Bernstein half;
  for (int i = 0; i <= degree; ++i) {  // de Casteljau: `b` becomes the second half
    half[static_cast<std::size_t>(i)] = b[0];
    for (int k = 0; k < degree - i; ++k)
      b[static_cast<std::size_t>(k)] = (b[static_cast<std::size_t>(k)] + b[static_cast<std::size_t>(k + 1)]) / 2;
  }
  least = search(c, degree, half, left, width / 2, least);
  return search(c, degree, b, left + width / 2, width / 2, least);
}

// The order at which the terms of exp(reach) are below 1e-17.
int order_for(double reach) {
  double term = 1;
  int k = 0;
  while (k < series::highest_order && (k < 4 || term > 1e-17)) term *= reach / ++k;
  return k;
}

}  // namespace

Polynomial bernstein(const double* c, int degree) {
  Polynomial b{};
  double binomial = 1;
  for (int k = 0; k <= degree; ++k) {
    b[static_cast<std::size_t>(k)] = c[k] / binomial;
    binomial *= static_cast<double>(degree - k) / (k + 1);
  }
  for (int i = 1; i <= degree; ++i)
    for (int k = degree; k >= i; --k) b[static_cast<std::size_t>(k)] += b[static_cast<std::size_t>(k - 1)];
  return b;
}

double largest_magnitude(const double* c, int degree, double least) {
  double bound = 0;
  for (int k = 0; k <= degree; ++k) bound += std::abs(c[k]);
  if (bound <= least) return least;
  Bernstein b = bernstein(c, degree);
  return search(c, degree, b, 0, 1, least);
}

double product_integral(const double* a, int degree_a, const double* b, int degree_b) {
  double sum = 0;
  for (int i = 0; i <= degree_a; ++i) {
    double inner = 0;
    for (int k = 0; k <= degree_b; ++k) inner += b[k] / (i + k + 1);
    sum += a[i] * inner;
  }
  return sum;
}

Polynomial Expansion::force(Mode mode) const {
  const double s = static_cast<double>(static_cast<int>(mode));
  Polynomial sum = pull_;
  for (int k = 0; k <= order_; ++k)
    sum[at(k)] += mode == Mode::stuck ? q_[at(k)] : s * friction_[at(k)] + of_.damper * v_[at(k)];
  return sum;
}

double Expansion::friction_work(double s) const {
  if (!std::isnan(dissipating_)) {
    const Polynomial dissipates{dissipating_ * weight_[0], dissipating_ * weight_[1]};
    return s * h_ * product_integral(dissipates.data(), 1, v_.data(), order_);
  }
  int last = order_;
  while (last > 0 && equal(friction_[at(last)], 0)) --last;
  return s * h_ * product_integral(friction_.data(), last, v_.data(), order_);
}

void check_rate(const ModalInterface& of, double step) {
  constexpr double most = SlidingStructure::most_rate_per_step;
  const double product = of.fastest * step;
  if (product <= most) return;
  throw std::invalid_argument(
      "the structure on its sliding interface is too fast for the time step of the ground motion: its fastest rate, " +
      digits(of.fastest) + " rad/s, times " + digits(step) + " s is " + digits(product) + ", more than " +
      shortest(most) +
      "; give the base more mass, make a part that is so stiff or so strongly damped rigid (a slider alone is a rigid "
      "structure), or take a smaller time step");
}

void Expansion::begin(const StructureState& state, const GroundLoad& ground, double left, double h) {
  order_ = order_for(of_.fastest * h);
  const double after = left - h;
  const auto line = [](double from, double to) { return std::array{from, to - from}; };
  n_ = line(ground.ground(left), after > 0 ? ground.ground(after) : ground.end);
  weight_ = line(ground.weight(left), after > 0 ? ground.weight(after) : ground.weight_end);
  x_[0] = state.displacement;
  v_[0] = state.velocity;
  std::copy_n(state.modal_displacement.data(), modes_, y_.data());
  std::copy_n(state.modal_velocity.data(), modes_, rate_.data());
  friction_.fill(0);
}

double Expansion::take_demand(int k, double demand) {
  const double *y = row(y_, k), *rate = row(rate_, k), *stiffness = of_.stiffness.data(), *d = of_.demand.data();
  double sum = 0;
  if (of_.classical) {
    const double* damping = of_.damping.data();
    for (std::size_t j = 0; j < modes_; ++j) {
      force_[j] = stiffness[j] * y[j] + damping[j * (modes_ + 1)] * rate[j];
      sum += d[j] * force_[j];
    }
  } else {
    const auto n = static_cast<Eigen::Index>(modes_);
    Eigen::Map<Eigen::VectorXd> force(force_.data(), n);
    force.noalias() = of_.damping * Eigen::Map<const Eigen::VectorXd>(rate, n);
    for (std::size_t j = 0; j < modes_; ++j) {
      force_[j] += stiffness[j] * y[j];
      sum += d[j] * force_[j];
    }
  }
  demand_force_ = sum;
  const double x = x_[at(k)];
  double pull = of_.spring.stiffness * x;
  if (of_.spring.pendulum) pull = of_.spring.stiffness * (weight_[0] * x + (k > 0 ? weight_[1] * x_[at(k - 1)] : 0));
  pull_[at(k)] = pull;
  q_[at(k)] = k == 0 ? demand : sum - (k == 1 ? of_.ground_demand * n_[1] : 0) - pull;
  return q_[at(k)];
}

void Expansion::next(int k, double acceleration) {
  a_[at(k)] = acceleration;
  const double n = k < 2 ? n_[at(k)] : 0;
  const double *load = of_.load.data(), *reaction = of_.reaction.data(), *jump = of_.jump.data();
  double* out = row(acceleration_, k);
  for (std::size_t j = 0; j < modes_; ++j)
    out[j] = reaction[j] * demand_force_ - force_[j] - load[j] * n - jump[j] * acceleration;
  if (k == order_) return;
  const double step = h_ * series::reciprocal[k + 1];
  v_[at(k + 1)] = step * acceleration;
  x_[at(k + 1)] = step * v_[at(k)];
  const double* rate = row(rate_, k);
  double *next_y = row(y_, k + 1), *next_rate = row(rate_, k + 1);
  for (std::size_t j = 0; j < modes_; ++j) {
    next_rate[j] = step * out[j];
    next_y[j] = step * rate[j];
  }
}

double ModalInterface::force_of_modes(const StructureState& state) const {
  const auto y = view(state.modal_displacement), rate = view(state.modal_velocity);
  const double of_y = demand.dot(stiffness.cwiseProduct(y));
  return of_y + (classical ? demand.dot(damping.diagonal().cwiseProduct(rate)) : demand.dot(damping * rate));
}

double ModalInterface::size_of_force(const StructureState& state) const {
  const auto y = view(state.modal_displacement), rate = view(state.modal_velocity);
  return demand.cwiseAbs().dot(stiffness.cwiseProduct(y).cwiseAbs() + damping.cwiseAbs() * rate.cwiseAbs());
}

std::pair<double, double> energy_of(const ModalInterface& of, const StructureState& state) {
  const double x = state.displacement, v = state.velocity;
  double kinetic = v * v / 2, elastic = of.spring.stiffness * x * x / 2;
  if (!of.driven) {
    const auto rates = view(state.modal_velocity);
    const double moves = of.coupling.dot(rates);
    kinetic += v * moves + of.own * moves * moves / 2 + of.modal_mass * rates.squaredNorm() / 2;
    elastic += of.modal_mass * of.stiffness.dot(view(state.modal_displacement).cwiseAbs2()) / 2;
  }
  return {kinetic, elastic};
}

Eigen::MatrixXd flow_matrix(const ModalInterface& of, bool sliding) {
  const Eigen::Index n = of.modes(), first = sliding ? 2 : 0;
  Eigen::MatrixXd flow = Eigen::MatrixXd::Zero(2 * n + first, 2 * n + first);
  // y'' = (-1 + reaction demand' - jump demand' / mass) r + ..., r = w^2 y + D y'
  Eigen::MatrixXd of_force = of.reaction * of.demand.transpose();
  of_force.diagonal().array() -= 1;
  if (sliding) of_force -= of.jump * of.demand.transpose() / of.mass;
  flow.block(first, first + n, n, n).setIdentity();
  flow.block(first + n, first, n, n) = of_force * of.stiffness.asDiagonal();
  flow.block(first + n, first + n, n, n) = of_force * of.damping;
  if (sliding) {
    flow(0, 1) = 1;
    flow(1, 0) = -of.spring.stiffness / of.mass;
    flow(1, 1) = -of.damper / of.mass;
    flow.block(1, 2, 1, n) = of.demand.transpose() * of.stiffness.asDiagonal() / of.mass;
    flow.block(1, 2 + n, 1, n) = of.demand.transpose() * of.damping / of.mass;
    flow.block(2 + n, 0, n, 1) = of.jump * (of.spring.stiffness / of.mass);
    flow.block(2 + n, 1, n, 1) = of.jump * (of.damper / of.mass);
  }
  return flow;
}

namespace {

// The largest magnitude of an eigenvalue of the flow matrix, by Arnoldi's method: n^2 operations instead of n^3. The
// ends of the spectrum converge first. States are scaled so that energy is the square of their length.
double largest_rate(const ModalInterface& of, bool sliding) {
  using Eigen::Index;
  constexpr Index most = 160;
  const Index n = of.modes(), size = 2 * n + (sliding ? 2 : 0);
  const Eigen::VectorXd frequency = of.stiffness.cwiseSqrt();
  const double least = 1e-3 * std::max(frequency.maxCoeff(), of.damping.diagonal().maxCoeff());
  const Eigen::VectorXd scale = frequency.cwiseMax(least);
  const double pull = of.spring.stiffness, scale_x = std::max(std::sqrt(pull / of.mass), least);
  // (scale y, y', scale_x x, x')
  const auto flow = [&](const Eigen::VectorXd& z) {
    Eigen::VectorXd result(size);
    const auto rate = z.segment(n, n);
    Eigen::VectorXd force = of.stiffness.cwiseProduct(z.head(n).cwiseQuotient(scale));
    if (of.classical)
      force += of.damping.diagonal().cwiseProduct(rate);
    else
      force += of.damping * rate;
    const double demand = of.demand.dot(force);
    result.head(n) = scale.cwiseProduct(rate);
    result.segment(n, n) = demand * of.reaction - force;
    if (sliding) {
      const double v = z[2 * n + 1], acceleration = (demand - of.damper * v - pull * (z[2 * n] / scale_x)) / of.mass;
      result[2 * n] = scale_x * v;
      result[2 * n + 1] = acceleration;
      result.segment(n, n) -= acceleration * of.jump;
    }
    return result;
  };
  Eigen::MatrixXd basis(size, most + 1), hessenberg = Eigen::MatrixXd::Zero(most, most);
  for (Index i = 0; i < size; ++i) basis(i, 0) = 1 + static_cast<double>((7 * i) % 13) / 13;
  basis.col(0).normalize();
  Index used = 0;
  while (used < most) {
    Eigen::VectorXd next = flow(basis.col(used));
    const double before = next.norm();
    for (int pass = 0; pass < 2; ++pass) {
      const Eigen::VectorXd parts = basis.leftCols(used + 1).transpose() * next;
      next -= basis.leftCols(used + 1) * parts;
      hessenberg.col(used).head(used + 1) += parts;
    }
    const double left = next.norm();
    if (++used == most || !(left > 1e-13 * before)) break;
    hessenberg(used, used - 1) = left;
    basis.col(used) = next / left;
  }
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(hessenberg.topLeftCorner(used, used), false);
  if (solver.info() != Eigen::Success || !solver.eigenvalues().allFinite())
    throw ConvergenceError("the eigenvalues of the structure on its sliding interface do not converge");
  return solver.eigenvalues().cwiseAbs().maxCoeff();
}

constexpr Eigen::Index few_modes = 80;  // whose eigenvalues take less time than 160 vectors

}  // namespace

void set_fastest(ModalInterface& of) {
  of.fastest = 0;
  for (const bool sliding : {false, true}) {
    if (of.modes() > few_modes) {
      of.fastest = std::max(of.fastest, largest_rate(of, sliding));
      continue;
    }
    const Eigen::MatrixXd flow = flow_matrix(of, sliding);
    if (flow.rows() == 0) continue;
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(flow, false);
    if (solver.info() != Eigen::Success)
      throw ConvergenceError("the eigenvalues of the structure on its sliding interface do not converge");
    of.fastest = std::max(of.fastest, solver.eigenvalues().cwiseAbs().maxCoeff());
  }
}

StuckBound::StuckBound(const ModalInterface& of) : modes_(of.modes()) {
  using Eigen::Index;
  using Complex = std::complex<double>;
  if (of.classical && (of.reaction.array() == 0).all()) {  // the modes do not feel each other
    for (Index j = 0; j < modes_; ++j) {
      const double square = of.stiffness[j], half = of.damping(j, j) / 2;
      const Complex spread = std::sqrt(Complex(half * half - square));
      const double apart = std::max(std::abs(spread), 1e-8 * half);  // where both roots are one
      const Complex root = std::abs(spread) > 0 ? spread * (apart / std::abs(spread)) : Complex(apart);
      pairs_.push_back({-half + root, -half - root, 2.0 * root, of.demand[j] * square, of.demand[j] * 2 * half});
    }
    return;
  }
  if (modes_ > few_modes) {
    of_many_ = &of;
    return;
  }
  const Eigen::MatrixXd flow = flow_matrix(of, false);
  for (Index i = 0; i < 2 * modes_; ++i)  // a rigid-body mode acts by its velocity only
    if (i >= modes_ || of.stiffness[i] > 0) kept_.push_back(i);
  if (kept_.empty()) return;
  const auto size = static_cast<Index>(kept_.size());
  Eigen::MatrixXd reduced(size, size);
  Eigen::VectorXd row(size);
  for (Index i = 0; i < size; ++i) {
    const Index from = kept_[static_cast<std::size_t>(i)];
    for (Index j = 0; j < size; ++j) reduced(i, j) = flow(from, kept_[static_cast<std::size_t>(j)]);
    row[i] = from < modes_ ? of.demand[from] * of.stiffness[from] : of.demand.dot(of.damping.col(from - modes_));
  }
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(reduced);
  left_ = solver.eigenvectors().fullPivLu().inverse();
  rates_ = solver.eigenvalues().real();
  weights_ = (row.cast<std::complex<double>>().transpose() * solver.eigenvectors()).cwiseAbs().transpose();
}

// With the mass matrix M = 1 + mass shape shape', the rates z = y' follow M z'' + D z' + w^2 z = 0, as y does. The demand
// is -shape.z' (-demand.z' where the modes do not feel the slider, M = 1), and z'.M z' is at most twice the energy.
double StuckBound::by_energy(const StructureState& now) const {
  const ModalInterface& of = *of_many_;
  const auto y = view(now.modal_displacement), rate = view(now.modal_velocity);
  Eigen::VectorXd force = of.stiffness.cwiseProduct(y);
  if (of.classical)
    force += of.damping.diagonal().cwiseProduct(rate);
  else
    force.noalias() += of.damping * rate;
  const double demand = of.demand.dot(force);
  const double twice = force.dot(force - demand * of.reaction) + of.stiffness.dot(rate.cwiseAbs2());
  const double length = of.demand.squaredNorm() / (1 - of.demand.dot(of.reaction));
  return std::sqrt(std::max(twice, 0.0) * length);
}

double StuckBound::after(const StructureState& now, double time) const {
  if (of_many_) return time > 0 ? 0 : by_energy(now);
  if (!pairs_.empty()) {
    double sum = 0;
    for (std::size_t j = 0; j < pairs_.size(); ++j) {
      const auto& [first, second, apart, of_place, of_rate] = pairs_[j];
      const double y = of_place == 0 ? 0 : now.modal_displacement[j], rate = now.modal_velocity[j];
      const auto part = [&](std::complex<double> amplitude, std::complex<double> root) {
        return std::abs(of_place + of_rate * root) * std::abs(amplitude / apart) * std::exp(root.real() * time);
      };
      // A rigid-body mode acts by its velocity only.
      sum += of_place == 0 ? std::abs(of_rate * rate) * std::exp(second.real() * time)
                           : part(rate - second * y, first) + part(first * y - rate, second);
    }
    return sum;
  }
  if (kept_.empty()) return 0;
  Eigen::VectorXcd state(static_cast<Eigen::Index>(kept_.size()));
  for (std::size_t i = 0; i < kept_.size(); ++i)
    state[static_cast<Eigen::Index>(i)] =
        kept_[i] < modes_ ? view(now.modal_displacement)[kept_[i]] : view(now.modal_velocity)[kept_[i] - modes_];
  return (left_ * state).cwiseAbs().dot(weights_.cwiseProduct((rates_ * time).array().exp().matrix()));
}

}  // namespace stickslip::detail

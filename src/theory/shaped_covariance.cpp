#include "theory/shaped_covariance.hpp"

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "numerics/ode.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/numerics/root.hpp"
#include "structure/modal_interface.hpp"
#include "theory/linear_friction.hpp"
#include "theory/theory_moments.hpp"

namespace stickslip::detail {
namespace {

using std::numbers::pi;

const std::string noun = "EquivalentLinearization";
constexpr double infinity = std::numeric_limits<double>::infinity();

// x, x', the modes of a structure and their rates, and the states of the filter. Their room is in the object.
constexpr int max_states = 18 + 2 * ShapedProblem::most_modes;
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, max_states, max_states>;
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, max_states, 1>;
using ComplexMatrix =
    Eigen::Matrix<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, max_states, max_states>;
using ComplexVector = Eigen::Matrix<std::complex<double>, Eigen::Dynamic, 1, Eigen::ColMajor, max_states, 1>;
constexpr int x = 0, v = 1;

double squared(double value) { return value * value; }

/// Q of A Q + Q A^T + W = 0, by the Schur form of A, for a stable A (Bartels and Stewart).
Matrix lyapunov(const Matrix& a, const Matrix& w) {
  const Eigen::ComplexSchur<Matrix> schur(a);
  const ComplexMatrix &t = schur.matrixT(), &u = schur.matrixU();
  const ComplexMatrix right = u.adjoint() * w * u;
  const Eigen::Index n = a.rows();
  ComplexMatrix y = ComplexMatrix::Zero(n, n);
  for (Eigen::Index j = n - 1; j >= 0; --j) {
    ComplexVector column = -right.col(j);
    for (Eigen::Index k = j + 1; k < n; ++k) column -= std::conj(t(j, k)) * y.col(k);
    ComplexMatrix shifted = t;
    shifted.diagonal().array() += std::conj(t(j, j));
    y.col(j) = shifted.triangularView<Eigen::Upper>().solve(column);
  }
  const Matrix q = (u * y * u.adjoint()).real();
  return (q + q.transpose()) / 2;
}

/// The linear part of z' = A z + b w, z = (x, x', filter), without friction. With a structure, z = (x, x', y, y',
/// filter).
struct System {
  Eigen::Index f = 2;       // first state of the filter
  Matrix a;                 // with an acceleration of the filter of gain 1
  Vector b;                 // of the white noise, with a gain of 1
  Vector resist;            // what a force of friction takes from each rate, per unit of the reference mass
  double mass = 1;          // that resists a force at the interface, per unit of the reference mass
  double intensity;         // 2 pi S0
  Matrix filter;            // stationary covariance of the filter's states
  Vector output;            // acceleration of the filter, of its states and
  double direct = 1;        // of the white noise
  double acceleration_std;  // of the ground [m/s^2]; infinite for white noise
  double time_scale;        // of the filter, by the geometric mean of its poles [s]; infinite without one

  explicit System(const ShapedProblem& problem) {
    const auto& sections = problem.filter.sections();
    if (problem.structure) f += 2 * problem.structure->modes();
    const Eigen::Index n = f + problem.filter.order();
    a = Matrix::Zero(n, n);
    b = Vector::Zero(n);
    // The signal between sections is out . z + direct w.
    Vector out = Vector::Zero(n);
    double log_rate = 0;
    for (std::size_t i = 0; i < sections.size(); ++i) {
      const auto& s = sections[i];
      const Eigen::Index at = f + 2 * static_cast<Eigen::Index>(i);
      a(at, at + 1) = 1;
      a.row(at + 1) = out.transpose();
      b(at + 1) = direct;
      a(at + 1, at) -= s.d0;
      a(at + 1, at + 1) -= s.d1;
      out *= s.b2;
      out(at) += s.b0 - s.b2 * s.d0;
      out(at + 1) += s.b1 - s.b2 * s.d1;
      direct *= s.b2;
      log_rate += std::log(s.d0) / 2 / static_cast<double>(sections.size());
    }
    intensity = 2 * pi * problem.filter.s0();
    const Matrix inner = a.bottomRightCorner(n - f, n - f);
    const Vector source = b.tail(n - f);
    filter = n > f ? lyapunov(inner, intensity * source * source.transpose()) : Matrix::Zero(0, 0);
    acceleration_std = direct != 0 ? infinity : std::sqrt(out.tail(n - f).dot(filter * out.tail(n - f)));
    time_scale = sections.empty() ? infinity : std::exp(-log_rate);
    output = out.tail(n - f);
    // What the ground acceleration adds to each rate.
    Vector ground = Vector::Zero(f);
    resist = Vector::Zero(f);
    if (problem.structure) {
      const ModalInterface& of = *problem.structure;
      const Eigen::Index modes = of.modes();
      mass = of.mass;
      a.topLeftCorner(f, f) = flow_matrix(of, true);
      ground(v) = -of.ground_demand / mass;
      resist(v) = 1 / mass;
      ground.tail(modes) = -of.load - of.jump * ground(v);
      resist.tail(modes) = -of.jump / mass;
    } else {
      a(x, v) = 1;
      a(v, x) = -squared(problem.natural_frequency);
      a(v, v) = -problem.damping;
      ground(v) = -1;
      resist(v) = 1;
    }
    a.topRightCorner(f, n - f) = ground * output.transpose();
    b.head(f) = ground * direct;
  }

  /// The linear equivalent of friction, -F = a21 x + a22 x', as a change of A.
  void add_friction(double a21, double a22, Matrix& to) const {
    to.col(x).head(f) += a21 * resist;
    to.col(v).head(f) += a22 * resist;
  }

  Eigen::Index size() const { return a.rows(); }
};

/// The first columns of the lower triangle of a symmetric matrix as a row of numbers.
Eigen::Index packed_size(Eigen::Index n, Eigen::Index columns) { return columns * (2 * n - columns + 1) / 2; }

void pack(const Matrix& q, Eigen::Index columns, double* to) {
  for (Eigen::Index j = 0; j < columns; ++j)
    for (Eigen::Index i = j; i < q.rows(); ++i) *to++ = q(i, j);
}

void unpack(const double* from, Eigen::Index columns, Matrix& q) {
  for (Eigen::Index j = 0; j < columns; ++j)
    for (Eigen::Index i = j; i < q.rows(); ++i) q(i, j) = q(j, i) = *from++;
}

/// Q' = A Q + (A Q)^T + 2 pi S0 b b^T, thesis (3.9), and the means if friction has one. The envelope multiplies the
/// input or the output of the filter.
class Equations {
 public:
  Equations(const System& system, const AverageFriction& friction, const theory::ShapedNoise& noise, double floor,
            Eigen::Index columns)
      : system_(system),
        friction_(friction),
        noise_(noise),
        floor_(floor),
        columns_(columns),
        q_(Matrix::Zero(system.size(), system.size())),
        product_(q_) {
    q_.bottomRightCorner(system.size() - system.f, system.size() - system.f) = system.filter;
    for (Eigen::Index i = 0; i < q_.rows(); ++i)
      for (Eigen::Index k = 0; k < q_.cols(); ++k)
        if (system.a(i, k) != 0) entries_.push_back({i, k, system.a(i, k)});
  }

  void operator()(double t, std::span<const double> y, std::span<double> slope) {
    unpack(y.data(), columns_, q_);
    const auto [out, in] = factors(t);
    product_.setZero();
    for (const Entry& entry : entries_)
      add(entry.row, entry.column,
          entry.row < system_.f && entry.column >= system_.f ? out * entry.value : entry.value);

    const bool drifts = friction_.drifts();
    const double* const mean = y.data() + packed_size(q_.rows(), columns_);
    if (!friction_.none()) {
      // Where nothing moves, friction is a damper so stiff that creep is negligible.
      const double q11 = std::max(q_(x, x), 0.0), q22 = std::max(q_(v, v), 0.0) + floor_ * floor_;
      const MeanFriction average = friction_(drifts ? mean[1] : 0, q11, q_(x, v), q22);
      if (drifts) {
        using Means = Eigen::VectorXd;
        const Eigen::Index f = system_.f;
        Eigen::Map<Means>(slope.data() + packed_size(q_.rows(), columns_), f) =
            system_.a.topLeftCorner(f, f) * Eigen::Map<const Means>(mean, f) - average.mean * system_.resist;
      }
      for (Eigen::Index i = 0; i < system_.f; ++i) {
        const double gain = system_.resist(i);
        if (gain == 0) continue;
        add(i, x, gain * average.a21);
        add(i, v, gain * average.a22);
      }
    }
    const auto enters = [&, out = out, in = in](Eigen::Index i) {
      return (i < system_.f ? out : 1) * in * system_.b(i);
    };
    double* to = slope.data();
    for (Eigen::Index j = 0; j < columns_; ++j) {
      const double source = system_.intensity * enters(j);
      for (Eigen::Index i = j; i < q_.cols(); ++i)
        *to++ = product_(i, j) + product_(j, i) + (source != 0 ? source * enters(i) : 0);
    }
  }

  /// Rms values in the state y at time t [m/s^2], infinite under white noise.
  struct Drive {
    double ground;  ///< of the ground acceleration, or of the demand on the interface of a structure without its spring
    double force;   ///< of it and the spring together
    double held;    ///< of that below which linearized friction holds the slider
  };
  Drive drive(double t, std::span<const double> y) {
    unpack(y.data(), columns_, q_);
    const bool spring = system_.a(v, x) != 0;
    const double held = friction_.drifts() ? friction_.threshold(spring)
                                           : -friction_(0, std::max(q_(x, x), 0.0), 0, floor_ * floor_).a22 * floor_;
    if (system_.b(v) != 0) return {infinity, infinity, held};
    Vector row = system_.mass * system_.a.row(v).transpose();
    row.tail(row.size() - system_.f) *= factors(t).out;
    row(x) = row(v) = 0;
    const double ground = row.dot(q_ * row);
    row(x) = system_.mass * system_.a(v, x);
    return {std::sqrt(std::max(ground, 0.0)), std::sqrt(std::max(row.dot(q_ * row), 0.0)), held};
  }

 private:
  struct Entry {
    Eigen::Index row, column;
    double value;
  };

  /// By which the envelope multiplies the filter's output and input.
  struct Factors {
    double out, in;
  };
  Factors factors(double t) const {
    if (!noise_.envelope()) return {1, 1};
    const double factor = (*noise_.envelope())(t);
    return noise_.envelope_at_source() ? Factors{1, factor} : Factors{factor, 1};
  }

  /// One entry of A times its row of Q, as far as it is asked for: all of the first rows, whose columns change, and the
  /// first columns of the others. Column i of the product's matrix is row i of A Q.
  void add(Eigen::Index i, Eigen::Index k, double value) {
    const double* const from = q_.col(k).data();
    double* const to = product_.col(i).data();
    for (Eigen::Index j = 0, end = i < columns_ ? q_.cols() : columns_; j < end; ++j) to[j] += value * from[j];
  }

  const System& system_;
  const AverageFriction& friction_;
  const theory::ShapedNoise& noise_;
  double floor_;
  Eigen::Index columns_;        // that change: not those of the filter where its own covariance is stationary
  std::vector<Entry> entries_;  // of A that are not 0: few, for the filter is a chain of companion matrices
  Matrix q_, product_;
};

/// Times at which the envelope jumps or bends sharply, and its largest factor.
struct Course {
  std::vector<double> breaks;
  double largest = 1;
};

Course course(const std::optional<Envelope>& envelope) {
  if (!envelope) return {};
  if (!envelope->time().empty())
    return {{envelope->time().front(), envelope->time().back()}, *std::ranges::max_element(envelope->factor())};
  return {{envelope->build_up(), envelope->build_up() + envelope->strong_duration()}, 1};
}

/// An upper bound of the rms velocity without friction; times the time, of the rms displacement.
double frictionless_velocity(const System& system, double time) {
  return std::isinf(system.acceleration_std) ? std::sqrt(system.intensity * time) : system.acceleration_std * time;
}

/// The stationary rms of the force on a stuck interface without its spring, per unit of the reference mass: that of the
/// ground acceleration for a slider; infinite for a structure with undamped modes.
double stuck_demand(const ShapedProblem& problem, const System& system) {
  if (!problem.structure || system.b(v) != 0) return system.acceleration_std;
  const ModalInterface& of = *problem.structure;
  const Eigen::Index modes = of.modes(), filter = system.size() - system.f, n = 2 * modes + filter;
  Matrix a = Matrix::Zero(n, n);
  a.topLeftCorner(2 * modes, 2 * modes) = flow_matrix(of, false);
  a.block(modes, 2 * modes, modes, filter) = -of.load * system.output.transpose();
  a.bottomRightCorner(filter, filter) = system.a.bottomRightCorner(filter, filter);
  Vector b = Vector::Zero(n);
  b.segment(modes, modes) = -of.load * system.direct;
  b.tail(filter) = system.b.tail(filter);
  if (!(a.topLeftCorner(2 * modes, 2 * modes).eigenvalues().real().maxCoeff() < 0)) return infinity;
  const Matrix q = lyapunov(a, system.intensity * b * b.transpose());
  Vector row(n);
  row.head(modes) = of.stiffness.cwiseProduct(of.demand);
  row.segment(modes, modes) = of.damping * of.demand;
  row.tail(filter) = -of.ground_demand * system.output;
  return std::sqrt(std::max(row.dot(q * row), 0.0));
}

}  // namespace

double motion_ratio(const ShapedProblem& problem) {
  const System system(problem);
  const AverageFriction friction(problem.law, problem.options.force, 1);
  if (friction.none()) return infinity;
  return course(problem.noise.envelope()).largest * stuck_demand(problem, system) /
         friction.threshold(problem.natural_frequency > 0);
}

ShapedSolution solve_shaped(const ShapedProblem& problem, std::span<const double> times,
                            const std::function<void()>& progress) {
  check_times(noun, times);
  ShapedSolution solution;
  if (times.empty()) return solution;
  const System system(problem);
  const auto& envelope = problem.noise.envelope();
  const bool steady = problem.noise.stationary_start() && !(envelope && problem.noise.envelope_at_source());
  const Eigen::Index f = system.f, n = system.size(), columns = steady ? f : n, packed = packed_size(n, columns);
  const Course changes = course(envelope);
  const double last = times.back(), first = times.front() > 0 ? times.front() : times.size() > 1 ? times[1] : 0;
  solution.state.resize(times.size());
  if (last == 0) return solution;

  const bool white = std::isinf(system.acceleration_std);
  const double frictionless = frictionless_velocity(system, last) * changes.largest;
  const AverageFriction friction(problem.law, problem.options.force, 10 * frictionless * last);

  // Scales of velocity and displacement, far below which they are negligible.
  const double early = std::min(first, system.time_scale);
  double velocity = white ? std::sqrt(system.intensity * first) : system.acceleration_std * early;
  if (white && !friction.none()) velocity = std::min(velocity, system.intensity / friction.level());
  velocity *= changes.largest;
  require(std::isfinite(velocity) && velocity > 0 && std::isfinite(frictionless * last),
          noun + ": the moments exceed the range of doubles; the last time", last, "s");
  const double displacement = velocity * (white ? first : early);

  Vector scale(n);
  scale(x) = 0.1 * displacement;
  scale(v) = 0.1 * velocity;
  if (problem.structure) {
    // Relative to the base, as an oscillator under the acceleration of these scales.
    const ModalInterface& of = *problem.structure;
    const double shortest_time = white ? first : early, gain = of.load.cwiseAbs().maxCoeff() / shortest_time;
    for (Eigen::Index j = 0; j < of.modes(); ++j) {
      const double time = std::min(shortest_time, 1 / std::sqrt(of.stiffness[j]));
      scale(v + 1 + j) = scale(v) * gain * time * time;
      scale(v + 1 + of.modes() + j) = scale(v) * gain * time;
    }
  }
  for (Eigen::Index i = f; i < n; ++i) scale(i) = changes.largest * std::sqrt(system.filter(i - f, i - f));
  const double tolerance = problem.options.tolerance / 10;
  // Motion that never comes to rest needs no implicit steps, unless it lasts a thousand times the shortest time scale.
  // Where one level is far higher than the other, the mean velocity adjusts at its rate.
  const double rate = std::max({1 / system.time_scale, problem.damping, problem.natural_frequency,
                                white ? squared(friction.level()) / system.intensity : 0,
                                friction.drifts() ? friction.level() / velocity : 0});
  // The demand on the interface of a structure builds up from a smaller one.
  const bool moves = friction.none() || (!problem.structure && steady && !envelope && motion_ratio(problem) > 1.5);
  const bool stiff = !friction.none() && !(moves && last * rate < 1000);
  // Slopes are cheap: explicit steps of fifth order are the fastest unless the tolerance is so tight that Adams' orders
  // up to 12 need far fewer.
  const OdeMethod method = stiff                               ? OdeMethod::bdf
                           : problem.options.tolerance >= 1e-9 ? OdeMethod::runge_kutta
                                                               : OdeMethod::adams;
  // Below this velocity the solution is that of the regularization, which therefore must not grow with the tolerance.
  // With implicit steps its square must be above the absolute tolerance.
  const double absolute = std::min(tolerance, 1e-11);
  const double floor = (stiff ? std::sqrt(absolute / 10) : 1e-7) * velocity;
  OdeOptions ode{.relative_tolerance = tolerance,
                 .absolute_tolerance = std::vector<double>(static_cast<std::size_t>(packed)),
                 .method = method,
                 .max_steps = 300'000,
                 .progress = progress};
  pack((stiff ? absolute : tolerance) * scale * scale.transpose(), columns, ode.absolute_tolerance.data());

  Matrix start = Matrix::Zero(n, n);
  if (problem.noise.stationary_start())
    start.bottomRightCorner(n - f, n - f) =
        system.filter * (problem.noise.envelope_at_source() && envelope ? squared((*envelope)(0)) : 1);
  std::vector<double> state(static_cast<std::size_t>(packed));
  pack(start, columns, state.data());
  if (friction.drifts()) {
    state.insert(state.end(), static_cast<std::size_t>(f), 0);
    ode.absolute_tolerance.insert(ode.absolute_tolerance.end(), {tolerance * displacement, tolerance * velocity});
    for (Eigen::Index i = v + 1; i < f; ++i) ode.absolute_tolerance.push_back(10 * tolerance * scale(i));
  }

  Equations equations(system, friction, problem.noise, floor, columns);
  const auto keep = [&](std::size_t i, std::span<const double> y) {
    ShapedState& kept = solution.state[i];
    kept.q11 = std::max(y[0], 0.0);
    kept.q12 = y[1];
    kept.q22 = std::max(y[static_cast<std::size_t>(n)], 0.0);
    if (friction.drifts()) {
      kept.displacement_mean = y[static_cast<std::size_t>(packed)];
      kept.velocity_mean = y[static_cast<std::size_t>(packed) + 1];
    }
    const Equations::Drive drive = equations.drive(times[i], y.first(static_cast<std::size_t>(packed)));
    kept.motion_ratio = drive.held > 0 ? drive.ground / drive.held : infinity;
    // Where friction holds, what is left is the creep of the regularization, floor r / sqrt(1 - r^2).
    const double r = drive.force / drive.held, creep = floor * std::max(10.0, 2 / std::sqrt((1 - r) * (1 + r)));
    if (r < 1 && kept.q22 <= squared(creep)) {
      kept.q22 = kept.q12 = kept.velocity_mean = 0;
      if (kept.q11 <= squared(creep * times[i])) kept.q11 = 0;
    }
    check_range(noun, times[i], kept.q11 + kept.q22);
  };

  // From one break of the envelope to the next.
  std::vector<double> breaks;
  for (const double at : changes.breaks)
    if (at > 0 && at < last) breaks.push_back(at);
  breaks.push_back(last);
  std::ranges::sort(breaks);
  double begin = 0;
  std::size_t next = times.front() == 0 ? 1 : 0;
  for (const double end : breaks) {
    if (!(end > begin)) continue;
    std::vector<double> stops;
    const std::size_t from = next;
    for (; next < times.size() && times[next] <= end; ++next) stops.push_back(times[next]);
    if (stops.empty() || stops.back() < end) stops.push_back(end);
    // A jump belongs to the side that is integrated.
    const double inside = 1e-12 * (end - begin);
    const OdeRightSide right_side = [&](double t, std::span<const double> y, std::span<double> slope) {
      equations(std::clamp(t, begin + inside, end - inside), y, slope);
    };
    try {
      const OdeSolution part = solve_ode(right_side, begin, state, stops, ode);
      solution.steps += part.steps;
      solution.evaluations += part.evaluations;
      for (std::size_t i = from; i < next; ++i) keep(i, part.at(i - from));
      const auto reached = part.at(stops.size() - 1);
      state.assign(reached.begin(), reached.end());
    } catch (const OdeFailure& failure) {
      throw ConvergenceError(noun + ": reached " + shortest(failure.reached) + " s of " + shortest(last) +
                             " s: " + failure.why);
    }
    begin = end;
  }
  return solution;
}

StationaryState solve_stationary(const ShapedProblem& problem) {
  const auto refuse = [](const std::string& why) -> void {
    throw std::invalid_argument(noun + ": no stationary solution: " + why);
  };
  if (problem.noise.envelope()) refuse("the envelope makes the excitation non-stationary");
  const bool spring = problem.natural_frequency > 0;
  const auto* const wheel = std::get_if<Caster>(&problem.law);
  const bool constant =
      std::holds_alternative<Coulomb>(problem.law) || (wheel != nullptr && std::isinf(wheel->reach()));
  if (!spring && !constant) refuse("without a spring the displacement grows, and with it changes the slip level");
  const System system(problem);
  const Eigen::Index n = system.size();
  // With a spring all states; without one, all but the displacement, on which nothing depends.
  const Eigen::Index from = spring ? x : v, m = n - from;
  const Matrix noise = system.intensity * system.b.tail(m) * system.b.tail(m).transpose();
  Matrix a = system.a;
  Matrix q = Matrix::Zero(n, n);
  const auto solve = [&](double a21, double a22) {
    a = system.a;
    system.add_friction(a21, a22, a);
    q.bottomRightCorner(m, m) = lyapunov(a.bottomRightCorner(m, m), noise);
  };

  const double level = AverageFriction(problem.law, problem.options.force, 0).level();
  const double scale = std::isfinite(system.time_scale) ? 1 / system.time_scale : squared(level) / system.intensity;
  if (level > 0) solve(0, -1e-3 * scale);
  const AverageFriction friction(problem.law, problem.options.force, 10 * std::sqrt(q(x, x)));
  if (friction.none() && problem.damping == 0) refuse("without friction and damper nothing takes the energy");

  // The mean velocity at which friction and damper balance, in standard deviations; 0 with a spring.
  const auto drift = [&](double q22) {
    if (!friction.drifts() || spring) return 0.0;
    const double s = std::sqrt(q22);
    const auto force = [&](double z) { return friction(z * s, 0, 0, q22).mean + problem.damping * z * s; };
    double far = 1;
    while (force(-far) * force(far) > 0 && far < 1e6) far *= 2;
    if (!(force(-far) < 0 && force(far) > 0)) refuse("friction in one direction only does not hold the mean velocity");
    return numerics::root(force, -far, force(-far), far, force(far)) * s;
  };

  ShapedState state;
  if (friction.none()) {
    solve(0, 0);
  } else {
    // A given damping -a22 makes one covariance, which requires another damping: ln(required / given) decreases through
    // zero.
    double a21 = 0;
    const auto excess = [&](double log_damping) {
      const double damping = std::exp(log_damping);
      for (int i = 0; i < 100; ++i) {
        solve(a21, -damping);
        const double before = a21;
        a21 = friction(0, q(x, x), 0, q(v, v)).a21;
        if (std::abs(a21 - before) <= 1e-14 * std::abs(a21)) break;
      }
      state.velocity_mean = drift(q(v, v));
      return std::log(-friction(state.velocity_mean, q(x, x), 0, q(v, v)).a22 / damping);
    };
    double low = std::log(scale), high = low, at_low = excess(low), at_high = at_low;
    for (int i = 0; at_low < 0 && i < 40; ++i) {
      low -= 1;
      at_low = excess(low);
    }
    for (int i = 0; at_high > 0 && i < 40; ++i) {
      high += 1;
      at_high = excess(high);
    }
    if (!(at_low >= 0)) refuse("friction does not take up what the noise gives");
    if (!(at_high <= 0)) return {};  // at rest: the acceleration is below the threshold of motion
    excess(at_low == 0 ? low : at_high == 0 ? high : numerics::root(excess, low, at_low, high, at_high, 1e-13));
  }

  StationaryState found{state};
  found.state.q22 = q(v, v);
  if (state.velocity_mean != 0) found.state.displacement_mean = std::copysign(infinity, state.velocity_mean);
  if (spring) {
    found.state.q11 = q(x, x);
    found.state.displacement_mean = -friction(0, q(x, x), 0, q(v, v)).mean / squared(problem.natural_frequency);
    return found;
  }
  // E[x y] of the others: 0 = E[x' y] + E[x y] A^T.
  const Eigen::VectorXd with_x = -Matrix(a.bottomRightCorner(m, m)).lu().solve(Vector(q.col(v).tail(m)));
  found.state.q12 = with_x[0];
  found.growth_rate = 2 * with_x[0];
  if (std::abs(found.state.q12 * a(v, v)) < 1e-9 * q(v, v)) found.growth_rate = found.state.q12 = 0;  // round-off
  found.state.q11 = found.growth_rate > 0 ? infinity : std::numeric_limits<double>::quiet_NaN();
  return found;
}

double late_growth(const ShapedProblem& problem, double last) {
  if (problem.natural_frequency > 0 || last == 0 || std::holds_alternative<Coulomb>(problem.law))
    return solve_stationary(problem).growth_rate;
  const double far = frictionless_velocity(System(problem), last) * last;
  const auto level = far_level(problem.law, far);
  if (!level) return solve_stationary(problem).growth_rate;
  // Friction is a mean of levels: it holds a slider nowhere if the highest one does not.
  double highest = *level;
  if (const auto* const any = std::get_if<std::function<double(double, Direction)>>(&problem.law))
    for (int i = 0; i < 256; ++i)
      highest = std::max(highest, (*any)(i == 255 ? 0 : 10 * far * std::exp2(-i / 4.0), Direction::forward));
  else
    highest = std::get<Caster>(problem.law).slip_level();
  const LinearizedLaw last_law = Coulomb(*level), highest_law = Coulomb(highest);
  const auto with = [&](const LinearizedLaw& law) {
    return ShapedProblem{law, 0, problem.damping, problem.noise, problem.filter, problem.options, problem.structure};
  };
  if (motion_ratio(with(highest_law)) > 1) return solve_stationary(with(last_law)).growth_rate;
  return motion_ratio(problem) <= 1 ? 0 : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace stickslip::detail

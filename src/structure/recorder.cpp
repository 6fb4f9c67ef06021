#include "structure/recorder.hpp"

#include <algorithm>

namespace stickslip::detail {
namespace {

// The integral over [0, 1] of a product of polynomials.
double product_integral(const double* a, int degree_a, const double* b, int degree_b) {
  double sum = 0;
  for (int i = 0; i <= degree_a; ++i) {
    double inner = 0;
    for (int k = 0; k <= degree_b; ++k) inner += b[k] / (i + k + 1);
    sum += a[i] * inner;
  }
  return sum;
}

// Powers of the nodes of a Gauss rule. Squares of velocities are polynomials with the amplitudes of exp(6) at most:
// twelve points integrate them to round-off.
constexpr int points = 12;
const Eigen::MatrixXd& powers() {
  static const Eigen::MatrixXd table = [] {
    Eigen::MatrixXd result(points, series::highest_order + 1);
    for (int i = 0; i < points; ++i) {
      double power = 1;
      for (int k = 0; k <= series::highest_order; ++k) {
        result(i, k) = power;
        power *= numerics::gauss_legendre<points>.nodes[static_cast<std::size_t>(i)];
      }
    }
    return result;
  }();
  return table;
}

}  // namespace

FloorRows::FloorRows(const ModalInterface& of) : floors(of.shapes.rows()), stories(of.floor_mass.rows()) {
  const Eigen::Index n = of.modes();
  forces = Eigen::MatrixXd::Zero(floors + stories + 1, n);
  with_base = with_slider = Eigen::VectorXd::Zero(floors + stories + 1);
  forces.topRows(floors) = of.shapes;
  with_base.head(floors) = of.influence;
  if (stories > 0) {
    Eigen::MatrixXd inertia = of.floor_mass * of.shapes;
    Eigen::VectorXd with = of.floor_mass * of.influence;
    for (Eigen::Index i = stories - 2; i >= 0; --i) {
      inertia.row(i) += inertia.row(i + 1);
      with[i] += with[i + 1];
    }
    forces.middleRows(floors, stories) = inertia;
    with_base.segment(floors, stories) = with;
    with_slider.segment(floors, of.slider_floor + 1).setConstant(of.slider_mass);
  }
  forces.row(floors + stories) = of.base_shear.transpose();
  with_base[floors + stories] = of.base_shear_of_base;
  with_slider[floors + stories] = of.slider_mass;
  // Only where floors move with the base is one above another.
  drifts = (of.influence.array() == 1).all() ? of.shapes : Eigen::MatrixXd(0, n);
  for (Eigen::Index i = drifts.rows() - 1; i > 0; --i) drifts.row(i) -= of.shapes.row(i - 1);
}

StructureRecorder::StructureRecorder(const ModalInterface& of, const FloorRows* rows, bool loops, double from,
                                     std::size_t event_limit, const std::function<void()>& progress,
                                     StructureResponse& response)
    : EventLog(event_limit, {}), Pace(progress), of_(of), response_(response), loops_(loops) {
  response_.peak = std::abs(from);
  response_.margin = std::numeric_limits<double>::infinity();
  if (rows != nullptr) floors_.emplace(of, *rows);
}

void StructureRecorder::event(EventKind kind, double time, const InterfacePlace& place) {
  count_work();
  add(kind, time, place.displacement, place.velocity);
  response_.peak = std::max(response_.peak, std::abs(place.displacement));  // x is monotonic between events
}

void StructureRecorder::follow(const Expansion& motion, Mode mode) {
  count_work();
  add_work(motion, mode);
  if (floors_) floors_->include(motion);
  if (loops_) draw(motion, mode);
}

void StructureRecorder::draw(const Expansion& motion, Mode mode) {
  const int order = motion.order(), parts = mode == Mode::stuck ? 2 : 4;
  const double s = static_cast<double>(static_cast<int>(mode));
  const auto at = [&](const double* c, double u) { return value_at(c, order, u); };
  for (int i = 0; i <= parts; ++i) {
    const double u = static_cast<double>(i) / parts;
    double force = at(motion.pull(), u);
    if (mode == Mode::stuck)
      force += at(motion.demand(), u);
    else
      force += s * at(motion.friction(), u) + of_.damper * at(motion.velocity(), u);
    const InterfacePoint next{std::min(now_ + u * motion.duration(), segment_ends()), at(motion.displacement(), u),
                              force};
    auto& points = response_.loops;
    if (i > 0 || points.empty() || std::abs(points.back().force - force) > 1e-12 * std::abs(force))
      points.push_back(next);
  }
  now_ += motion.duration();
}

void StructureRecorder::add_work(const Expansion& motion, Mode mode) {
  Energy& energy = response_.energy;
  const double h = motion.duration();
  const int order = motion.order();
  const double* v = motion.velocity();
  if (mode != Mode::stuck) {
    const double s = static_cast<double>(static_cast<int>(mode));
    response_.sliding_distance += std::max(motion.distance(s, 1), 0.0);
    response_.time_sliding += h;
    if (const double level = motion.dissipating(); std::isnan(level)) {
      const double* friction = motion.friction();
      int last = order;
      while (last > 0 && equal(friction[last], 0)) --last;
      energy.dissipated += s * h * product_integral(friction, last, v, order);
    } else {
      // The rest of the level is that of springs, of whose force under the weight `elastic` is the energy.
      const auto [weight, gains] = motion.weight();
      const Polynomial dissipates{level * weight, level * gains};
      energy.dissipated += s * h * product_integral(dissipates.data(), 1, v, order);
      Polynomial part{};
      const double* all = motion.level();
      for (int k = 0; k <= order; ++k) {
        const auto at = [&](int i) { return i < 0 ? 0 : all[i] - (i == 0 ? level : 0); };
        part[static_cast<std::size_t>(k)] = (weight - 1) * at(k) + gains * at(k - 1);
      }
      energy.input -= s * h * product_integral(part.data(), order, v, order);
    }
    if (of_.damper > 0) energy.damped += of_.damper * h * product_integral(v, order, v, order);
    if (of_.driven) energy.input += h * product_integral(motion.demand(), order, v, order);
    if (of_.driven || of_.spring.pendulum) {
      // The part of the load that is not the spring's, or the deviation of a pendulum from its spring.
      Polynomial part;
      const double *pull = motion.pull(), *x = motion.displacement();
      for (int k = 0; k <= order; ++k)
        part[static_cast<std::size_t>(k)] =
            (of_.driven ? pull[k] : 0) + (of_.spring.pendulum ? of_.spring.stiffness * x[k] - pull[k] : 0);
      energy.input += h * product_integral(part.data(), order, v, order);
    }
  }
  if (of_.driven) return;
  const auto rates = motion.modal_velocity();
  const auto& n = motion.ground();
  double work = 0;
  for (int k = 0; k <= order; ++k) {
    const double moved = of_.input_base * v[k] + rates.row(k).dot(of_.input);
    work += moved * (n[0] * series::reciprocal[k + 1] + n[1] / (k + 2));
  }
  energy.input -= h * work;
  if (of_.modes() == 0) return;
  const Eigen::MatrixXd at = powers().leftCols(order + 1) * rates;
  const Eigen::MatrixXd damped =
      of_.classical ? Eigen::MatrixXd(at * of_.damping.diagonal().asDiagonal()) : Eigen::MatrixXd(at * of_.damping);
  double power = 0;
  for (int i = 0; i < points; ++i)
    power += numerics::gauss_legendre<points>.weights[static_cast<std::size_t>(i)] * at.row(i).dot(damped.row(i));
  energy.damped += h * of_.modal_mass * power;
}

void FloorMaxima::include(const Expansion& motion) {
  const int order = motion.order();
  const auto accelerations = motion.modal_acceleration(), displacements = motion.modal_displacement();
  Polynomial base;
  double base_bound = 0;
  for (int k = 0; k <= order; ++k) {
    const double value =
        (k < 2 ? motion.ground()[static_cast<std::size_t>(k)] : 0) + (of_.rides ? motion.acceleration()[k] : 0);
    base[static_cast<std::size_t>(k)] = value;
    base_bound += std::abs(value);
  }
  if (base_bound > base_acceleration_) base_acceleration_ = largest_magnitude(base.data(), order, base_acceleration_);
  const double* slider = motion.acceleration();
  double slider_bound = 0;
  for (int k = 0; k <= order; ++k) slider_bound += std::abs(slider[k]);
  const auto examine = [&](const Eigen::MatrixXd& rows, const auto& modes, bool forces, Eigen::VectorXd& peaks) {
    const Eigen::VectorXd most = modes.cwiseAbs().colwise().sum();
    Eigen::VectorXd bounds = rows.cwiseAbs() * most;
    if (forces) bounds += rows_.with_base.cwiseAbs() * base_bound + rows_.with_slider * slider_bound;
    if ((bounds.array() <= peaks.array()).all()) return;
    Eigen::MatrixXd values = modes * rows.transpose();  // one polynomial per column
    if (forces)
      values += Eigen::Map<const Eigen::VectorXd>(base.data(), order + 1) * rows_.with_base.transpose() +
                Eigen::Map<const Eigen::VectorXd>(slider, order + 1) * rows_.with_slider.transpose();
    for (Eigen::Index i = 0; i < rows.rows(); ++i) peaks[i] = largest_magnitude(values.col(i).data(), order, peaks[i]);
  };
  examine(rows_.forces, accelerations, true, forces_);
  examine(rows_.drifts, displacements, false, drifts_);
}

void StructureRecorder::finish(StructureResponse& response) {
  response.events = take();
  if (!floors_) return;
  response.peak_base_acceleration = floors_->base_acceleration();
  response.floors.peak_acceleration = values(floors_->accelerations());
  response.floors.peak_drift = values(floors_->drifts());
  response.floors.peak_shear = values(floors_->shears());
  response.peak_base_shear = floors_->base_shear();
}

}  // namespace stickslip::detail

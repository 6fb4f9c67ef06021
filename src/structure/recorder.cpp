#include "structure/recorder.hpp"

#include <algorithm>

namespace stickslip::detail {
namespace {

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

StructureRecorder::StructureRecorder(const ModalInterface& of, const FloorRows* rows, StructureReader* reader,
                                     double from, std::size_t event_limit, const std::function<void()>& progress,
                                     StructureResponse& response)
    : EventLog(event_limit, {}), Pace(progress), of_(of), response_(response), reader_(reader) {
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
  if (reader_ != nullptr) show(motion, mode);
}

bool StructureRecorder::pass(const LinearMove& move, const StructureState& from, double level) {
  if (floors_) floors_->include(move);
  if (reader_ != nullptr) move.expand(of_, [&](const Expansion& motion) { show(motion, from.mode); });
  count_work();
  if (!balance_) {
    const auto [kinetic, elastic] = energy_of(of_, from);
    balance_ = {kinetic + elastic, response_.energy};
  }
  Energy& energy = response_.energy;
  if (!of_.driven) energy.input -= move.work(of_);
  if (from.mode == Mode::stuck) return true;
  const double distance = std::abs(move.distance());
  response_.sliding_distance += distance;
  response_.time_sliding += move.step().duration();
  energy.dissipated += level * distance;
  return true;
}

void StructureRecorder::balance(const StructureState& state) {
  if (!balance_) return;
  Energy& energy = response_.energy;
  const auto& [before, sums] = *balance_;
  const auto [kinetic, elastic] = energy_of(of_, state);
  const double lost =
      before - (kinetic + elastic) + (energy.input - sums.input) - (energy.dissipated - sums.dissipated);
  if (of_.driven)
    energy.input -= lost;
  else if (of_.damper > 0 || (of_.damping.array() != 0).any())
    energy.damped += lost;
  balance_.reset();
}

void StructureRecorder::show(const Expansion& motion, Mode mode) {
  const double begin = now_;
  now_ += motion.duration();
  reader_->arc(begin, std::min(now_, segment_ends()), motion, mode);
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
    energy.dissipated += motion.friction_work(s);
    if (const double level = motion.dissipating(); !std::isnan(level)) {
      // The rest of the level is that of springs, of whose force under the weight `elastic` is the energy.
      const auto [weight, gains] = motion.weight();
      Polynomial part{};
      const double* all = motion.level();
      for (int k = 0; k <= order; ++k) {
        const auto at = [&](int i) { return i < 0 ? 0 : all[i] - (i == 0 ? level : 0); };
        part[static_cast<std::size_t>(k)] = (weight - 1) * at(k) + gains * at(k - 1);
      }
      energy.input -= s * h * product_integral(part.data(), order, v, order);
    }
    if (of_.damper > 0) energy.damped += motion.damper_work();
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

// Calls `use(i, maximum)` for each of FloorRows::of_state, counted from 1 as LinearMove does, until it returns false.
template <class Use>
void FloorMaxima::each(Use&& use) {
  Eigen::Index i = 0;
  const auto with = [&](double& maximum) { return use(++i, maximum); };
  for (Eigen::VectorXd* maxima : {&forces_, &drifts_})
    if (!std::ranges::all_of(*maxima, with)) return;
  with(base_acceleration_);
}

void FloorMaxima::include(const LinearMove& move) {
  bool known = true;
  each([&](Eigen::Index i, double& maximum) {
    const auto [first, last] = move.ends(i);
    maximum = std::max({maximum, std::abs(first), std::abs(last)});
    known = known && move.remains(i, first, last, -maximum, maximum);
    return true;
  });
  if (!known) open_.push_back(move);
}

void FloorMaxima::finish() {
  for (const LinearMove& move : open_) {
    bool known = true;
    each([&](Eigen::Index i, double& maximum) {
      const auto [first, last] = move.ends(i);
      return known = move.remains(i, first, last, -maximum, maximum);
    });
    if (!known) move.expand(of_, [&](const Expansion& motion) { include(motion); });
  }
  open_.clear();
}

void StructureRecorder::finish(StructureResponse& response) {
  response.events = take();
  if (!floors_) return;
  floors_->finish();
  response.peak_base_acceleration = floors_->base_acceleration();
  response.floors.peak_acceleration = values(floors_->accelerations());
  response.floors.peak_drift = values(floors_->drifts());
  response.floors.peak_shear = values(floors_->shears());
  response.peak_base_shear = floors_->base_shear();
}

}  // namespace stickslip::detail

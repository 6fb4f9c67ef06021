#include "stickslip/structure/sliding_structure.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "stickslip/base/error.hpp"
#include "stickslip/run/detail/run.hpp"
#include "stickslip/run/options.hpp"
#include "stickslip/sliding/detail/run.hpp"
#include "structure/linear_path.hpp"
#include "structure/modal_interface.hpp"
#include "structure/move.hpp"
#include "structure/recorder.hpp"

namespace stickslip {

using Eigen::Index;

struct SlidingStructure::Data {
  AnySlider slider;
  Structure structure;
  detail::ModalInterface modal;
  std::shared_ptr<detail::LinearSteps> steps = std::make_shared<detail::LinearSteps>();
};

namespace {

void check_start(const SlidingStructure& system, const StructureState& state, const char* function) {
  const Mounting& on = mounting_of(system.slider());
  const double first = -on.stops.backward(), last = on.stops.forward();
  if (state.displacement < first || state.displacement > last)
    detail::refuse(std::string(function) + ": displacement must be between the stops, from " + detail::shortest(first) +
                       " to " + detail::shortest(last) + " m",
                   state.displacement, "m");
  if (on.one_way && state.velocity < 0)
    detail::refuse(std::string(function) + ": velocity must not point backward on a one-way slider", state.velocity,
                   "m/s");
}

// Keeps the motion at the samples.
class Histories {
 public:
  Histories(const SlidingStructure& system, StructureResponse& response, std::size_t samples, bool heated)
      : of_(system.modal()), response_(response), heated_(heated) {
    resize(samples);
  }

  template <class Law>
  void keep(std::size_t sample, const Law& law, const StructureState& state, double ground, double weight) {
    if (sample >= response_.displacement.size()) resize(std::max(sample + 1, 2 * response_.displacement.size()));
    count_ = std::max(count_, sample + 1);
    const auto i = static_cast<Index>(sample);
    response_.displacement[sample] = state.displacement;
    response_.velocity[sample] = state.velocity;
    for (Index j = 0; j < of_.modes(); ++j) {
      response_.modal_displacement(i, j) = state.modal_displacement[static_cast<std::size_t>(j)];
      response_.modal_velocity(i, j) = state.modal_velocity[static_cast<std::size_t>(j)];
    }
    const double demand = of_.demand_of(state, ground, weight);
    double acceleration = 0, force = demand;  // stuck: friction is what the bond carries
    Mode mode = state.mode;
    if (mode == Mode::stuck) {  // until now, where a load begins or jumps
      const detail::StuckLevels levels = detail::stuck_levels(of_, law, state, weight);
      if (demand > detail::weigh(weight, levels.forward)) mode = Mode::forward;
      if (-demand > detail::weigh(weight, levels.backward)) mode = Mode::backward;
    }
    if (mode != Mode::stuck) {
      const Direction direction = direction_of(mode);
      const double level = resist(law_at(law, detail::interface_of(state), weight), state.displacement,
                                  std::abs(state.velocity), direction);
      force = of_.damper * state.velocity + sign(direction) * detail::weigh(weight, level);
      acceleration = (demand - force) / of_.mass;
    }
    response_.interface_force[sample] = force + of_.spring.under(weight) * state.displacement;
    if constexpr (HeatedLaw<Law>) response_.temperature[sample] = law.temperature(detail::interface_of(state));
    response_.interface_demand[sample] = demand;
    response_.base_acceleration[sample] = ground + (of_.rides ? acceleration : 0);
    ground_[i] = ground;
    acceleration_[i] = acceleration;
  }

  void finish(const detail::FloorRows* rows) {
    resize(count_);
    if (rows == nullptr) return;
    const auto n = static_cast<Index>(count_);
    Floors& floors = response_.floors;
    floors.displacement = RealMatrix(n, rows->floors);
    floors.drift = RealMatrix(n, rows->drifts.rows());
    floors.acceleration = RealMatrix(n, rows->floors);
    floors.shear = RealMatrix(n, rows->stories);
    if (rows->floors == 0) return;
    // A few samples at a time: what is between remains in the cache.
    constexpr Index most = 64;
    for (Index first = 0; first < n; first += most) {
      const Index some = std::min(most, n - first);
      const auto part = [&](const RealMatrix& of) { return detail::view(of).middleRows(first, some); };
      const auto into = [&](RealMatrix& of) {
        return Eigen::Map<Eigen::MatrixXd>(of.data(), of.rows(), of.cols()).middleRows(first, some);
      };
      const auto y = part(response_.modal_displacement), rate = part(response_.modal_velocity);
      const auto acceleration = acceleration_.segment(first, some);
      Eigen::MatrixXd force = y * of_.stiffness.asDiagonal();
      if (of_.classical)
        force += rate * of_.damping.diagonal().asDiagonal();
      else
        force += rate * of_.damping;  // symmetric
      const Eigen::VectorXd demand = force * of_.demand;
      const Eigen::MatrixXd accelerations = demand * of_.reaction.transpose() - force -
                                            ground_.segment(first, some) * of_.load.transpose() -
                                            acceleration * of_.jump.transpose();
      const Eigen::MatrixXd forces =
          accelerations * rows->forces.transpose() +
          detail::view(response_.base_acceleration).segment(first, some) * rows->with_base.transpose() +
          acceleration * rows->with_slider.transpose();
      into(floors.displacement) = y * of_.shapes.transpose();
      into(floors.drift) = y * rows->drifts.transpose();
      into(floors.acceleration) = forces.leftCols(rows->floors);
      into(floors.shear) = forces.middleCols(rows->floors, rows->stories);
    }
  }

 private:
  void resize(std::size_t samples) {
    const auto size = static_cast<Index>(samples);
    const Index kept = std::min(size, ground_.size());
    response_.displacement.resize(samples);
    response_.velocity.resize(samples);
    if (heated_) response_.temperature.resize(samples);
    for (auto* values : {&response_.base_acceleration, &response_.interface_demand, &response_.interface_force})
      values->resize(samples);
    for (RealMatrix* values : {&response_.modal_displacement, &response_.modal_velocity}) {
      if (values->rows() == size) continue;
      const RealMatrix before = std::exchange(*values, RealMatrix(size, of_.modes()));
      for (Index j = 0; j < of_.modes(); ++j)
        std::copy_n(before.data() + j * before.rows(), kept, values->data() + j * size);
    }
    for (auto* values : {&ground_, &acceleration_}) values->conservativeResize(size);
  }

  const detail::ModalInterface& of_;
  StructureResponse& response_;
  Eigen::VectorXd ground_{}, acceleration_{};
  std::size_t count_ = 0;
  bool heated_;
};

/// A structure under a ground motion, as a run (see RunOfSystem).
template <FrictionLaw Law>
class StructureRun {
 public:
  using State = StructureState;
  using Response = StructureResponse;

  class Recorder final : public detail::StructureRecorder {
   public:
    Recorder(const StructureRun& run, const State& state, Response& response)
        : StructureRecorder(
              run.of_, run.wanted_, run.reader_ != nullptr && run.reader_->reads_arcs() ? run.reader_ : nullptr,
              state.displacement, detail::max_events(run.motion_.segments()), run.options_.progress, response),
          run_(run),
          histories(run.system_, response, run.motion_.samples(), HeatedLaw<Law>) {}

    void keep(std::size_t sample, const State& state, double load, double normal) {
      histories.keep(sample, run_.law_, state, -load, std::max(normal, 0.0) / standard_gravity);
    }
    void finish(Response& response) {
      StructureRecorder::finish(response);
      histories.finish(run_.wanted_);
    }

   private:
    const StructureRun& run_;
    Histories histories;
  };

  StructureRun(const SlidingStructure& system, const Law& law, const GroundMotion& motion,
               const StructureIntegrateOptions& options, detail::StructureReader* reader)
      : system_(system),
        of_(system.modal()),
        law_(law),
        motion_(motion),
        options_(options),
        reader_(reader),
        rows_(of_),
        wanted_(options.floors ? &rows_ : nullptr),
        pieces_(motion, 0),
        expansion_(of_, law, detail::mean_step(motion)),
        path_(system, law, motion, options.floors) {}

  const GroundMotion& motion() const noexcept { return motion_; }
  const StructureIntegrateOptions& options() const noexcept { return options_; }

  State start() const {
    detail::check_start(options_);
    State state = system_.rest();
    state.displacement = options_.displacement;
    state.velocity = options_.velocity;
    state.mode = stickslip::State::at(0, options_.velocity).mode;
    state.sliding_distance = options_.sliding_distance;
    state.heat = options_.heat;
    check_start(system_, state, "integrate");
    if constexpr (MemoryLaw<Law>) detail::remember(detail::with_memory(law_, detail::interface_of(state)), state);
    return state;
  }

  Recorder recorder(const State& state, Response& response) const {
    response.contact = Contact::clipped;
    if (motion_.has_vertical()) response.components = "axis + vertical";
    response.initial_state = state;
    return {*this, state, response};
  }

  void walk(State& state, Recorder& recorder, Response&) const {
    const LoadSegment first = pieces_.segment(0);
    recorder.keep(0, state, first.load_start, first.normal_start);
    detail::walk(
        pieces_, motion_.segments(), Recorder::work_per_report,
        [&](std::size_t i, double begin, double end, const LoadSegment& segment) {
          move(begin, end, segment, state, recorder);
          recorder.keep(i + 1, state, segment.load_end, segment.normal_end);
        },
        [&] { recorder.report_progress(); });
    recorder.balance(state);
  }

  double settle(State& state, Recorder& recorder, Response& response) const {
    std::size_t i = motion_.segments();
    double end = motion_.time(i);
    detail::settle_structure(of_, law_, motion_.last_step(), state, [&](const LoadSegment& calm) {
      const double begin = std::exchange(end, motion_.time(i + 1));
      move(begin, end, calm, state, recorder);
      if (i + 1 < 10 * motion_.samples())
        recorder.keep(i + 1, state, 0, standard_gravity);
      else
        response.truncated = true;
      if (i++ % Recorder::work_per_report == 0) recorder.report_progress();
    });
    recorder.balance(state);
    response.settled = true;
    return end;
  }

  double kinetic(const State& state) const { return detail::energy_of(of_, state).first; }
  double elastic(const State& state) const {
    return detail::energy_of(of_, state).second + detail::elastic(law_, detail::interface_of(state));
  }

  void finish(State&& state, Response& response) const {
    if (!detail::finite(state)) detail::refuse_overflow(response.peak);
    response.residual = state.displacement;
    response.state = detail::interface_of(state);
    response.final_state = std::move(state);
  }

 private:
  void move(double begin, double end, const LoadSegment& segment, State& state, Recorder& recorder) const {
    recorder.begin_segment(begin, end);
    if (reader_ != nullptr) reader_->segment(begin, end, segment, state);
    if (path_.pass(segment, state, recorder)) return;
    recorder.balance(state);
    detail::move_structure(of_, law_, segment, state, expansion_, recorder);
  }

  const SlidingStructure& system_;
  const detail::ModalInterface& of_;
  const Law& law_;
  const GroundMotion& motion_;
  const StructureIntegrateOptions& options_;
  detail::StructureReader* reader_;  // null for none
  detail::FloorRows rows_;
  const detail::FloorRows* wanted_;  // null for none
  detail::LoadPieces pieces_;
  mutable detail::LawExpansion<Law> expansion_;  // room for the steps
  mutable detail::LinearPath<Law> path_;
};

}  // namespace

namespace detail {

bool finite(const StructureState& state) {
  return std::isfinite(state.displacement) && std::isfinite(state.velocity) &&
         view(state.modal_displacement).allFinite() && view(state.modal_velocity).allFinite();
}

void refuse_restless(double step, const StructureState& state, double demand) {
  // A sweep does not bound the demand while the interface slides.
  const std::string loads =
      std::isfinite(demand) ? ", and the structure can still load it with " + shortest(demand) + " m/s^2" : "";
  throw ConvergenceError("integrate: without ground motion the interface does not come to rest within " +
                         std::to_string(most_calm_steps) + " steps of " + shortest(step) +
                         " s; at x = " + shortest(state.displacement) + " m it moves at " + shortest(state.velocity) +
                         " m/s" + loads + "; `integrate` with settle = false ends with the ground motion");
}

}  // namespace detail

SlidingStructure::SlidingStructure(const char* name, AnySlider slider, Structure structure,
                                   detail::ModalInterface modal) {
  detail::with_interface_law(
      slider, [](const auto&) {}, name);
  const Mounting& on = mounting_of(slider);
  if (on.slope_degrees > 0)
    throw std::invalid_argument(std::string(name) + ": must slide on level ground, got a slider on a slope of " +
                                detail::shortest(on.slope_degrees) + " degrees");
  modal.spring = on.spring();
  modal.damper = on.damping;
  modal.stops = on.stops;
  modal.one_way = on.one_way;
  detail::set_fastest(modal);
  data_ = std::make_shared<const Data>(Data{std::move(slider), std::move(structure), std::move(modal)});
}

const Structure& SlidingStructure::structure() const noexcept { return data_->structure; }
const AnySlider& SlidingStructure::slider() const noexcept { return data_->slider; }
double SlidingStructure::interface_mass() const noexcept { return data_->modal.mass; }
double SlidingStructure::fastest() const noexcept { return data_->modal.fastest; }
const detail::ModalInterface& SlidingStructure::modal() const noexcept { return data_->modal; }
detail::LinearSteps& SlidingStructure::steps() const noexcept { return *data_->steps; }

StructureState SlidingStructure::rest() const {
  const std::vector<double> zeros(static_cast<std::size_t>(data_->modal.modes()));
  return {.modal_displacement = zeros, .modal_velocity = zeros};
}

double SlidingStructure::demand(const StructureState& state, double ground, double weight) const {
  return data_->modal.demand_of(state, ground, weight);
}

StructureResponse detail::integrate(const SlidingStructure& system, const GroundMotion& motion,
                                    const StructureIntegrateOptions& options, StructureReader* reader) {
  StructureResponse response;
  with_interface_law(system.slider(), [&](const auto& law) {
    response = integrate_run(StructureRun(system, law, motion, options, reader), {});
  });
  return response;
}

StructureResponse integrate(const SlidingStructure& system, const GroundMotion& motion,
                            const StructureIntegrateOptions& options) {
  return detail::integrate(system, motion, options, nullptr);
}

void advance(const SlidingStructure& system, const LoadSegment& segment, StructureState& state) {
  const auto n = static_cast<std::size_t>(system.modal().modes());
  if (state.modal_displacement.size() != n || state.modal_velocity.size() != n)
    throw std::invalid_argument("advance: the state must have " + std::to_string(n) + " modes, got " +
                                std::to_string(state.modal_displacement.size()) + " displacements and " +
                                std::to_string(state.modal_velocity.size()) + " velocities; begin with `rest`");
  for (const double value : {segment.duration, segment.load_start, segment.load_end, segment.normal_start,
                             segment.normal_end, state.displacement, state.velocity})
    detail::require(std::isfinite(value), "advance: segment and state must be finite", value);
  if (!detail::finite(state)) throw std::invalid_argument("advance: the modes of the state must be finite");
  check_start(system, state, "advance");
  StructureState moved = state;
  detail::NoStructureSink none;
  detail::with_interface_law(system.slider(), [&](const auto& law) {
    detail::LawExpansion expansion(system.modal(), law, segment.duration);
    detail::move_structure(system.modal(), law, segment, moved, expansion, none);
  });
  if (!detail::finite(moved))
    throw std::overflow_error(
        "advance: the motion leaves the range of doubles, from x = " + detail::shortest(state.displacement) +
        " m, x' = " + detail::shortest(state.velocity) + " m/s");
  state = std::move(moved);
}

void advance(const SlidingStructure& system, const Segment& segment, StructureState& state) {
  advance(system, detail::load_segment(segment, 0.0), state);
}

}  // namespace stickslip

#include "structure/linear_step.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/LU>

#include "lanes/matrix_vector.hpp"
#include "stickslip/base/equal.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/series/series.hpp"
#include "stickslip/structure/response.hpp"
#include "structure/expansion.hpp"

namespace stickslip::detail {
namespace {

using Eigen::Index;

// Of the finest chords of all floors: 8 MB.
constexpr Index most_entries = 500'000;

// Chords of a step: few at first. The finest are so short that the fastest mode remains close to them; each is one
// expansion.
constexpr Index few_chords = 8;
Index most_chords(const ModalInterface& of, double step) {
  constexpr double reach = 0.6;
  return few_chords * std::max(Index{1}, static_cast<Index>(std::ceil(of.fastest * step / (reach * few_chords))));
}

// With rows of zeros to a multiple of those that a product takes together.
Eigen::MatrixXd padded(Index rows, Index columns) {
  constexpr auto together = static_cast<Index>(rows_of_matrix_vector);
  return Eigen::MatrixXd::Zero((rows + together - 1) / together * together, columns);
}

void multiply(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& vector, Eigen::VectorXd& result) {
  matrix_vector(matrix.data(), static_cast<std::size_t>(matrix.rows()), static_cast<std::size_t>(matrix.cols()),
                vector.data(), result.data());
}

bool single_modes(const ModalInterface& of, bool sliding) {
  return !sliding && of.classical && (of.reaction.array() == 0).all();
}

}  // namespace

// What a step begins with, under a ground acceleration in a straight line and a constant friction.
struct LinearStep::Source {
  Eigen::VectorXd state;
  double start, end, friction;
};

bool LinearStep::pays(const ModalInterface& of, double step, bool sliding, bool floors, std::size_t steps) {
  if (!std::isfinite(step) || of.modes() > most_modes) return false;
  const double expansions = std::max(1.0, std::ceil(of.fastest * step / 3));
  const double sources = single_modes(of, sliding) ? 5 : 2 * static_cast<double>(of.modes()) + 7;
  const double watched = floors ? static_cast<double>(2 * of.shapes.rows() + of.floor_mass.rows() + 3) : 1;
  // An expansion of a chord takes half as long as one of a step.
  return sources * static_cast<double>(most_chords(of, step)) * (1 + watched / 8) <=
         2 * static_cast<double>(steps) * expansions;
}

LinearStep::LinearStep(const ModalInterface& of, double step, bool sliding, const FloorRows* rows)
    : duration_(step),
      sliding_(sliding),
      modes_(of.modes()),
      states_(2 * modes_ + (sliding ? 2 : 0)),
      drives_(sliding ? 3 : 2),
      parts_(most_chords(of, step)),
      watched_(0) {
  const bool single = single_modes(of, sliding);
  const Index n = modes_, m = states_;
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(m);

  // What is watched, of (state, n, [s F]).
  Eigen::MatrixXd watched = rows ? rows->of_state(of, sliding) : Eigen::MatrixXd(0, m + drives_ - 1);
  watched.conservativeResize(watched.rows() + 1, Eigen::NoChange);
  for (Index i = watched.rows() - 1; i > 0; --i) watched.row(i) = watched.row(i - 1);
  watched.row(0).setZero();
  if (sliding) {
    watched(0, 2 * n + 1) = 1;
  } else {
    watched.row(0).head(n) = of.demand.cwiseProduct(of.stiffness);
    watched.row(0).segment(n, n) = of.damping * of.demand;
    watched(0, m) = -of.ground_demand;
  }
  watched_ = watched.rows();
  ends_ = padded(2 * watched_, size());
  apart_ = padded(watched_, size());
  for (Index i = 0; i < watched_; ++i) {
    std::vector<Chords> levels{{few_chords, padded(few_chords, size()), padded(few_chords, size())}};
    if (parts_ > few_chords && (i == 0 || watched_ * parts_ * size() <= most_entries))
      levels.push_back({parts_, padded(parts_, size()), padded(parts_, size())});
    chords_.push_back(std::move(levels));
  }
  ends_.topLeftCorner(watched_, m + 1) = watched.leftCols(m + 1);
  if (sliding) ends_.col(m + 2).head(watched_) = watched.col(m + 1);

  // Modes at rest under n and s F: r = w^2 y with y'' = 0.
  steady_ = Eigen::MatrixXd::Zero(n, 2);
  if (n > 0) {
    Eigen::MatrixXd of_force = -of.reaction * of.demand.transpose();
    if (sliding) of_force += of.jump * of.demand.transpose() / of.mass;
    of_force.diagonal().array() += 1;
    Eigen::MatrixXd held(n, 2);
    held.col(0) = -of.load;
    held.col(1).setZero();
    if (sliding) {
      held.col(0) += of.jump * (of.ground_demand / of.mass);
      held.col(1) = of.jump / of.mass;
    }
    const Eigen::MatrixXd force = of_force.partialPivLu().solve(held);
    for (Index j = 0; j < n; ++j)
      if (of.stiffness[j] > 0 && force.row(j).allFinite()) steady_.row(j) = force.row(j) / of.stiffness[j];
  }

  Eigen::RowVectorXd moves = Eigen::RowVectorXd::Zero(watched.cols());
  if (of.input.size() == n) moves.head(n) = of.input.transpose();
  if (sliding) moves[2 * n] = of.input_base;
  moved_ = Eigen::VectorXd::Zero(size());
  if (single)
    single_ = Eigen::ArrayXXd::Zero(n, 8);
  else
    map_ = padded(m, size());

  using Parts = std::vector<Eigen::MatrixXd>;
  const auto quantities = [](const Eigen::MatrixXd& of_rows, const Parts& motion) {
    Parts values;
    for (const Eigen::MatrixXd& part : motion) values.push_back(of_rows * part);
    return values;
  };
  // The mean of a quantity beside its start, and its change.
  const auto mean_and_change = [&](const Eigen::RowVectorXd& row, const Parts& motion) {
    double mean = 0, change = 0;
    for (const Eigen::MatrixXd& part : motion) {
      const Eigen::RowVectorXd c = row * part;
      double sum = 0, within = 0;
      for (Index k = c.size() - 1; k > 0; --k) sum += c[k], within += c[k] / static_cast<double>(k + 1);
      mean += (change + within) / static_cast<double>(parts_);
      change += sum;
    }
    return std::pair(mean, change);
  };
  const auto end_of = [](const Parts& motion, Index entry) {
    double sum = 0;
    for (Index k = motion.back().cols() - 1; k >= 0; --k) sum += motion.back()(entry, k);
    return sum;
  };
  const auto fill = [&](Index entry, const Parts& motion, bool departs) {
    for (Index i = 0; i < m; ++i)
      (single ? single_(i % n, 4 * (i / n) + 2 + entry - m) : map_(i, entry)) = end_of(motion, i);
    if (sliding) map_(2 * n, entry) = mean_and_change(Eigen::RowVectorXd::Unit(watched.cols(), 2 * n), motion).second;
    moved_[entry] = mean_and_change(moves, motion).first;
    const Parts values = quantities(watched, motion);
    watch_ends(entry, values);
    if (departs) watch_departures(entry, values);
  };

  if (single) {
    for (const Index first : {Index{0}, n}) {
      Eigen::VectorXd ones = none;
      ones.segment(first, n).setOnes();
      const Parts motion = run(of, {ones, 0, 0, 0});
      for (Index j = 0; j < n; ++j) {
        single_(j, first == 0 ? 0 : 1) = end_of(motion, j);
        single_(j, first == 0 ? 4 : 5) = end_of(motion, n + j);
        Parts alone;
        for (const Eigen::MatrixXd& part : motion) {
          alone.push_back(Eigen::MatrixXd::Zero(part.rows(), part.cols()));
          alone.back().row(j) = part.row(j);
          alone.back().row(n + j) = part.row(n + j);
        }
        moved_[first + j] = mean_and_change(moves, alone).first;
        Parts values;
        for (const Eigen::MatrixXd& part : motion)
          values.push_back(watched.col(j) * part.row(j) + watched.col(n + j) * part.row(n + j));
        watch_ends(first + j, values);
        watch_departures(first + j, values);
      }
    }
  } else {
    for (Index i = 0; i < m; ++i) fill(i, run(of, {Eigen::VectorXd::Unit(m, i), 0, 0, 0}), true);
  }
  fill(m, run(of, {none, 1, 1, 0}), false);
  fill(m + 1, run(of, {none, 0, 1, 0}), true);
  if (sliding) fill(m + 2, run(of, {none, 0, 0, 1}), false);
  // Departures from n and s F are those from the steady motion.
  for (const Index k : {Index{0}, Index{1}}) {
    if (k == 1 && !sliding) break;
    Eigen::VectorXd held = none;
    held.head(n) = steady_.col(k);
    const double ground = k == 0 ? 1 : 0;
    watch_departures(m + 2 * k, quantities(watched, run(of, {held, ground, ground, k == 0 ? 0.0 : 1.0})));
  }
}

// The coefficients of (state, n, [s F]) in each part.
std::vector<Eigen::MatrixXd> LinearStep::run(const ModalInterface& of, const Source& source) const {
  const Index n = modes_, m = states_;
  StructureState state{.modal_displacement = values(source.state.head(n)),
                       .modal_velocity = values(source.state.segment(n, n))};
  if (sliding_) {
    state.displacement = source.state[2 * n];
    state.velocity = source.state[2 * n + 1];
    state.mode = Mode::forward;
  }
  const double parts = static_cast<double>(parts_), h = duration_ / parts;
  const Coulomb law(source.friction);
  Expansion expansion(of, h);
  std::vector<Eigen::MatrixXd> result;
  for (Index p = 0; p < parts_; ++p) {
    const double done = static_cast<double>(p) / parts;
    const double start = source.start + (source.end - source.start) * done;
    const double end = source.start + (source.end - source.start) * (static_cast<double>(p + 1) / parts);
    const double demand =
        of.force_of_modes(state) - of.ground_demand * start - of.spring.stiffness * state.displacement;
    expansion.expand(state, GroundLoad{h, start, end}, h, h, demand, law);
    const int order = expansion.order();
    Eigen::MatrixXd part = Eigen::MatrixXd::Zero(m + drives_ - 1, order + 1);
    part.topRows(n) = expansion.modal_displacement().transpose();
    part.middleRows(n, n) = expansion.modal_velocity().transpose();
    if (sliding_) {
      for (int k = 0; k <= order; ++k) {
        part(2 * n, k) = expansion.displacement()[k];
        part(2 * n + 1, k) = expansion.velocity()[k];
      }
      part(m + 1, 0) = source.friction;
    }
    part(m, 0) = start;
    part(m, 1) = end - start;
    expansion.end(state);
    if (sliding_) {
      state.displacement += expansion.distance(1, 1);
      state.velocity = expansion.speed(1, 1);
    }
    result.push_back(std::move(part));
  }
  return result;
}

void LinearStep::watch_ends(Index entry, const std::vector<Eigen::MatrixXd>& values) {
  for (Index i = 0; i < watched_; ++i) {
    ends_(watched_ + i, entry) = values.back().row(i).sum();
    for (Chords& chords : chords_[static_cast<std::size_t>(i)])
      for (Index c = 0; c < chords.count; ++c)
        chords.ends(c, entry) = values[static_cast<std::size_t>(parts_ / chords.count * (c + 1) - 1)].row(i).sum();
  }
}

void LinearStep::watch_departures(Index entry, const std::vector<Eigen::MatrixXd>& values) {
  std::vector<double> at(static_cast<std::size_t>(parts_ + 1));  // at the ends of the parts
  for (Index i = 0; i < watched_; ++i) {
    at[0] = values[0](i, 0);
    for (std::size_t p = 0; p < values.size(); ++p) at[p + 1] = values[p].row(i).sum();
    for (std::size_t p = 0; p < values.size(); ++p) {
      // The polynomial is within its Bernstein coefficients, and so is its distance from a straight line.
      const int degree = static_cast<int>(values[p].cols()) - 1;
      Polynomial power{};
      for (int k = 0; k <= degree; ++k) power[static_cast<std::size_t>(k)] = values[p](i, k);
      const Polynomial b = bernstein(power.data(), degree);
      const auto extend = [&](double& apart, Index count) {
        const std::size_t each = static_cast<std::size_t>(parts_ / count), first = p / each * each;
        const double from = at[first], to = at[first + each];
        for (int k = 0; k <= degree; ++k) {
          const double u =
              (static_cast<double>(p - first) + static_cast<double>(k) / degree) / static_cast<double>(each);
          apart = std::max(apart, std::abs(b[static_cast<std::size_t>(k)] - (from + u * (to - from))));
        }
      };
      extend(apart_(i, entry), 1);
      for (Chords& chords : chords_[static_cast<std::size_t>(i)])
        extend(chords.apart(static_cast<Index>(p) * chords.count / parts_, entry), chords.count);
    }
  }
}

LinearMove::LinearMove(std::shared_ptr<const LinearStep> step)
    : step_(std::move(step)),
      from_(Eigen::VectorXd::Zero(step_->size())),
      beside_(from_),
      to_(Eigen::VectorXd::Zero(std::max(step_->states(), step_->map_.rows()))),
      ends_(Eigen::VectorXd::Zero(step_->ends_.rows())),
      apart_(Eigen::VectorXd::Zero(step_->apart_.rows())) {}

void LinearMove::begin(const StructureState& state, double n_start, double n_end, double friction) {
  const Index n = step_->modes(), m = step_->states();
  displacement_ = state.displacement;
  double *to = from_.data(), *beside = beside_.data();
  const double *y = state.modal_displacement.data(), *rate = state.modal_velocity.data();
  const double *by_n = step_->steady_.data(), *by_friction = by_n + n;
  for (Index j = 0; j < n; ++j) {
    to[j] = y[j];
    to[n + j] = rate[j];
    beside[j] = std::abs(y[j] - (by_n[j] * n_start + by_friction[j] * friction));
    beside[n + j] = std::abs(rate[j]);
  }
  if (step_->sliding()) {
    to[2 * n] = state.displacement;
    to[2 * n + 1] = state.velocity;
    to[m + 2] = friction;
  }
  to[m] = n_start;
  to[m + 1] = n_end - n_start;
  for (Index i = 2 * n; i < step_->size(); ++i) beside[i] = std::abs(to[i]);
  multiply(step_->ends_, from_, ends_);
  multiply(step_->apart_, beside_, apart_);
}

bool LinearMove::remains(Index quantity, double first, double last, double low, double high) const {
  constexpr double gap = 0x1p-40;
  const auto within = [&](double a, double b, double apart) {
    const double reach = apart + gap * (apart + std::abs(a) + std::abs(b));
    return std::min(a, b) - reach >= low && std::max(a, b) + reach <= high;
  };
  if (!(std::min(first, last) >= low && std::max(first, last) <= high)) return false;
  if (within(first, last, apart_[quantity])) return true;
  for (const LinearStep::Chords& chords : step_->chords_[static_cast<std::size_t>(quantity)]) {
    chord_ends_.resize(chords.count);
    chord_apart_.resize(chords.count);
    multiply(chords.ends, from_, chord_ends_);
    multiply(chords.apart, beside_, chord_apart_);
    double now = first;
    Index c = 0;
    while (c < chords.count && within(now, chord_ends_[c], chord_apart_[c])) now = chord_ends_[c++];
    if (c == chords.count) return true;
    if (!(now >= low && now <= high && chord_ends_[c] >= low && chord_ends_[c] <= high)) return false;
  }
  return false;
}

void LinearMove::expand(const ModalInterface& of, const std::function<void(const Expansion&)>& use) const {
  const Index n = step_->modes(), m = step_->states();
  const double h = step_->duration(), friction = step_->sliding() ? from_[m + 2] : 0;
  StructureState state{.modal_displacement = values(from_.head(n)), .modal_velocity = values(from_.segment(n, n))};
  if (step_->sliding()) {
    state.velocity = from_[2 * n + 1];
    state.mode = state.velocity > 0 ? Mode::forward : Mode::backward;
  }
  state.displacement = displacement_;
  const GroundLoad load{h, from_[m], from_[m] + from_[m + 1]};
  const double s = static_cast<double>(static_cast<int>(state.mode));
  Expansion expansion(of, h);
  for (double left = h; left > 0; left = equal(left, expansion.duration()) ? 0 : left - expansion.duration()) {
    const double demand = of.demand_of(state, load.ground(left), 1);
    expansion.expand(state, load, left, expansion.share(left), demand, Coulomb(std::abs(friction)));
    use(expansion);
    expansion.end(state);
    state.displacement += s * expansion.distance(s, 1);
    if (step_->sliding()) state.velocity = s * expansion.speed(s, 1);
  }
}

void LinearMove::finish() {
  const Index n = step_->modes();
  if (step_->map_.size() == 0) {
    const double *c = step_->single_.data(), *y = from_.data(), *rate = y + n;
    const double first = from_[2 * n], change = from_[2 * n + 1];
    double* to = to_.data();
    for (Index half = 0; half < 2; ++half, c += 4 * n, to += n)
      for (Index j = 0; j < n; ++j)
        to[j] = c[j] * y[j] + c[n + j] * rate[j] + (c[2 * n + j] * first + c[3 * n + j] * change);
    return;
  }
  multiply(step_->map_, from_, to_);
  if (!step_->sliding()) return;
  change_ = to_[2 * n];
  to_[2 * n] += from_[2 * n];
}

double LinearMove::work(const ModalInterface& of) const {
  const Index n = step_->modes(), m = step_->states();
  double moved = of.input.dot(to_.head(n) - from_.head(n));
  if (step_->sliding()) moved += of.input_base * change_;
  // The integral of n times the velocity, by parts.
  return (from_[m] + from_[m + 1]) * moved - from_[m + 1] * step_->moved_.dot(from_);
}

void LinearMove::write(StructureState& state) const {
  const Index n = step_->modes();
  std::copy_n(to_.data(), n, state.modal_displacement.data());
  std::copy_n(to_.data() + n, n, state.modal_velocity.data());
  if (!step_->sliding()) return;
  state.displacement = to_[2 * n];
  state.velocity = to_[2 * n + 1];
}

std::shared_ptr<const LinearStep> LinearSteps::get(const ModalInterface& of, double step, bool sliding, bool floors,
                                                   std::size_t steps) {
  if (!LinearStep::pays(of, step, sliding, floors, steps)) return nullptr;
  const std::lock_guard lock(mutex_);
  for (const auto& [with_floors, known] : known_)
    if (with_floors == floors && known->sliding() == sliding && equal(known->duration(), step)) return known;
  if (known_.size() == most) known_.erase(known_.begin());
  std::optional<FloorRows> rows;
  if (floors) rows.emplace(of);
  known_.emplace_back(floors, std::make_shared<const LinearStep>(of, step, sliding, rows ? &*rows : nullptr));
  return known_.back().second;
}

}  // namespace stickslip::detail

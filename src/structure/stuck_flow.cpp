#include "structure/stuck_flow.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "stickslip/friction/coulomb.hpp"
#include "stickslip/state/state.hpp"
#include "stickslip/structure/response.hpp"
#include "structure/expansion.hpp"

namespace stickslip::detail {
namespace {

using Eigen::Index;

// A part is at most this divided by the fastest mode.
constexpr double reach = 0.5;

double fastest_of(const ModalInterface& of) {
  double fastest = 0;
  for (Index j = 0; j < of.modes(); ++j) fastest = std::max({fastest, std::sqrt(of.stiffness[j]), of.damping(j, j)});
  return fastest;
}

double parts_of(const ModalInterface& of, double step) {
  return std::max(1.0, std::ceil(fastest_of(of) * step / reach));
}

// The largest value of u - u^k on [0, 1]: how far u^k is from its chord.
double below_chord(int k) {
  const double u = std::pow(k, -1.0 / (k - 1));
  return u - std::pow(u, k);
}

}  // namespace

bool StuckFlow::covers(const ModalInterface& of, double step) {
  return std::isfinite(step) && of.classical && (of.reaction.array() == 0).all() && parts_of(of, step) <= 256;
}

StuckFlow::StuckFlow(const ModalInterface& of, double step)
    : parts_(static_cast<std::size_t>(parts_of(of, step))),
      part_(step / static_cast<double>(parts_)),
      modes_(static_cast<std::size_t>(of.modes())),
      oscillators_() {
  const Index n = of.modes();
  const auto count = modes_.size();
  const bool has_top = of.shapes.rows() > 0;
  for (Row* row : {&demand_, &top_}) row->of_state_.assign(2 * count, 0), row->from_state_.assign(2 * count, 0);
  demand_.ground_ = of.ground_demand;
  for (std::size_t j = 0; j < count; ++j) {
    const auto i = static_cast<Index>(j);
    oscillators_.push_back({of.stiffness[i], of.damping(i, i), std::abs(of.demand[i])});
    demand_.of_state_[j] = of.demand[i] * of.stiffness[i];
    demand_.of_state_[count + j] = of.demand[i] * of.damping(i, i);
    if (has_top) top_.of_state_[j] = of.shapes(0, i);
  }

  // All modes at once: they do not feel each other.
  ModalInterface stuck = of;
  stuck.fastest = fastest_of(of);
  Expansion expansion(stuck, part_);
  const Eigen::VectorXd zeros = Eigen::VectorXd::Zero(n);
  const std::vector<double> one(count, 1), none(count, 0);
  enum Source { from_y, from_rate, from_n, from_change };
  for (const Source source : {from_y, from_rate, from_n, from_change}) {
    const GroundLoad load{part_, source == from_n ? 1.0 : 0.0, source == from_n || source == from_change ? 1.0 : 0.0};
    StructureState state{.modal_displacement = source == from_y ? one : none,
                         .modal_velocity = source == from_rate ? one : none};
    expansion.expand(state, load, part_, part_, 0, Coulomb(1));
    const Eigen::MatrixXd y = expansion.modal_displacement(), rate = expansion.modal_velocity();
    const Eigen::MatrixXd force = y * of.stiffness.asDiagonal() + rate * of.damping.diagonal().asDiagonal();
    for (Index k = 2; k < y.rows(); ++k) {
      const double below = below_chord(static_cast<int>(k));
      const Eigen::VectorXd q = force.row(k).transpose().cwiseProduct(of.demand);
      const Eigen::VectorXd u = has_top ? y.row(k).cwiseProduct(of.shapes.row(0)).transpose() : zeros;
      for (const auto& [row, terms] : {std::pair<Row&, const Eigen::VectorXd&>(demand_, q), {top_, u}}) {
        if (source == from_n) row.from_n_ += below * std::abs(terms.sum());
        if (source == from_change) row.from_change_ += below * std::abs(terms.sum());
        for (std::size_t j = 0; source <= from_rate && j < count; ++j)
          row.from_state_[source == from_y ? j : count + j] += below * std::abs(terms[static_cast<Index>(j)]);
      }
    }
    expansion.end(state);
    for (std::size_t j = 0; j < count; ++j) {
      Map& m = modes_[j];
      const double at_y = state.modal_displacement[j];
      const double at_rate = state.modal_velocity[j];
      if (source == from_y) m.yy = at_y, m.ry = at_rate;
      if (source == from_rate) m.yr = at_y, m.rr = at_rate;
      if (source == from_n) m.yn = at_y, m.rn = at_rate;
      if (source == from_change) m.yc = at_y, m.rc = at_rate;
    }
  }

  free_.resize(most_steps * count);
  for (std::size_t j = 0; j < count; ++j) {
    const auto product = [](const Free& a, const Free& b) {
      return Free{a.yy * b.yy + a.yr * b.ry, a.yy * b.yr + a.yr * b.rr, a.ry * b.yy + a.rr * b.ry,
                  a.ry * b.yr + a.rr * b.rr};
    };
    Free whole = modes_[j];
    for (std::size_t i = 1; i < parts_; ++i) whole = product(modes_[j], whole);
    free_[j] = whole;
    for (std::size_t k = 1; k < most_steps; ++k) free_[k * count + j] = product(whole, free_[(k - 1) * count + j]);
  }
}

}  // namespace stickslip::detail

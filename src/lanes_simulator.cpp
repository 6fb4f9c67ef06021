#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "coulomb_lanes.hpp"
#include "stickslip/ensemble.hpp"

namespace stickslip::detail {
namespace {

class LanesSimulator final : public Simulator {
 public:
  LanesSimulator(const Coulomb& law, const GaussianExcitation& excitation, std::uint64_t seed, bool settle)
      : law_(law), excitation_(excitation), seed_(seed), settle_(settle) {}

  void simulate(std::uint64_t first_member, std::size_t members, Block& block) override {
    const std::size_t width = block.width(), samples = excitation_.samples();
    generate(first_member, members, width, block);

    const auto every = static_cast<std::size_t>(std::round(block.times().dt / excitation_.dt()));
    const bool linear = excitation_.interpolation() == Interpolation::linear;
    const CoulombLanes slider{law_.forward(), law_.backward(), excitation_.dt()};
    displacement_.assign(width, 0);
    velocity_.assign(width, 0);
    std::fill(block.peak().begin(), block.peak().end(), 0.0);
    const LaneStates states{displacement_.data(), velocity_.data(), block.peak().data()};
    block.row(0, displacement_.data(), velocity_.data());
    for (std::size_t i = 1; i < samples; ++i) {
      const double* const start = &ground_[(i - 1) * width];
      advance_lanes(slider, width, start, linear ? start + width : start, states);
      if (i % every == 0) block.row(i / every, displacement_.data(), velocity_.data());
      if (i % 256 == 0) block.beat();
    }
    if (settle_) settle_all(members, block);
    std::copy_n(displacement_.begin(), width, block.residual().begin());
  }

 private:
  // The ground accelerations of all members, by sample and member.
  void generate(std::uint64_t first_member, std::size_t members, std::size_t width, Block& block) {
    const std::size_t samples = excitation_.samples();
    if (ground_.size() != width * samples) {
      ground_.assign(width * samples, 0);
      records_.resize(row_padding * samples);
    }
    for (std::size_t i = 0; i < members; i += row_padding) {
      block.beat();
      const std::size_t some = std::min(row_padding, members - i);
      for (std::size_t k = 0; k < some; ++k)
        excitation_.sample(seed_, first_member + i + k, {&records_[k * samples], samples}, workspace_);
      if (some < row_padding)
        std::fill(records_.begin() + static_cast<std::ptrdiff_t>(some * samples), records_.end(), 0.0);
      transpose(records_.data(), samples, &ground_[i], width);
    }
  }

  // Eight rows of `samples` become columns, `width` apart.
  static void transpose(const double* __restrict rows, std::size_t samples, double* __restrict columns,
                        std::size_t width) {
    for (std::size_t s = 0; s < samples; ++s)
      for (std::size_t k = 0; k < row_padding; ++k) columns[s * width + k] = rows[k * samples + s];
  }

  void settle_all(std::size_t members, Block& block) {
    const Slider<Coulomb> slider(law_);
    for (std::size_t i = 0; i < members; ++i) {
      State state = State::at(displacement_[i], velocity_[i]);
      settle(slider, state, [&](double duration) { advance(slider, Segment{duration, 0, 0}, state); });
      displacement_[i] = state.displacement;
      block.peak()[i] = std::max(block.peak()[i], std::abs(state.displacement));
    }
  }

  Coulomb law_;
  const GaussianExcitation& excitation_;
  std::uint64_t seed_;
  bool settle_;
  GaussianExcitation::Workspace workspace_;
  std::vector<double> records_, ground_, displacement_, velocity_;
};

}  // namespace

std::unique_ptr<Simulator> lanes_simulator(const Coulomb& law, const GaussianExcitation& excitation, std::uint64_t seed,
                                           bool settle) {
  return std::make_unique<LanesSimulator>(law, excitation, seed, settle);
}

}  // namespace stickslip::detail

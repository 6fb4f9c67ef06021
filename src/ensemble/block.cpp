#include "stickslip/ensemble/detail/block.hpp"

#include <fftw3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "lanes/row_moments.hpp"
#include "numerics/fftw_plan.hpp"
#include "numerics/kaiser_window.hpp"
#include "stickslip/ensemble/ensemble.hpp"
#include "stickslip/ensemble/floor_peaks.hpp"

namespace stickslip::detail {

/// Periodograms of the velocities of a block.
struct Block::Spectrum {
  explicit Spectrum(std::size_t samples)
      : window(kaiser_window(samples)), real(row_padding * samples), complex(samples / 2 + 1) {
    plan = make_plan([&] {
      return fftw_plan_dft_r2c_1d(static_cast<int>(samples), real.data(), output(), FFTW_ESTIMATE | FFTW_UNALIGNED);
    });
  }

  fftw_complex* output() { return reinterpret_cast<fftw_complex*>(complex.data()); }

  std::vector<double> window, real;
  std::vector<std::complex<double>> complex;
  FftwPlan plan;
};

Block::Block(const EnsembleTimes& times, bool velocity_spectrum, bool ground_acceleration,
             const std::atomic<bool>& stopped, bool in_plane)
    : times_(times),
      ground_acceleration_(ground_acceleration),
      in_plane_(in_plane),
      width_(Ensemble::block(times.count)),
      stopped_(stopped),
      peak_(width_),
      residual_(width_),
      residual_transverse_(in_plane ? width_ : 0),
      central_(4 * width_),
      first_half_(width_),
      marks_(3 * width_) {
  if (velocity_spectrum) {
    spectrum_ = std::make_unique<Spectrum>(times.central());
    velocities_.resize(times.central() * width_);
  }
}

Block::~Block() = default;

void Block::begin(std::size_t members) {
  members_ = members;
  grounds_ = 0;
  impacts_.clear();
  floor_peaks_.clear();
  gaps_ = {};
  airborne_ = 0;
  tally_ = Tally(times_.count, spectrum_ ? spectrum_->complex.size() : 0, ground_acceleration_, in_plane_);
  tally_.count = members;
  std::fill(central_.begin(), central_.end(), 0.0);
}

void Block::row(std::size_t time, const double* displacement, const double* velocity) {
  double* const sums = central_.data();
  const CentralSums central{sums, sums + width_, sums + 2 * width_, sums + 3 * width_};
  const std::size_t begin = times_.begin(), length = times_.central();
  const bool is_central = time >= begin && time < begin + length;
  if (time == begin + length / 2) std::copy_n(central.velocity_square, width_, first_half_.data());
  row_moments(displacement, velocity, members_, tally_.sums().data() + time, times_.count,
              is_central ? &central : nullptr);
  if (is_central && spectrum_) std::copy_n(velocity, width_, velocities_.data() + (time - begin) * width_);
  const std::size_t marks[] = {begin, begin + length / 2, begin + length};
  for (std::size_t i = 0; i < 3; ++i)
    if (time == marks[i]) std::copy_n(displacement, width_, marks_.data() + i * width_);
}

void Block::row(std::size_t time, const Motions& along_axis, const Motions& transverse) {
  const auto sum = [&](Tally::Pair pair, const double* one, const double* other) {
    row_moments(one, other, members_, tally_.moment(Tally::x, pair).data() + time, times_.count, nullptr);
  };
  sum(Tally::along_axis, along_axis.displacement, along_axis.velocity);
  sum(Tally::transverse, transverse.displacement, transverse.velocity);
  sum(Tally::displacements, along_axis.displacement, transverse.displacement);
  sum(Tally::velocities, along_axis.velocity, transverse.velocity);
}

void Block::impacts(std::size_t member, const SmallestGaps& gaps, const Impacts& impacts) {
  impacts_.resize(width_);
  impacts_[member] = impacts;
  gaps_.include(gaps);
}

void Block::floors(std::size_t member, std::span<const double> peaks) {
  if (floor_peaks_.empty()) floor_peaks_.resize(members_ * peaks.size());
  need_same_floors(floor_peaks_.size() / members_, peaks.size());
  std::ranges::copy(peaks, floor_peaks_.begin() + static_cast<std::ptrdiff_t>(member * peaks.size()));
}

void Block::ground(std::span<const double> acceleration) {
  // Adds one value to the moments about the mean (Pebay 2008, with one value on the right).
  const auto before = static_cast<double>(grounds_++), after = before + 1, share = 1 / after, weight = before * share;
  const auto mean = tally_.moment(Tally::n), second = tally_.moment(Tally::nn), third = tally_.moment(Tally::nnn),
             fourth = tally_.moment(Tally::nnnn);
  for (std::size_t i = 0; i < acceleration.size(); ++i) {
    const double d = acceleration[i] - mean[i], part = share * d, square = weight * d * d;
    fourth[i] += square * (d * d - 3 * part * (d - part)) + 6 * part * part * second[i] - 4 * part * third[i];
    third[i] += square * (d - 2 * part) - 3 * part * second[i];
    second[i] += square;
    mean[i] += part;
  }
}

Tally Block::finish() {
  if (times_.count == 0 || in_plane_) return std::move(tally_);
  const auto n = static_cast<double>(members_);
  const auto length = static_cast<double>(times_.central());
  const double* const sums = central_.data();
  const double* const marks = marks_.data();

  double mean_half = 0, mean_whole = 0;
  for (std::size_t i = 0; i < members_; ++i) {
    mean_half += (marks[width_ + i] - marks[i]) / n;
    mean_whole += (marks[2 * width_ + i] - marks[i]) / n;
  }
  const auto half_length = static_cast<double>(times_.central() / 2);
  const double second_half = static_cast<double>(times_.central() - times_.central() / 2) * times_.dt;
  // Corrects mean squares about the mean of a few members, which are too small.
  const double unbiased = n > 1 ? n / (n - 1) : 1;
  std::vector<std::array<double, features>> values(members_);
  for (std::size_t i = 0; i < members_; ++i) {
    const double half = marks[width_ + i] - marks[i], whole = marks[2 * width_ + i] - marks[i];
    const double e = half - mean_half, f = whole - mean_whole;
    const double before = first_half_[i], after = sums[width_ + i] - before;
    values[i] = {sums[i] / length,
                 half,
                 whole,
                 unbiased * sums[width_ + i] / length,
                 unbiased * unbiased * sums[2 * width_ + i] / length,
                 unbiased * sums[3 * width_ + i] / length,
                 unbiased * (f * f - e * e) / second_half,
                 half_length > 0 ? unbiased * (after / (length - half_length) - before / half_length) : 0};
    for (std::size_t a = 0; a < features; ++a) tally_.mean(a) += values[i][a] / n;
  }
  for (const auto& value : values)
    for (std::size_t a = 0; a < features; ++a)
      for (std::size_t b = 0; b < features; ++b)
        tally_.scatter(a, b) += (value[a] - tally_.mean(a)) * (value[b] - tally_.mean(b));

  if (spectrum_) {
    // Density of one member: |dt DFT|^2 / (2 pi M dt).
    Spectrum& s = *spectrum_;
    const double scale = times_.dt / (2 * std::numbers::pi * length);
    const std::span<double> mean = tally_.density_mean(), scatter = tally_.density_scatter();
    const std::size_t samples = s.window.size();
    for (std::size_t first = 0; first < members_; first += row_padding) {
      for (std::size_t k = 0; k < samples; ++k)  // a line of memory at a time
        for (std::size_t i = 0; i < row_padding; ++i)
          s.real[i * samples + k] = s.window[k] * velocities_[k * width_ + first + i];
      for (std::size_t i = 0; i < std::min(row_padding, members_ - first); ++i) {
        fftw_execute_dft_r2c(s.plan.get(), &s.real[i * samples], s.output());
        const double share = 1 / static_cast<double>(first + i + 1), weight = static_cast<double>(first + i) * share;
        for (std::size_t k = 0; k < mean.size(); ++k) {
          const double re = s.complex[k].real(), im = s.complex[k].imag();
          const double density = scale * (re * re + im * im), difference = density - mean[k];
          mean[k] += share * difference;
          scatter[k] += weight * difference * difference;
        }
      }
    }
  }
  return std::move(tally_);
}

}  // namespace stickslip::detail

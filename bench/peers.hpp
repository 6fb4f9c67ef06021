// The solution of a good engineer without a library: an ensemble as a plain loop over records, with FFTW and closed
// forms.
#pragma once

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

namespace bench {

/// xoshiro256++ (Blackman & Vigna 2021): faster than std::mt19937_64.
class Xoshiro {
 public:
  explicit Xoshiro(std::uint64_t seed) {
    for (std::uint64_t& word : state_) {  // SplitMix64
      std::uint64_t z = seed += 0x9E3779B97F4A7C15;
      z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
      z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
      word = z ^ (z >> 31);
    }
  }

  /// Uniform, above 0 and at most 1.
  double operator()() {
    const std::uint64_t result = rotated(state_[0] + state_[3], 23) + state_[0], shifted = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = rotated(state_[3], 45);
    return static_cast<double>((result >> 11) + 1) * 0x1p-53;
  }

 private:
  static std::uint64_t rotated(std::uint64_t word, int by) { return (word << by) | (word >> (64 - by)); }

  std::uint64_t state_[4];
};

/// Sums over the members, at each time. They are interleaved: a separate array for each sum takes longer.
struct Sums {
  struct Time {
    double x = 0, v = 0, xx = 0, xv = 0, vv = 0;
  };

  explicit Sums(std::size_t times) : at(times) {}

  void add(const std::vector<double>& displacement, const std::vector<double>& velocity) {
    for (std::size_t i = 0; i < at.size(); ++i) {
      const double x = displacement[i], v = velocity[i];
      Time& sums = at[i];
      sums.x += x;
      sums.v += v;
      sums.xx += x * x;
      sums.xv += x * v;
      sums.vv += v * v;
    }
  }

  std::vector<Time> at;
};

/// Gaussian ground accelerations with a flat density in a band and random phases, thesis (4.49), with the amplitudes
/// corrected for linear interpolation between samples.
class BandPassRecords {
 public:
  BandPassRecords(double s0, double low, double high, double dt, std::size_t samples)
      : samples_(samples), lines_(fftw_alloc_complex(samples / 2 + 1)), record_(fftw_alloc_real(samples)) {
    const int size = static_cast<int>(samples);
    plan_.reset(fftw_plan_dft_c2r_1d(size, lines_.get(), record_.get(), FFTW_MEASURE | FFTW_PRESERVE_INPUT));
    std::fill_n(&lines_[0][0], 2 * (samples / 2 + 1), 0.0);
    const double spacing = 2 * std::numbers::pi / (static_cast<double>(samples) * dt);
    first_ = static_cast<std::size_t>(std::ceil(low / spacing));
    for (std::size_t k = first_; static_cast<double>(k) * spacing <= high; ++k) {
      const double half = static_cast<double>(k) * spacing * dt / 2, sinc = std::sin(half) / half;
      amplitudes_.push_back(std::sqrt(s0 * spacing) / (sinc * sinc));
    }
  }

  /// The next motion [m/s^2], valid until the next call.
  const double* operator()(Xoshiro& random) {
    for (std::size_t k = 0; k < amplitudes_.size(); ++k) {
      const double phase = 2 * std::numbers::pi * random();
      lines_[first_ + k][0] = amplitudes_[k] * std::cos(phase);
      lines_[first_ + k][1] = amplitudes_[k] * std::sin(phase);
    }
    fftw_execute(plan_.get());
    return record_.get();
  }

  std::size_t samples() const { return samples_; }

 private:
  struct Free {
    void operator()(void* memory) const { fftw_free(memory); }
    void operator()(fftw_plan plan) const { fftw_destroy_plan(plan); }
  };

  std::size_t samples_, first_;
  std::vector<double> amplitudes_;
  std::unique_ptr<fftw_complex[], Free> lines_;
  std::unique_ptr<double[], Free> record_;
  std::unique_ptr<std::remove_pointer_t<fftw_plan>, Free> plan_;
};

/// One record of Coulomb friction, from rest. Segments are examined in detail only where an event is possible; slips
/// and rests have a short loop each.
class CoulombRecord {
 public:
  CoulombRecord(double slip_level, double dt, std::size_t samples)
      : a_(slip_level * dt * dt), dt_(dt), loads_(samples), x_(samples), v_(samples) {}

  void operator()(const double* n, Sums& sums) {
    // Local copies, which writes to the arrays cannot change: they stay in registers.
    const std::size_t last = loads_.size() - 1;
    const double a = a_, square = dt_ * dt_, per_dt = 1 / dt_;
    double *p = loads_.data(), *xs = x_.data(), *vs = v_.data();
    for (std::size_t i = 0; i <= last; ++i) p[i] = -n[i] * square;  // dt is the unit of time
    double x = 0, v = 0;
    std::size_t i = 0;
    for (;;) {
      if (v == 0) {
        for (; i < last && std::abs(p[i]) <= a && std::abs(p[i + 1]) <= a; ++i) {
          xs[i + 1] = x;
          vs[i + 1] = 0;
        }
      } else {
        const double s = v > 0 ? 1 : -1;
        double distance = s * x, speed = s * v, net = s * p[i] - a;
        for (; i < last; ++i) {
          const double next_net = s * p[i + 1] - a, next = speed + (net + next_net) / 2;
          if (!(next > 0 && (net >= 0 || next_net <= 0))) break;
          distance += speed + net * (1.0 / 3) + next_net * (1.0 / 6);
          speed = next;
          net = next_net;
          xs[i + 1] = s * distance;
          vs[i + 1] = s * speed * per_dt;
        }
        x = s * distance;
        v = s * speed;
      }
      if (i == last) break;
      const Motion end = segment_with_events(p[i], p[i + 1], a, {x, v});
      x = end.x;
      v = end.v;
      ++i;
      xs[i] = x;
      vs[i] = v * per_dt;
    }
    sums.add(x_, v_);
  }

 private:
  struct Motion {
    double x, v;
  };

  static Motion segment_with_events(double load, double end, double a, Motion m) {
    const double rate = end - load;
    for (double left = 1;;) {
      double s = m.v > 0 ? 1 : -1;
      if (m.v == 0) {
        if (std::abs(load) > a) {
          s = std::copysign(1, load);
        } else {
          if (std::abs(end) <= a) return m;
          s = std::copysign(1, end);
          load = s * a;
          left = (end - load) / rate;
        }
      }
      const double u = s * m.v, net = s * load - a, gain = s * rate;
      const double last = u + left * (net + gain * left / 2);
      double stop = std::numeric_limits<double>::infinity();
      if (!(last > 0 && (net >= 0 || net + gain * left <= 0))) {
        const double discriminant = net * net - 2 * gain * u;
        if (net < 0) {
          if (discriminant >= 0) stop = 2 * u / (std::sqrt(discriminant) - net);
        } else if (gain < 0) {
          stop = (net + std::sqrt(discriminant)) / -gain;
        }
      }
      const double t = std::min(stop, left);
      m.x += s * t * (u + t * (net / 2 + gain * t / 6));
      if (stop > left) {
        m.v = s * last;
        return m;
      }
      m.v = 0;
      load += rate * stop;
      left -= stop;
    }
  }

  double a_, dt_;
  std::vector<double> loads_, x_, v_;
};

/// One member of Coulomb friction under Poisson pulses, thesis 5.4: b for the half width, then -b for as long. The
/// steps of all pulses and the sampling times are merged on the fly.
class CoulombPulses {
 public:
  CoulombPulses(double slip_level, double rate, double half_width, double sigma, double dt, std::size_t samples)
      : a_(slip_level), rate_(rate), half_width_(half_width), sigma_(sigma), dt_(dt), x_(samples), v_(samples) {}

  /// @return the number of steps
  std::size_t operator()(Xoshiro& random, Sums& sums) {
    constexpr double never = std::numeric_limits<double>::infinity();
    const double duration = static_cast<double>(x_.size() - 1) * dt_;
    pulses_.clear();
    for (double t = -std::log(random()) / rate_; t < duration; t -= std::log(random()) / rate_)
      pulses_.push_back({t, 0});
    for (std::size_t i = 0; i < pulses_.size(); i += 2) {  // Box-Muller, thesis (5.57), (5.58)
      const double radius = sigma_ * std::sqrt(-2 * std::log(random())), angle = 2 * std::numbers::pi * random();
      pulses_[i].amplitude = radius * std::cos(angle);
      if (i + 1 < pulses_.size()) pulses_[i + 1].amplitude = radius * std::sin(angle);
    }
    pulses_.push_back({never, 0});

    const double dt = dt_, half_width = half_width_, a = a_;
    double *xs = x_.data(), *vs = v_.data();
    const std::size_t samples = x_.size();
    std::size_t steps = 0, sample = 1;
    const Pulse *begins = pulses_.data(), *turns = begins, *ends = begins;
    double begin = begins->arrival, turn = turns->arrival + half_width, end = ends->arrival + 2 * half_width;
    double t = 0, load = 0, x = 0, v = 0;
    for (; sample < samples; ++steps) {
      const double time = static_cast<double>(sample) * dt, next = std::min(std::min(begin, turn), std::min(end, time));
      slide(next - t, load, a, x, v);
      t = next;
      if (next == time) {
        xs[sample] = x;
        vs[sample] = v;
        ++sample;
      } else if (next == begin) {
        load -= begins->amplitude;
        begin = (++begins)->arrival;
      } else if (next == turn) {
        load += 2 * turns->amplitude;
        turn = (++turns)->arrival + half_width;
      } else {
        load -= ends->amplitude;
        end = (++ends)->arrival + 2 * half_width;
      }
    }
    sums.add(x_, v_);
    return steps;
  }

 private:
  struct Pulse {
    double arrival, amplitude;
  };

  static void slide(double left, double load, double a, double& x, double& v) {
    if (v != 0) {
      const double net = load - std::copysign(a, v), last = v + net * left;
      if (last * v > 0) {
        x += left * (v + last) / 2;
        v = last;
        return;
      }
      const double stop = -v / net;
      x += stop * v / 2;
      v = 0;
      left -= stop;
    }
    if (std::abs(load) <= a) return;
    v = (load - std::copysign(a, load)) * left;
    x += v * left / 2;
  }

  double a_, rate_, half_width_, sigma_, dt_;
  std::vector<double> x_, v_;
  std::vector<Pulse> pulses_;
};

}  // namespace bench

// One record of 100,000 samples: the cost per sample, for each law, with and without a spring.
//
// long_record [--check] [--json] [--rounds N]
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <stickslip/stickslip.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench.hpp"

using namespace stickslip;

namespace {

constexpr std::size_t samples = 100'000;
constexpr double dt = 0.1;         // [s]
constexpr double deviation = 2;    // of the ground acceleration [m/s^2]
constexpr double slip_level = 1;   // [m/s^2]
constexpr double frequency = 1.3;  // of the spring [rad/s]
constexpr double reach = 0.5;      // of the caster [m]

// ---- ground accelerations. long_record.py makes the same ones.

// SplitMix64 (Steele, Lea & Flood 2014), as doubles from 0 to 1.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  double operator()() {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

std::vector<double> independent() {
  Random random(1);
  std::vector<double> n(samples);
  for (double& value : n) {
    const double radius = std::sqrt(-2 * std::log(1 - random()));
    value = deviation * radius * std::cos(2 * std::numbers::pi * random());
  }
  return n;
}

// Cosines of random phase, one at a random place in each of many strips of the band.
std::vector<double> band(double low, double high) {
  constexpr int strips = 400;
  Random random(2);
  std::vector<double> n(samples);
  for (int k = 0; k < strips; ++k) {
    const double omega = low + (high - low) * (k + random()) / strips;
    const double phase = 2 * std::numbers::pi * random();
    const double cosine = std::cos(omega * dt), sine = std::sin(omega * dt);
    double c = deviation * std::sqrt(2.0 / strips) * std::cos(phase);
    double s = deviation * std::sqrt(2.0 / strips) * std::sin(phase);
    for (double& value : n) {
      value += c;
      const double turned = c * cosine - s * sine;
      s = c * sine + s * cosine;
      c = turned;
    }
  }
  return n;
}

struct Input {
  const char* name;
  const char* title;
  std::vector<double> acceleration;
};

std::vector<Input> inputs() {
  constexpr double square = std::numbers::pi * std::numbers::pi;
  return {{"independent", "independent samples", independent()},
          {"broad", "band 0.5 to 15 rad/s", band(0.5, 15)},
          {"narrow", "band 20/pi^2 to 40/pi^2 rad/s", band(20 / square, 40 / square)}};  // thesis (4.49)
}

// ---- the plain loop: a solution without a library

void plain_loop(const std::vector<double>& n, double a, std::vector<double>& x, std::vector<double>& v) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double position = 0, velocity = 0;
  x[0] = v[0] = 0;
  for (std::size_t i = 0; i + 1 < n.size(); ++i) {
    const double rate = (n[i] - n[i + 1]) / dt;  // of the load -n
    double t = 0;
    for (;;) {
      double left = dt - t, load = -n[i] + rate * t, s;
      if (velocity == 0) {
        if (load > a) {
          s = 1;
        } else if (load < -a) {
          s = -1;
        } else {
          if (-n[i + 1] > a)
            s = 1;
          else if (-n[i + 1] < -a)
            s = -1;
          else
            break;
          t = (s * a + n[i]) / rate;
          left = dt - t;
          load = s * a;
        }
        const double net = s * load - a, gain = s * rate;
        const double stop = gain < 0 ? -2 * net / gain : infinity;
        if (stop >= left) {
          position += s * left * left * (net / 2 + gain * left / 6);
          velocity = s * left * (net + gain * left / 2);
          break;
        }
        position += s * stop * stop * (net / 2 + gain * stop / 6);
        t += stop;
      } else {
        s = velocity > 0 ? 1 : -1;
        const double u = std::abs(velocity), net = s * load - a, gain = s * rate;
        const double last = u + left * (net + gain * left / 2);
        double stop = infinity;
        if (!(last > 0 && (net >= 0 || net + gain * left <= 0))) {
          const double discriminant = net * net - 2 * gain * u;
          if (net < 0) {
            if (discriminant >= 0) stop = 2 * u / (std::sqrt(discriminant) - net);
          } else if (gain < 0) {
            stop = (net + std::sqrt(discriminant)) / -gain;
          }
        }
        if (stop > left) {
          position += s * left * (u + left * (net / 2 + gain * left / 6));
          velocity = s * last;
          break;
        }
        position += s * stop * (u + stop * (net / 2 + gain * stop / 6));
        velocity = 0;
        t += stop;
      }
    }
    x[i + 1] = position;
    v[i + 1] = velocity;
  }
}

// ---- the sliders

// A user-defined law.
struct Bump {
  template <class T>
  auto resist(const T& x, Direction) const {
    using std::exp;
    return slip_level * exp(-(x / reach) * (x / reach));
  }
};

template <class Visit>
void for_each_slider(Visit&& visit) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  visit("Coulomb", Slider(Coulomb(slip_level)));
  visit("Coulomb, unequal levels", Slider(Coulomb(slip_level, 1.5 * slip_level)));
  visit("Coulomb, one-way", Slider(Coulomb(slip_level, infinity)));
  visit("Coulomb, spring", Slider(Coulomb(slip_level), frequency));
  visit("Caster", Slider(Caster(slip_level, reach)));
  visit("Caster, spring", Slider(Caster(slip_level, reach), frequency));
  visit("law of one's own", Slider(Bump{}));
  visit("law of one's own, spring", Slider(Bump{}, frequency));
}

// A user's own time loop.
template <class Law>
void advance_loop(const Slider<Law>& slider, const std::vector<double>& n, std::vector<double>& x,
                  std::vector<double>& v) {
  State state;
  for (std::size_t i = 0; i + 1 < n.size(); ++i) {
    advance(slider, Segment{dt, n[i], n[i + 1]}, state);
    x[i + 1] = state.displacement;
    v[i + 1] = state.velocity;
  }
}

// ---- checks of the results

/// The same motion with an additional sample in the middle of each segment.
GroundMotion halved(const std::vector<double>& n) {
  std::vector<double> fine;
  for (std::size_t i = 0; i + 1 < n.size(); ++i) {
    fine.push_back(n[i]);
    fine.push_back(n[i] + (n[i + 1] - n[i]) / 2);
  }
  fine.push_back(n.back());
  return {std::move(fine), dt / 2};
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b, std::size_t stride = 1) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i * stride]));
  return largest;
}

// An escaped caster is no longer braked: energy flows back and forth between it and the ground.
double largest_kinetic(const Response& response) {
  double largest = 0;
  for (const double v : response.velocity) largest = std::max(largest, v * v / 2);
  return largest;
}

void check(const Input& input) {
  const std::vector<double>& n = input.acceleration;
  const GroundMotion motion(n, dt), fine = halved(n);
  const std::string title = std::string(", ") + input.title;

  for_each_slider([&](const std::string& name, const auto& slider) {
    const Response response = integrate(slider, motion);
    bench::require_below(name + title + ": energy that does not add up", std::abs(response.energy.imbalance()),
                         1e-11 * (response.energy.dissipated + largest_kinetic(response)));
    bench::require_below(name + title + ": change of x where segments are halved",
                         largest_difference(response.displacement, integrate(slider, fine).displacement, 2),
                         1e-9 * response.peak);
  });

  std::vector<double> x(samples), v(samples);
  const Response response = detail::integrate_in_order(Slider(Coulomb(slip_level)), motion);
  plain_loop(n, slip_level, x, v);
  bench::require_below("plain loop" + title + ": x from integrate's", largest_difference(x, response.displacement),
                       1e-12 * response.peak);
  advance_loop(Slider(Coulomb(slip_level)), n, x, v);
  bench::require_below("advance" + title + ": x from integrate's", largest_difference(x, response.displacement), 0);
  const Response by_pieces = integrate(Coulomb(slip_level), motion);
  bench::require_below("pieces" + title + ": x from integrate's",
                       largest_difference(by_pieces.displacement, response.displacement), 1e-12 * response.peak);
  bench::require_below("pieces" + title + ": energy that does not add up", std::abs(by_pieces.energy.imbalance()),
                       1e-12 * by_pieces.energy.dissipated);
  bench::require_below(
      "pieces" + title + ": events from integrate's",
      std::abs(static_cast<double>(by_pieces.events.size()) - static_cast<double>(response.events.size())), 0);
  bench::require_below("histories" + title + ": x from integrate's",
                       largest_difference(histories(Coulomb(slip_level), motion).displacement, response.displacement),
                       1e-12 * response.peak);
}

// ---- timing

std::vector<bench::Timing> time(const Input& input, int rounds) {
  const std::vector<double>& n = input.acceleration;
  const GroundMotion motion(n, dt);
  std::vector<double> x(samples), v(samples);

  bench::Bench bench(samples);
  bench.add("plain loop", [&] {
    std::vector<double> fresh_x(samples), fresh_v(samples);
    plain_loop(n, slip_level, fresh_x, fresh_v);
    bench::keep(fresh_x);
    bench::keep(fresh_v);
  });
  bench.add("plain loop, arrays at hand", [&] {
    plain_loop(n, slip_level, x, v);
    bench::keep(x);
  });
  bench.add("advance: Coulomb, arrays at hand", [&] {
    advance_loop(Slider(Coulomb(slip_level)), n, x, v);
    bench::keep(x);
  });
  bench.add("advance: Coulomb, spring, arrays at hand", [&] {
    advance_loop(Slider(Coulomb(slip_level), frequency), n, x, v);
    bench::keep(x);
  });
  bench.add("integrate: Coulomb, memory used again", [&motion, response = Response()]() mutable {
    response = integrate(Coulomb(slip_level), motion, {}, std::move(response));
    bench::keep(response);
  });
  bench.add("integrate, header-only: Coulomb",
            [&] { bench::keep(detail::integrate_in_order(Slider(Coulomb(slip_level)), motion)); });
  bench.add("integrate, header-only: Coulomb, memory used again", [&motion, response = Response()]() mutable {
    response = detail::integrate_in_order(Slider(Coulomb(slip_level)), motion, {}, std::move(response));
    bench::keep(response);
  });
  bench.add("histories: Coulomb", [&] { bench::keep(histories(Coulomb(slip_level), motion)); });
  for_each_slider([&](const std::string& name, const auto& slider) {
    bench.add("integrate: " + name, [&motion, slider] { bench::keep(integrate(slider, motion)); });
  });
  return bench.run(rounds);
}

}  // namespace

int main(int argc, char** argv) {
  const bench::Options asked = bench::options(argc, argv, "long_record");

  const std::vector<Input> all = inputs();
  for (const Input& input : all) check(input);
  if (asked.check) return EXIT_SUCCESS;

  const BuildInfo& build = build_info();
  if (asked.json)
    std::printf("{\"processor\": %s, \"compiler\": %s, \"flags\": %s, \"commit\": %s, \"inputs\": {",
                bench::json_string(bench::processor()).c_str(), bench::json_string(build.compiler).c_str(),
                bench::json_string(build.compiler_flags).c_str(), bench::json_string(build.commit).c_str());
  else
    bench::print_machine();
  if (!asked.json)
    std::printf(
        "%zu samples, dt = %g s, standard deviation %g m/s^2, slip level %g m/s^2; answers checked\n"
        "ns of processor time per sample over %d rounds; ratio to the plain loop, which like integrate returns new "
        "arrays\n",
        samples, dt, deviation, slip_level, asked.rounds);

  for (const Input& input : all) {
    const std::vector<bench::Timing> timings = time(input, asked.rounds);
    const Response response = integrate(Coulomb(slip_level), GroundMotion(input.acceleration, dt));
    if (!asked.json) {
      bench::print_table(input.title, timings, 0);
      std::printf("Coulomb: %.3f events a sample, sliding %.0f %% of the time\n",
                  static_cast<double>(response.events.size()) / samples,
                  100 * response.time_sliding / (dt * (samples - 1)));
      continue;
    }
    std::printf("%s\n%s: {\"residual\": %.17g, \"rows\": {", &input == all.data() ? "" : ",",
                bench::json_string(input.name).c_str(), response.residual);
    for (const bench::Timing& timing : timings)
      std::printf("%s\n  %s: {\"median\": %.3f, \"least\": %.3f, \"spread\": %.3f}",
                  &timing == timings.data() ? "" : ",", bench::json_string(timing.name).c_str(), timing.median(),
                  timing.least(), timing.spread());
    std::printf("}}");
  }
  if (asked.json) std::printf("}}\n");
  return EXIT_SUCCESS;
}

// Sliders under a ground that moves with one frequency.
#include <numbers>
#include <string>

#include "support/catch.hpp"
#include "support/motions.hpp"
#include "support/reference.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;

namespace {

constexpr double pi = std::numbers::pi;

HarmonicMotion cycles(double amplitude, double omega, double count, double samples_a_cycle = 64) {
  const double period = 2 * pi / omega;
  return {amplitude, omega, count * period, period / samples_a_cycle};
}

/// Half the way from the lowest to the highest x at the events from a time on.
double amplitude_after(const Response& response, double time) {
  double low = infinity, high = -infinity;
  for (const Event& e : response.events)
    if (e.time >= time) low = std::min(low, e.displacement), high = std::max(high, e.displacement);
  return (high - low) / 2;
}

template <class Visit>
void for_each_slider(Visit&& visit) {
  for (const double frequency : {0.0, 0.8}) {
    visit(Slider(Coulomb(1), frequency));
    visit(Slider(Coulomb(1, 1.5), frequency));
    visit(Slider(Coulomb(1, infinity), frequency));
    visit(Slider(Caster(1, 0.7), frequency));
    visit(Slider(Disguised{1}, frequency));
    visit(Slider(Bump{1, 0.9}, frequency));
  }
}

}  // namespace

TEST_CASE("a block settles into the exact orbit", "[harmonic_motion]") {
  // values.json harm.coulomb.b*; from rest its mean drifts by ever less, but the way between two reversals is soon
  // exact: differences die out by (B - a) / (B + a) a half cycle or sooner. Over 40 events x rounds at 1e-16 of itself.
  for (const auto& orbit : reference::rows("harmonic", "coulomb"))
    for (const double omega : {0.5, 1.0, 20.0}) {
      const double amplitude = orbit["amplitude"], exact = orbit["exact"];
      const bool stops = orbit["stops"].as<bool>();
      INFO("B " << amplitude << ", omega " << omega);
      const Response r = integrate(Coulomb(1), cycles(amplitude, omega, 150));
      const double late = 140 * 2 * pi / omega;
      CHECK(std::abs(amplitude_after(r, late) * omega * omega - exact) <= 1e-12 * exact);
      const auto arrests =
          std::ranges::count_if(r.events, [&](const Event& e) { return e.time > late && e.kind == EventKind::arrest; });
      CHECK(arrests == (stops ? 20 : 0));
    }
}

TEST_CASE("a block on a spring settles into Den Hartog's orbit, or stops twice a cycle or more", "[harmonic_motion]") {
  // values.json harm.coulomb_spring.*: simulated to 1e-8; Den Hartog's to the last digits once 300 cycles are over.
  for (const auto& orbit : reference::rows("harmonic", "spring")) {
    const double amplitude = orbit["amplitude"], omega = orbit["omega"], simulated = orbit["simulated"],
                 den_hartog = orbit["den_hartog"];
    INFO("B " << amplitude << ", omega " << omega);
    const Response r = integrate(Slider(Coulomb(1), std::sqrt(0.5)), cycles(amplitude, omega, 300));
    const double found = amplitude_after(r, 270 * 2 * pi / omega);
    CHECK(std::abs(found - simulated) <= 1e-8);
    if (den_hartog > 0) CHECK(std::abs(found - den_hartog) <= 1e-11 * den_hartog);
  }
}

TEST_CASE("at resonance the amplitude of a block on a spring grows in proportion to time", "[harmonic_motion]") {
  // values.json harm.resonance.b2.0, to 1e-8; ERRATA on the text after (2.48): by (B - 4 a/pi) pi/omega^2 a cycle, once
  // the amplitude is large.
  const HarmonicMotion motion = cycles(2, 1, 405);
  const Response r = integrate(Slider(Coulomb(1), 1.0), motion);
  const auto peak_at = [&](int cycle) {
    double peak = 0;
    for (const Event& e : r.events)
      if (std::abs(e.time / (2 * pi) - cycle) < 0.6) peak = std::max(peak, std::abs(e.displacement));
    return peak;
  };
  for (const auto& resonant : reference::rows("harmonic", "resonance")) {
    // which of the half cycles next to it is meant the reference does not say: one adds half a cycle's growth
    CHECK(std::abs(peak_at(resonant["cycle"].as<int>()) - resonant["peak"]) <= 1.2);
  }
  CHECK(std::abs((peak_at(400) - peak_at(200)) / 200 - (2 - 4 / pi) * pi) <= 1e-4);
  // Below 4 a/pi it stays bounded, 0.1638 at B/a = 1.2 (ERRATA 2.3.2).
  CHECK(std::abs(integrate(Slider(Coulomb(1), 1.0), cycles(1.2, 1, 200)).peak - 0.1638) <= 5e-5);
}

TEST_CASE("a caster at rest in the middle comes to where the reference does", "[harmonic_motion]") {
  // values.json harm.caster.*, from_rest_at_zero: after 200 cycles, to 1e-8. One drifts away without bound, one is
  // caught.
  const auto end = [](double load, double omega) { return integrate(Caster(1, 1), cycles(load, omega, 200)); };
  CHECK(std::abs(end(1.25, 0.3).residual + 6187.37033885485) <= 1e-8 * 6187);
  CHECK(std::abs(end(1.25, 0.5).residual + 4.522536180539736) <= 1e-8);
  CHECK(std::abs(end(1.25, 0.7).residual + 0.22138711296055794) <= 1e-8);
  CHECK(std::abs(end(1.25, 0.75).residual + 0.1831675342805871) <= 1e-8);
}

TEST_CASE("a ground that never outgrows the slip level moves nothing, were it as strong", "[harmonic_motion]") {
  for (const double amplitude : {1e-3, 0.999, 1.0}) {
    for_each_slider([&](const auto& slider) {
      const Response r = integrate(slider, cycles(amplitude, 1.3, 50));
      CHECK(r.peak == 0);
      CHECK(r.events.size() == 1);
    });
  }
  // By an ulp stronger, it creeps.
  const double omega = 1.3, above = 1 + 0x1p-52;
  const Response r = integrate(Coulomb(1), cycles(above, omega, 50));
  CHECK(count(r.events).breakaways > 0);
  CHECK(r.peak <= 1e-20);
  // One way only where the other holds.
  const Response one_way = integrate(Coulomb(1, 2), cycles(1.5, 1, 10));
  CHECK(std::ranges::is_sorted(one_way.displacement));
  CHECK(one_way.residual > 0);
}

TEST_CASE("a block moves as its cubic's like with a cosine says", "[harmonic_motion]") {
  // From rest at t = 0 with B = 3, a = 1: v = 3 sin t - t until it stops at t0, sin t0 = t0 / 3.
  const Response r = integrate(Coulomb(1), cycles(3, 1, 0.3, 200));
  bool same = true;
  for (std::size_t i = 0; i < r.velocity.size(); ++i) {
    const double t = cycles(3, 1, 0.3, 200).time(i);
    same = same && std::abs(r.velocity[i] - (3 * std::sin(t) - t)) <= 1e-15 * 3;
    same = same && std::abs(r.displacement[i] - (6 * std::sin(t / 2) * std::sin(t / 2) - t * t / 2)) <= 2e-15 * 3;
  }
  CHECK(same);
  const Response whole = integrate(Coulomb(1), cycles(3, 1, 1, 1));
  const double stop = whole.events[1].time;
  CHECK(std::abs(std::sin(stop) - stop / 3) <= 1e-15);
  CHECK(whole.events[1].kind == EventKind::reversal);
}

TEST_CASE("without friction a spring rings as the linear oscillator, through resonance", "[harmonic_motion]") {
  // x = B (cos wt - cos wn t) / (wn^2 - w^2) = B sin(s t) sin(d t) / (2 s d), s, d = (wn +- w)/2, from rest. Each of 64
  // steps a cycle rounds x and v/w by a few 1e-16 of the largest.
  const double omega = 1.3, amplitude = 0.7;
  for (const double ratio : {0.0, 1e-3, 0.4, 0.999, 1 - 1e-8, 1 - 1e-15, 1.0, 1 + 1e-12, 1.01, 3.0, 40.0}) {
    INFO("wn / omega " << ratio);
    const double wn = ratio * omega, s = (wn + omega) / 2, d = (wn - omega) / 2;
    const HarmonicMotion motion = cycles(amplitude, omega, 20, 16);
    const Response r = integrate(Slider(Coulomb(0), wn), motion);
    double error = 0;
    for (std::size_t i = 0; i < motion.samples(); ++i) {
      const double t = motion.time(i), beat = d == 0 ? t : std::sin(d * t) / d;
      error = std::max(error, std::abs(r.displacement[i] - amplitude * std::sin(s * t) * beat / (2 * s)));
    }
    CHECK(error <= 20 * 16 * 1e-15 * std::max(1.0, ratio / 4) * r.peak);
    CHECK(std::abs(r.energy.imbalance()) <= 1e-13 * amplitude * r.sliding_distance);
  }
}

TEST_CASE("the sampling of a motion does not change it", "[harmonic_motion]") {
  for_each_slider([](const auto& slider) {
    const Response fine = integrate(slider, cycles(1.7, 1.3, 12, 64), from(0.1, 0.2));
    for (const double samples : {1.0 / 12, 0.3, 1.0, 7.3, 300.0}) {
      const Response r = integrate(slider, cycles(1.7, 1.3, 12, samples), from(0.1, 0.2));
      INFO(samples << " samples a cycle");
      // a few roundings of x in each of some thousand steps; casters may double differences at some events
      CHECK(std::abs(r.residual - fine.residual) <= 1e-12 * fine.peak);
      CHECK(std::abs(r.peak - fine.peak) <= 1e-12 * fine.peak);
      CHECK(count(r.events) == count(fine.events));
      CHECK(std::abs(r.energy.input - fine.energy.input) <= 1e-12 * fine.energy.input);
      CHECK(std::abs(r.time_sliding - fine.time_sliding) <= 1e-12 * fine.time_sliding);
    }
  });
}

TEST_CASE("the energy ledger closes under a harmonic motion", "[harmonic_motion]") {
  for_each_slider([](const auto& slider) {
    for (const double amplitude : {1.1, 1.9, 6.0})
      for (const double omega : {0.2, 0.8, 5.0}) {
        const Response r = integrate(slider, cycles(amplitude, omega, 20), from(0.3, 0.5));
        INFO("B " << amplitude << ", omega " << omega);
        // an escaped caster is no longer braked: energy flows back and forth between it and the ground
        CHECK(std::abs(r.energy.imbalance()) <= 1e-13 * amplitude * r.sliding_distance);
        CHECK(grammatical(r));
        CHECK(r.peak >= largest(r.displacement) * (1 - 1e-15));
      }
  });
}

TEST_CASE("a law that hides that it is constant slides alike", "[harmonic_motion]") {
  // The Taylor flow against the closed form, without a spring.
  for (const double amplitude : {1.05, 1.5, 1.9, 5.0})
    for (const double dt : {1.0, 64.0}) {
      const HarmonicMotion motion = cycles(amplitude, 0.7, 30, dt);
      const Response block = integrate(Coulomb(1), motion), taylor = integrate(Disguised{1}, motion);
      CHECK(difference(block.displacement, taylor.displacement) <= 1e-12 * block.peak);
      CHECK(count(block.events) == count(taylor.events));
    }
}

TEST_CASE("straight lines between ever finer samples come to the same motion, by the square of the step",
          "[harmonic_motion]") {
  for_each_slider([](const auto& slider) {
    const HarmonicMotion motion = cycles(1.7, 1.3, 3);
    const Response exact = integrate(slider, motion, from(0.1));
    const auto error = [&](double samples_a_cycle) {
      return std::abs(integrate(slider, motion.sampled(motion.period() / samples_a_cycle), from(0.1)).residual -
                      exact.residual);
    };
    const double coarse = error(400), fine = error(1600);
    CHECK(fine <= 1e-4 * exact.peak);
    CHECK(std::abs(coarse / fine - 16) <= 1.6);  // up to terms of a higher order
  });
}

TEST_CASE("a stronger and slower ground on a stronger friction moves farther in proportion", "[harmonic_motion]") {
  // x scales with B / omega^2; powers of two leave every bit.
  for (const double strong : {4.0, 0x1p-80})
    for (const double slow : {2.0, 0x1p-40}) {
      const double far = strong * slow * slow;
      const HarmonicMotion one(1.7, 1.3, 50, 0.25), other(1.7 * strong, 1.3 / slow, 50 * slow, 0.25 * slow);
      const auto same = [&](const Response& a, const Response& b) {
        bool equal = a.events.size() == b.events.size();
        for (std::size_t i = 0; i < a.displacement.size(); ++i)
          equal = equal && b.displacement[i] == far * a.displacement[i];
        CHECK(equal);
      };
      same(integrate(Coulomb(1, 1.2), one), integrate(Coulomb(strong, 1.2 * strong), other));
      same(integrate(Slider(Coulomb(1), 0.5), one), integrate(Slider(Coulomb(strong), 0.5 / slow), other));
      same(integrate(Slider(Caster(1, 2), 0.5), one), integrate(Slider(Caster(strong, 2 * far), 0.5 / slow), other));
    }
}

TEST_CASE("half a period later the mirrored ground moves a slider the mirrored way", "[harmonic_motion]") {
  // From the state that it has half a period on, mirrored, it goes the same way: the states are rounded in between.
  for (const double frequency : {0.0, 0.8}) {
    const auto mirrors = [&](const auto& slider) {
      State one = State::at(0.2, 0.4), other = State::at(-0.2, -0.4);
      const double half = pi / 1.3;
      for (int i = 0; i < 8; ++i) {
        advance(slider, HarmonicSegment{half, 1.8, 1.3, i % 2 * pi}, one);
        advance(slider, HarmonicSegment{half, 1.8, 1.3, (i + 1) % 2 * pi}, other);
      }
      CHECK(std::abs(one.displacement + other.displacement) <= 1e-13);
      CHECK(std::abs(one.velocity + other.velocity) <= 1e-13);
    };
    mirrors(Slider(Coulomb(1), frequency));
    mirrors(Slider(Caster(1, 0.7), frequency));
  }
}

TEST_CASE("a hundred thousand cycles later the phase is still right", "[harmonic_motion]") {
  // Two stops per cycle: the past is forgotten, and the sliding distance of a cycle is the same to its rounding.
  // Two stops a cycle: each slip breaks away where B cos(omega t) is the slip level, and whatever was before is
  // forgotten. Only the rounding of the time itself, 6e-11 s, remains.
  const HarmonicMotion motion = cycles(1.5, 1.7, 1e5, 0.01);
  const Response r = integrate(Coulomb(1), motion);
  CHECK(count(r.events).breakaways == 200'001);
  CHECK(count(r.events).arrests == 200'000);
  double error = 0;
  for (std::size_t i = r.events.size() - 40; i < r.events.size(); ++i)
    if (r.events[i].kind == EventKind::breakaway)
      error = std::max(error, std::abs(std::abs(motion.acceleration(r.events[i].time)) - 1));
  CHECK(error <= 6e-11 * 1.7 * 1.5);
  const double late = amplitude_after(r, motion.duration() - 5 * motion.period());
  const double early = amplitude_after(integrate(Coulomb(1), cycles(1.5, 1.7, 10)), 5 * motion.period());
  CHECK(std::abs(late - early) <= 1e-15 * r.peak + 1e-14 * early);

  for (const double t : {0.1, 1e3, 1e6, 1e9}) {
    const long double exact = std::remainder(static_cast<long double>(1.7) * t, 2 * std::numbers::pi_v<long double>);
    // 4e-16 from the phase itself, and the error of a 64-bit pi after this many cycles
    CHECK(std::abs(static_cast<double>(motion.phase(t) - exact)) <= 4e-16 + 1e-19 * 1.7 * t);
  }
}

TEST_CASE("after the end a slider settles", "[harmonic_motion][settle]") {
  const HarmonicMotion motion = cycles(3, 1, 2.2);
  const Response plain = integrate(Coulomb(1), motion), settled = integrate(Coulomb(1), motion, from(0, 0, true));
  REQUIRE(settled.displacement.size() > plain.displacement.size());
  CHECK(std::equal(plain.displacement.begin(), plain.displacement.end(), settled.displacement.begin()));
  CHECK(settled.displacement.back() == settled.residual);
  CHECK(motion.time(settled.displacement.size() - 1) >= settled.events.back().time);
  CHECK(motion.time(settled.displacement.size() - 2) < settled.events.back().time);
  const double v = plain.state.velocity;
  CHECK(std::abs(settled.residual - (plain.residual + v * std::abs(v) / 2)) <= 1e-14);
  CHECK(settled.state.mode == Mode::stuck);
  CHECK(integrate(Slider(Coulomb(1), 0.8), motion, from(0, 0, true)).state.mode == Mode::stuck);
}

TEST_CASE("a harmonic motion has its samples", "[harmonic_motion]") {
  const HarmonicMotion usual(2, pi, 10);
  CHECK(usual.period() == 2);
  CHECK(usual.dt() == 2.0 / 64);
  CHECK(usual.samples() == 321);
  CHECK(usual.time(0) == 0);
  CHECK(usual.time(320) == 10);
  const HarmonicMotion odd(2, pi, 10, 3);
  CHECK(odd.samples() == 5);
  CHECK(odd.time(3) == 9);
  CHECK(odd.time(4) == 10);
  CHECK(HarmonicMotion(2, pi, 10, 40).samples() == 2);
  CHECK(odd.acceleration(0) == -2);
  CHECK(odd.acceleration(1) == 2);
  const GroundMotion sampled = odd.sampled(0.5);
  CHECK(sampled.samples() == 21);
  CHECK(sampled.acceleration()[4] == -2);
}

TEST_CASE("a harmonic motion names the arguments that it rejects", "[harmonic_motion][errors]") {
  CHECK_THROWS_WITH(HarmonicMotion(0, 1, 1),
                    "HarmonicMotion: amplitude must be positive and at most 1e100 m/s^2, got 0 m/s^2");
  CHECK_THROWS_WITH(HarmonicMotion(1, -2, 1),
                    "HarmonicMotion: omega must be positive, its square and its period finite, got -2 rad/s");
  CHECK_THROWS_WITH(HarmonicMotion(1, 2, 0), "HarmonicMotion: duration must be positive and finite, got 0 s");
  CHECK_THROWS_WITH(HarmonicMotion(1, 2, 3, 0), "HarmonicMotion: dt must be positive and finite, got 0 s");
  CHECK_THROWS_WITH(HarmonicMotion(1, 2, 3, 1e-12), ContainsSubstring("at most 2^40 samples"));
  for (const double bad : {not_a_number, infinity, -1.0, 0.0, -infinity}) {
    CHECK_THROWS_AS(HarmonicMotion(bad, 1, 1), std::invalid_argument);
    CHECK_THROWS_AS(HarmonicMotion(1, bad, 1), std::invalid_argument);
    CHECK_THROWS_AS(HarmonicMotion(1, 1, bad), std::invalid_argument);
    CHECK_THROWS_AS(HarmonicMotion(1, 1, 1, bad), std::invalid_argument);
    CHECK_THROWS_AS(HarmonicMotion(1, 1, 1).sampled(bad), std::invalid_argument);
  }
  CHECK_THROWS_AS(HarmonicMotion(1, 1e200, 1), std::invalid_argument);
  CHECK_THROWS_AS(HarmonicMotion(1, 1e10, 1e10), std::invalid_argument);
}

TEST_CASE("a progress callback is felt in a long harmonic motion, were it of one sample", "[harmonic_motion]") {
  IntegrateOptions options;
  int calls = 0;
  options.progress = [&] {
    if (++calls == 3) throw std::runtime_error("enough");
  };
  for (const double samples : {8.0, 1e-9}) {
    calls = 0;
    CHECK_THROWS_WITH(integrate(Coulomb(1), cycles(0.5, 1, 1e5, samples), options), "enough");
    calls = 0;
    CHECK_THROWS_WITH(integrate(Slider(Coulomb(1), 50), cycles(3, 0.01, 1e5, samples), options), "enough");
  }
}

TEST_CASE("tiny and huge harmonic motions are right or refused", "[harmonic_motion][range]") {
  const auto right_or_refused = [](const auto& slider, const HarmonicMotion& motion) {
    try {
      const Response r = integrate(slider, motion);
      CHECK(std::isfinite(r.peak));
      CHECK(std::isfinite(largest(r.displacement)));
      CHECK(std::abs(r.energy.imbalance()) <= 1e-12 * motion.amplitude() * r.sliding_distance + 1e-300);
    } catch (const std::overflow_error& error) {
      CHECK_THAT(error.what(), ContainsSubstring("range of doubles"));
    } catch (const ConvergenceError& error) {
      CHECK_THAT(error.what(), ContainsSubstring("power series"));
    }
  };
  for (const double amplitude : {1e100, 1.5, 1e-100, 1e-280})
    for (const double omega : {1e150, 1e60, 1e-60, 1e-150}) {
      INFO("B " << amplitude << ", omega " << omega);
      const HarmonicMotion motion = cycles(amplitude, omega, 5, 10);
      for (const double level : {0.0, 0.5, 1.0, 3.0}) {
        right_or_refused(Slider(Coulomb(level * amplitude)), motion);
        right_or_refused(Slider(Coulomb(level), omega / 3), motion);
        right_or_refused(Slider(Caster(level * amplitude, 1)), motion);
      }
    }
}

#include "stickslip/ensemble/detail/describe.hpp"

#include <array>
#include <bit>

#include "base/json.hpp"

namespace stickslip::detail {
std::string parameters(const Coulomb& law) {
  return "\"law\": \"Coulomb\", \"slip_level\": " + json(law.forward()) + ", \"backward\": " + json(law.backward());
}

std::string parameters(const Caster& law) {
  return "\"law\": \"Caster\", \"slip_level\": " + json(law.slip_level()) + ", \"reach\": " + json(law.reach()) +
         (law.rolling() > 0 ? ", \"rolling\": " + json(law.rolling()) : "");
}

std::string parameters(const VelocityDependent& law) {
  return "\"law\": \"VelocityDependent\", \"slow\": " + json(law.slow()) + ", \"fast\": " + json(law.fast()) +
         ", \"rate\": " + json(law.rate());
}

std::string parameters(const Stribeck& law) {
  return "\"law\": \"Stribeck\", \"static\": " + json(law.static_level()) +
         ", \"kinetic\": " + json(law.kinetic_level()) + ", \"velocity\": " + json(law.velocity()) +
         ", \"exponent\": " + std::to_string(law.exponent());
}

std::string parameters(const Degrading& law) {
  return "\"law\": \"Degrading\", \"distances\": " + json(law.distances()) + ", \"levels\": " + json(law.levels()) +
         ", \"backward\": " + json(law.backward());
}

std::string parameters(const KumarFriction& law) {
  const KumarFriction::Parameters& p = law.parameters();
  return "\"law\": \"KumarFriction\", \"mu_ref\": " + json(p.mu_ref) +
         ", \"static_pressure\": " + json(p.static_pressure) +
         ", \"reference_pressure\": " + json(p.reference_pressure) + ", \"contact_radius\": " + json(p.contact_radius) +
         ", \"temperature\": " + json(p.temperature) + ", \"rate\": " + json(p.rate) +
         ", \"diffusivity\": " + json(p.diffusivity) + ", \"conductivity\": " + json(p.conductivity);
}

std::string parameters(const FunctionLaw& law) { return parameters("FunctionLaw", some_levels(law)); }

std::string parameters_of_static(const std::string& sliding, double forward, double backward) {
  return "\"static\": " + json(std::array{forward, backward}) + ", " + sliding;
}

std::string parameters(const char* type, std::span<const double> levels) {
  return std::string("\"law\": \"") + type + "\", \"levels\": " + json(levels);
}

std::string describe(const std::string& law, const Mounting& mounting) {
  const Stops& stops = mounting.stops;
  return "{" + law + ", \"natural_frequency\": " + json(mounting.natural_frequency) +
         (mounting.damping > 0 ? ", \"damping\": " + json(mounting.damping) : "") +
         (mounting.pendulum ? ", \"pendulum\": true" : "") +
         (mounting.slope_degrees > 0 ? ", \"slope_degrees\": " + json(mounting.slope_degrees) : "") +
         (mounting.one_way ? ", \"one_way\": true" : "") +
         (stops ? ", \"stops\": " + json(std::array{stops.forward(), stops.backward(), stops.restitution()}) : "") +
         "}";
}

namespace {

// A 64-bit digest, word by word; each word is mixed as in splitmix64 (Steele, Lea and Flood 2014).
class Digest {
 public:
  void add(std::uint64_t word) noexcept {
    std::uint64_t z = (hash_ ^ word) + 0x9e3779b97f4a7c15U;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    hash_ = z ^ (z >> 31);
  }
  void add(double value) noexcept { add(std::bit_cast<std::uint64_t>(value)); }

  std::string text() const {
    std::string digits;
    for (int shift = 60; shift >= 0; shift -= 4) digits += "0123456789abcdef"[(hash_ >> shift) & 15];
    return digits;
  }

 private:
  std::uint64_t hash_ = 0;
};

}  // namespace

std::string describe_list(const std::vector<std::string>& sliders, const char* order) {
  std::string text;
  for (const std::string& slider : sliders) text += (text.empty() ? "" : ", ") + slider;
  return "{\"one_of\": [" + text + "], \"order\": \"" + order + "\"}";
}

std::string describe_list(std::span<const GroundMotion> motions, const char* order) {
  Digest digest;
  for (const GroundMotion& motion : motions) {
    digest.add(std::uint64_t{motion.samples()});
    digest.add(std::uint64_t{motion.interpolation() == Interpolation::constant});
    for (const auto samples : {motion.acceleration(), motion.transverse(), motion.vertical()})
      for (const double acceleration : samples) digest.add(acceleration);
    if (motion.has_transverse() || motion.has_vertical())
      digest.add(std::uint64_t{motion.has_transverse()} + 2 * std::uint64_t{motion.has_vertical()});
    for (std::size_t i = 0; i < motion.segments(); ++i) digest.add(motion.segment(i).duration);
  }
  return "{\"motions\": " + std::to_string(motions.size()) + ", \"digest\": \"" + digest.text() + "\", \"order\": \"" +
         order + "\"}";
}

}  // namespace stickslip::detail

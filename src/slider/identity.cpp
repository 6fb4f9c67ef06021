#include "stickslip/slider/identity.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "base/json.hpp"

namespace stickslip {
namespace detail {

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

std::string member(const char* name, const std::string& value) { return std::string(", \"") + name + "\": " + value; }

}  // namespace

std::string json_member(const char* name, double value) { return member(name, json(value)); }
std::string json_member(const char* name, int value) { return member(name, std::to_string(value)); }
std::string json_member(const char* name, std::span<const double> values) { return member(name, json(values)); }

std::string json_of_static(double forward, double backward) {
  return "\"static\": " + json(std::array{forward, backward}) + ", ";
}

std::string identity(const std::string& law, const Mounting& mounting) {
  const Stops& stops = mounting.stops;
  return "{" + law + ", \"natural_frequency\": " + json(mounting.natural_frequency) +
         (mounting.damping > 0 ? ", \"damping\": " + json(mounting.damping) : "") +
         (mounting.pendulum ? ", \"pendulum\": true" : "") +
         (mounting.slope_degrees > 0 ? ", \"slope_degrees\": " + json(mounting.slope_degrees) : "") +
         (mounting.one_way ? ", \"one_way\": true" : "") +
         (stops ? ", \"stops\": " + json(std::array{stops.forward(), stops.backward(), stops.restitution()}) : "") +
         "}";
}

}  // namespace detail

std::string identity(std::span<const GroundMotion> motions) {
  detail::Digest digest;
  for (const GroundMotion& motion : motions) {
    digest.add(std::uint64_t{motion.samples()});
    digest.add(std::uint64_t{motion.interpolation() == Interpolation::constant});
    for (const auto samples : {motion.acceleration(), motion.transverse(), motion.vertical()})
      for (const double acceleration : samples) digest.add(acceleration);
    if (motion.has_transverse() || motion.has_vertical())
      digest.add(std::uint64_t{motion.has_transverse()} + 2 * std::uint64_t{motion.has_vertical()});
    for (std::size_t i = 0; i < motion.segments(); ++i) digest.add(motion.segment(i).duration);
  }
  return digest.text();
}

}  // namespace stickslip

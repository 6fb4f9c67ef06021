// Random problems, solved by the library and by the header-only core in a code that contracts multiplication and
// addition into one rounding. Compiled against the library, `contraction FILE COUNT` writes the answers to that many
// problems on an axis, and to as many in the plane. Compiled with the headers alone, `contraction FILE` compares
// its own answers with them.
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <exception>
#include <fstream>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include "problems.hpp"
#ifdef STICKSLIP_LIBRARY
#include "stickslip/planar/any_planar_slider.hpp"
#include "stickslip/sliding/any_slider.hpp"
#endif

using namespace contraction;

namespace {

// The displacements at the ends of all segments [m]; in the plane, both components.
using Path = std::vector<double>;

#ifdef STICKSLIP_LIBRARY
template <class Law>
AnySlider integrator(const Slider<Law>& slider) {
  if constexpr (std::constructible_from<AnySlider, Slider<Law>>)
    return slider;
  else
    return Slider(FunctionLaw([law = slider.law()](double x, double v, Direction to) { return law.resist(x, v, to); }),
                  slider.mounting());
}
template <class Law>
AnyPlanarSlider integrator(const PlanarSlider<Law>& slider) {
  return slider;
}
template <class Any, class AnySegment, class AnyState>
void move(const Any& slider, const AnySegment& segment, AnyState& state, Contact contact) {
  advance(slider, segment, state, contact);
}
#else
template <class Of>
const Of& integrator(const Of& slider) {
  return slider;
}
template <class Of, class AnySegment, class AnyState>
void move(const Of& slider, const AnySegment& segment, AnyState& state, Contact contact) {
  advance(slider, segment, state, {}, contact);
}
#endif

PlanarState start_of(const auto& slider) requires requires { slider.along_axis(); }
{ return {}; }
State start_of(const auto&) { return {}; }

LoadSegment segment_of(const Ground& g, std::size_t i, double slope, const State&) {
  return detail::load_segment(Segment{g.dt, g.along[i], g.along[i + 1]}, slope, g.upward(i), g.upward(i + 1));
}
PlanarLoadSegment segment_of(const Ground& g, std::size_t i, double slope, const PlanarState&) {
  return detail::load_segment(PlanarSegment{g.dt, {g.along[i], g.across[i]}, {g.along[i + 1], g.across[i + 1]}}, slope,
                              g.upward(i), g.upward(i + 1));
}
void append(Path& path, double displacement) { path.push_back(displacement); }
void append(Path& path, Vector2 displacement) { path.insert(path.end(), {displacement.axis, displacement.transverse}); }

/// @param cut  a part of each segment, after which it is continued by another call
template <class Of>
Path path_of(const Problem<Of>& problem, const Ground& ground, double cut = 0) {
  const auto& slider = integrator(problem.slider);
  auto state = start_of(problem.slider);
  Path path;
  for (std::size_t i = 0; i + 1 < ground.along.size(); ++i) {
    auto segment = segment_of(ground, i, problem.slider.slope(), state);
    const double time = cut * segment.duration;
    if (cut > 0) move(slider, detail::take(segment, time, segment.normal(time)), state, problem.contact);
    move(slider, segment, state, problem.contact);
    append(path, state.displacement);
  }
  return path;
}

double difference(const Path& one, const Path& other, double factor = 1) {
  double result = 0;
  for (std::size_t i = 0; i < one.size(); ++i) result = std::max(result, std::abs(one[i] - factor * other[i]));
  return result;
}

#ifdef STICKSLIP_LIBRARY

double largest(const Path& path) {
  double result = 0;
  for (const double x : path) result = std::max(result, std::abs(x));
  return result;
}

// The same ground, but for some round-off.
Ground shaken(Ground ground, Random& random) {
  for (auto* values : {&ground.along, &ground.across, &ground.up})
    for (double& value : *values) value *= 1 + 0x1p-48 * random.uniform(-1, 1);
  return ground;
}

// The path, and how well it is determined: by the accuracy of its law, and by what round-off of the ground makes of it.
template <class Of>
void write(std::ostream& to, char kind, std::uint64_t number, const Problem<Of>& problem) {
  const Path path = path_of(problem, problem.ground);
  Random random(number);
  double unknown = problem.accuracy * largest(path);
  for (int i = 0; i < 3; ++i)
    unknown = std::max(unknown, difference(path, path_of(problem, shaken(problem.ground, random))));
  to << kind << ' ' << number << ' ' << path.size() << ' ' << 32 * unknown;
  for (const double x : path) to << ' ' << x;
  to << '\n';
}

#else

Ground mirrored(Ground ground) {
  for (auto* values : {&ground.along, &ground.across})
    for (double& value : *values) value = -value;
  return ground;
}

// What is wrong; empty if nothing is.
template <class Of>
std::string wrong(const Problem<Of>& problem, const Path& expected, double tolerance) {
  const auto differs = [&](const char* what, const Path& path, double factor = 1) {
    const double by = difference(expected, path, factor);
    return by <= tolerance ? std::string() : std::string(what) + " differs by " + std::to_string(by) + " m; ";
  };
  std::string found = differs("the path", path_of(problem, problem.ground)) +
                      differs("the path in parts of segments", path_of(problem, problem.ground, 0.375));
  if (problem.symmetric) found += differs("the mirror image", path_of(problem, mirrored(problem.ground)), -1);
  const Energy e =
      integrate(problem.slider, problem.ground.motion(), {.contact = problem.contact, .may_end_in_flight = true})
          .energy;
  const double turnover = std::max({std::abs(e.input), e.dissipated, e.kinetic, e.elastic});
  if (!(std::abs(e.imbalance()) <= 8 * problem.accuracy * turnover))
    found += "energies of " + std::to_string(turnover) + " do not balance by " + std::to_string(e.imbalance()) + "; ";
  return found;
}

#endif

template <class Work>
void with_problem(char kind, std::uint64_t number, Work&& work) {
  if (kind == 'a')
    with_axis_problem(number, work);
  else
    with_planar_problem(number, work);
}

}  // namespace

#ifdef STICKSLIP_LIBRARY

int main(int, char** words) {
  std::ofstream file(words[1]);
  file.precision(std::numeric_limits<double>::max_digits10);
  int failures = 0;
  for (const char kind : {'a', 'p'})
    for (std::uint64_t number = 0; number < std::stoull(words[2]); ++number)
      with_problem(kind, number, [&](const auto& problem) {
        try {
          write(file, kind, number, problem);
        } catch (const std::exception& error) {
          std::cout << "problem " << kind << number << ": " << error.what() << std::endl;
          ++failures;
        }
      });
  return file.good() && failures == 0 ? 0 : 1;
}

#else

int main(int, char** words) {
#if defined(__AVX2__) && defined(__FMA__)
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma"))
    return std::cout << "skipped: this processor has no AVX2 or no FMA\n", 0;
#endif
  std::ifstream file(words[1]);
  char kind;
  std::uint64_t number;
  std::size_t size;
  double tolerance;
  int problems = 0, failures = 0;
  for (; file >> kind >> number >> size >> tolerance; ++problems) {
    Path expected(size);
    for (double& x : expected) file >> x;
    std::string found;
    with_problem(kind, number, [&](const auto& problem) {
      try {
        found = wrong(problem, expected, tolerance);
      } catch (const std::exception& error) {
        found = error.what();
      }
    });
    if (found.empty()) continue;
    std::cout << "problem " << kind << number << ": " << found << std::endl;
    ++failures;
  }
  std::cout << problems << " problems, " << failures << " failures\n";
  return problems > 0 && failures == 0 ? 0 : 1;
}

#endif

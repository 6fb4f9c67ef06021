// A friction pendulum with several sliding surfaces.
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/base/parts.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/state/pendulum_memory.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip {

/// A friction pendulum isolator with several spherical surfaces, in one horizontal direction. It is a series of
/// massless elements that carry the same force F. With phi = F/N, element k slides while
///     phi = u_k / R_k +- mu_k,   |u_k| <= d_k,   x = sum of u_k,
/// and stays where phi lies between: rigid-plastic friction beside a spring that the weight makes, between two stops.
/// All forces are proportional to N, so that phi depends on the path of x alone (Prandtl and Ishlinskii: a sum of plays
/// with stops). No element is elastic, so a bearing at rest holds any force between
///     lo = max (u_k / R_k - mu_k)  and  up = min (u_k / R_k + mu_k)
/// over the elements that are not at the stop in that direction.
///
/// As a friction law its resistance grows with the distance by N / (sum of the R of the elements that move), from one
/// change to the next: where another element joins, and where one reaches its stop. It may be negative, because it
/// contains the springs of the elements. The work that does not go into them is dissipated.
///
/// A bearing of nested surfaces, such as a triple pendulum, is not the series of its surfaces. Each half, below and
/// above the innermost slider, has the elements of radius R_k - R_(k+1), counted from the outermost surface inward,
/// with the coefficient mu_k and the capacity (R_k - R_(k+1)) (d_1/R_1 + .. + d_k/R_k).
///
/// Sources: Fenz and Constantinou, Earthquake Spectra 24 (2008), doi 10.1193/1.2982531; Visintin, Differential Models
/// of Hysteresis (1994). Docs: pendulums.md.
class MultiPendulum {
 public:
  struct Element {
    double radius, mu, capacity;
  };

  /// @param radii        effective radii [m], positive: the radius of the surface minus the height of the pivot.
  ///                     Infinite, in a series: a flat surface. Up to 8 elements
  /// @param mu           coefficients of friction, positive and finite
  /// @param capacities   largest displacements of each surface [m], positive; infinite: no stop
  /// @param restitution  of the impact where all elements are at their stops, from 0 to 1
  /// @param nested       whether the radii are those of nested surfaces, from the innermost outward: inner (which
  ///                     occurs twice), lower, upper (, lower, upper). Otherwise they are the elements, from bottom to
  ///                     top
  /// @throws std::invalid_argument naming the value; if a list has another length; in a nested bearing, if an inner
  ///         surface would have to slide after an outer one, or would reach its stop before
  MultiPendulum(std::vector<double> radii, std::vector<double> mu, std::vector<double> capacities,
                double restitution = 0, bool nested = false)
      : radii_(std::move(radii)),
        mu_(std::move(mu)),
        capacities_(std::move(capacities)),
        restitution_(restitution),
        nested_(nested) {
    check();
    if (!nested_) {
      for (std::size_t k = 0; k < radii_.size(); ++k) elements_.push_back({radii_[k], mu_[k], capacities_[k]});
    } else {
      // The innermost pair first, then outward.
      for (std::size_t ring = 0; ring <= radii_.size() / 2; ++ring)
        for (const std::size_t half : {std::size_t{0}, std::size_t{1}}) elements_.push_back(of_half(ring, half));
    }
    for (unsigned moving = 0; moving <= all(); ++moving) together_.push_back(of_moving(moving));
    for (const Element& element : elements_)
      if (element.radius < infinite) push_ = std::max(push_, standard_gravity * (element.capacity / element.radius));
  }

  const std::vector<double>& radii() const noexcept { return radii_; }
  const std::vector<double>& mu() const noexcept { return mu_; }
  const std::vector<double>& capacities() const noexcept { return capacities_; }
  double restitution() const noexcept { return restitution_; }
  bool nested() const noexcept { return nested_; }
  const std::vector<Element>& elements() const noexcept { return elements_; }
  /// By how much the elements change if each surface, in the order of `radii`, changes by a little.
  std::vector<Element> change_of_elements(std::span<const Element> of_surfaces) const {
    if (!nested_) return {of_surfaces.begin(), of_surfaces.end()};
    std::vector<Element> changes;
    for (std::size_t ring = 0; ring <= radii_.size() / 2; ++ring)
      for (const std::size_t half : {std::size_t{0}, std::size_t{1}}) {
        const Element element = of_half(ring, half);
        Element change = of_surfaces[surface(ring, half)];
        if (ring > 0) change.radius -= of_surfaces[surface(ring - 1, half)].radius;
        change.capacity = 0;  // of an element without a stop
        if (element.capacity < infinite) {
          double turns = 0;
          for (std::size_t i = ring; i <= radii_.size() / 2; ++i) {
            const std::size_t one = surface(i, half);
            turns +=
                (of_surfaces[one].capacity - capacities_[one] / radii_[one] * of_surfaces[one].radius) / radii_[one];
          }
          change.capacity = change.radius * (element.capacity / element.radius) + element.radius * turns;
        }
        changes.push_back(change);
      }
    return changes;
  }
  int count() const noexcept { return static_cast<int>(elements_.size()); }
  /// Largest displacement of the bearing [m].
  double capacity() const noexcept {
    double sum = 0;
    for (const Element& element : elements_) sum += element.capacity;
    return sum;
  }

  static constexpr bool symmetric = true;
  static constexpr const char* class_name = "MultiPendulum";
  static constexpr auto parts() {
    return std::tuple(Part{"radii", &MultiPendulum::radii, "R_k", "m", Range::above(0).or_infinite()},
                      Part{"mu", &MultiPendulum::mu, "mu_k", "", Range::above(0)},
                      Part{"capacities", &MultiPendulum::capacities, "d_k", "m", Range::above(0).or_infinite()},
                      Part{"restitution", &MultiPendulum::restitution, "", "", Range::between(0, 1)},
                      Part{"nested", &MultiPendulum::nested, "", "", Range::between(0, 1), Listed::unless_zero});
  }

  /// The law up to the next change, for a motion in either direction from a given state.
  class Piece {
   public:
    template <class T>
    auto resist(const T& x, Direction direction) const {
      const Line& line = of(direction);
      return line.level + (sign(direction) * line.slope) * (x - from_);
    }
    /// The part of it that dissipates [m/s^2].
    template <class T>
    double friction(const T&, Direction direction) const noexcept {
      return of(direction).friction;
    }
    /// The derivative of the resistance with respect to the distance [1/s^2].
    double slope(Direction direction) const noexcept { return of(direction).slope; }

   private:
    friend class MultiPendulum;
    struct Line {
      double level, slope, friction;
    };
    const Line& of(Direction direction) const noexcept {
      return direction == Direction::forward ? forward_ : backward_;
    }
    Piece(Line forward, Line backward, double from) : forward_(forward), backward_(backward), from_(from) {}

    Line forward_, backward_;
    double from_;
  };

  Piece at(const State& state) const noexcept {
    return {line(state.pendulum, +1), line(state.pendulum, -1), state.displacement};
  }
  /// The same for a motion in one direction only.
  Piece toward(const State& state, Direction direction) const noexcept {
    const Piece::Line one = line(state.pendulum, step(direction));
    return {one, one, state.displacement};
  }
  /// Distance to the next change [m]. The last stop is not a change of the law: the slider hits it.
  double ahead(const State& state, Direction direction) const noexcept {
    const Change next = change(state.pendulum, branch(state.pendulum, step(direction)), step(direction));
    return next.last ? infinite : next.distance;
  }
  /// A distance in the direction of the mode over which there is no change, for certain [m]; 0 if it is not known.
  double surely_ahead(const State& state) const noexcept {
    const PendulumMemory& memory = state.pendulum;
    const int s = step(direction_of(state.mode));
    const Branch now = branch(memory, s);
    const unsigned others = all() & ~(now.moving | stopped(memory, s));
    double changes = together_[now.moving].stops_at;
    for_each(others, [&](int k) { changes = std::min(changes, threshold(memory, k, s)); });
    // Forces within this of a change may be beyond it.
    const double room = changes - 0x1p-40 * (std::abs(changes) + std::abs(now.force)) - now.force;
    return room > 0 && now.radius < infinite ? room * now.radius : 0;
  }
  void pass(State& state, Direction direction) const noexcept {
    const double distance = ahead(state, direction);
    state.displacement += sign(direction) * distance;
    state.sliding_distance += distance;
    move(state.pendulum, step(direction), distance);
  }
  /// Moves the memory of a state over a distance in the direction of its mode [m].
  void slide(State& state, double distance) const noexcept {
    state.sliding_distance += distance;
    move(state.pendulum, step(direction_of(state.mode)), distance);
  }
  /// The same over less than the distance `surely_ahead`.
  void slide_surely(State& state, double distance) const noexcept {
    PendulumMemory& memory = state.pendulum;
    const int s = step(direction_of(state.mode));
    const Branch now = branch(memory, s);
    state.sliding_distance += distance;
    const double force = force_beyond(now, distance);
    memory.force = force;
    for_each(now.moving, [&](int k) { memory.place[index(k)] = s * (force - mu_of(k)); });
    if (distance > 0) (s > 0 ? memory.at_backward : memory.at_forward) &= static_cast<std::uint8_t>(~now.moving);
    memory.direction = static_cast<std::int8_t>(s);
    memory.moving = static_cast<std::uint8_t>(now.moving);
  }
  /// Gives a state without memory that of a first motion from the center to its displacement.
  void begin(State& state) const noexcept {
    if (state.pendulum == PendulumMemory{} && !detail::equal(state.displacement, 0))
      move(state.pendulum, state.displacement > 0 ? +1 : -1, std::abs(state.displacement));
  }
  /// Energy in the springs of the elements under the weight, per unit mass [m^2/s^2].
  double elastic(const State& state) const noexcept {
    double sum = 0;
    for (int k = 0; k < count(); ++k)
      if (!flat(k)) sum += radius(k) * state.pendulum.place[index(k)] * state.pendulum.place[index(k)] / 2;
    return standard_gravity * sum;
  }
  /// The largest acceleration that the springs of the elements give under the weight [m/s^2]; infinite without stops.
  double push() const noexcept { return push_; }
  /// Adds the last stop to a mounting.
  /// @throws std::invalid_argument if it has a slope, slides one way, is a pendulum itself, or has stops that lie
  ///         farther away
  template <class Mounting>
  void mount(Mounting& on) const {
    detail::require(detail::equal(on.slope_degrees, 0), "MultiPendulum: slope_degrees must be 0", on.slope_degrees,
                    "degrees");
    if (on.one_way || on.pendulum)
      throw std::invalid_argument(
          std::string("MultiPendulum: ") +
          (on.one_way ? "must slide both ways" : "already is a pendulum: give radii, not a pendulum's frequency"));
    const double most = capacity();
    if (!std::isfinite(most)) return;
    if (!on.stops) {
      on.stops = {most, restitution_};
      return;
    }
    for (const double gap : {on.stops.forward(), on.stops.backward()})
      detail::require(gap <= most,
                      "MultiPendulum: stops must be within its own capacity of " + detail::shortest(most) + " m", gap,
                      "m");
  }

  /// u_k [m].
  double displacement(const PendulumMemory& memory, int k) const noexcept {
    const double most = capacity(k);
    if ((memory.at_forward | memory.at_backward) & bit(k)) return memory.at_forward & bit(k) ? most : -most;
    const double u = (flat(k) ? 1 : radius(k)) * memory.place[index(k)];
    return std::max(-most, std::min(u, most));
  }
  /// The displacements of all elements [m].
  std::vector<double> displacements(const PendulumMemory& memory) const {
    std::vector<double> of(elements_.size());
    for (int k = 0; k < count(); ++k) of[index(k)] = displacement(memory, k);
    return of;
  }
  /// The displacements of the surfaces, from bottom to top, from those of the elements [m].
  std::vector<double> surfaces(std::span<const double> of_elements) const {
    if (!nested_) return {of_elements.begin(), of_elements.end()};
    // Contact k of a half has the absolute angle of its element; a surface turns by the difference to the next outer.
    const std::size_t rings = elements_.size() / 2;
    std::vector<double> of(elements_.size());
    for (const std::size_t half : {std::size_t{0}, std::size_t{1}}) {
      double outer = 0;
      for (std::size_t ring = rings; ring-- > 0;) {
        const std::size_t k = 2 * ring + half;
        const double angle = of_elements[k] / elements_[k].radius;
        of[surface_of(k)] = surface_radius(ring, half) * (angle - outer);
        outer = angle;
      }
    }
    return of;
  }

  /// The place from the bottom of the surface on which element k slides.
  std::size_t surface_of(std::size_t k) const noexcept {
    const std::size_t rings = elements_.size() / 2, ring = k / 2;
    return !nested_ ? k : k % 2 == 0 ? rings - 1 - ring : rings + ring;
  }

  /// The surfaces that slide while elements move, one bit each, from bottom to top. A nested surface turns with the
  /// next outer one while that slides.
  unsigned sliding_surfaces(unsigned moving) const noexcept {
    unsigned sliding = 0;
    for (int k = 0; k < count(); ++k) {
      const bool turns_with = nested_ && k + 2 < count() && (moving & bit(k + 2));
      if ((moving & bit(k)) && !turns_with) sliding |= 1U << surface_of(index(k));
    }
    return sliding;
  }

  /// The elements that move in a direction from a state on, one bit each.
  unsigned moving(const PendulumMemory& memory, Direction direction) const noexcept {
    return branch(memory, step(direction)).moving;
  }
  /// The share of element k in a displacement in which several move.
  double share(unsigned moving, int k) const noexcept { return share_of(together_[moving].radius, moving, k); }

  /// F/N while the bearing moves in a direction, beyond a state.
  double force(const PendulumMemory& memory, Direction direction) const noexcept {
    return step(direction) * branch(memory, step(direction)).force;
  }

  /// The same after a distance up to the next change, before it takes effect.
  double force_after(const PendulumMemory& memory, Direction direction, double distance) const noexcept {
    const Branch now = branch(memory, step(direction));
    return step(direction) * force_beyond(now, distance);
  }

  friend bool operator==(const MultiPendulum& a, const MultiPendulum& b) {
    return a.radii_ == b.radii_ && a.mu_ == b.mu_ && a.capacities_ == b.capacities_ &&
           detail::equal(a.restitution_, b.restitution_) && a.nested_ == b.nested_;
  }

 private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();
  // Distances within this part of each other are one.
  static constexpr double same = 0x1p-44;

  // A motion in a direction s: the force s F/N, the elements that move, and the sum of their radii.
  struct Branch {
    double force;
    unsigned moving;
    double radius;
  };
  // Elements that move together: the sum of their radii, and its inverse; the slope and the friction of a Line; and the
  // force at which the first of them comes to its stop, if none is flat.
  struct Together {
    double radius, rate, slope, friction, stops_at;
  };
  struct Change {
    double distance;  // to it
    bool last;        // whether all elements are then at their stops
  };

  static std::size_t index(int k) noexcept { return static_cast<std::size_t>(k); }
  static constexpr unsigned bit(int k) noexcept { return 1U << static_cast<unsigned>(k); }
  static constexpr int step(Direction direction) noexcept { return direction == Direction::forward ? 1 : -1; }
  unsigned all() const noexcept { return bit(count()) - 1; }
  double radius(int k) const noexcept { return elements_[index(k)].radius; }
  double mu_of(int k) const noexcept { return elements_[index(k)].mu; }
  double capacity(int k) const noexcept { return elements_[index(k)].capacity; }
  bool flat(int k) const noexcept { return !(radius(k) < infinite); }
  static unsigned stopped(const PendulumMemory& memory, int s) noexcept {
    return s > 0 ? memory.at_forward : memory.at_backward;
  }

  double sum_of_radii(unsigned moving) const noexcept {
    double sum = 0;
    for (int k = 0; k < count(); ++k)
      if (moving & bit(k)) sum += radius(k);
    return sum;
  }
  template <class Use>
  static void for_each(unsigned elements, Use&& use) {
    for (; elements != 0; elements &= elements - 1) use(std::countr_zero(elements));
  }
  double force_beyond(const Branch& now, double distance) const noexcept {
    return now.force + distance * together_[now.moving].rate;
  }

  // Of flat elements that move together equal shares are taken; others then stay.
  double share_of(double sum, unsigned moving, int k) const noexcept {
    if (!(moving & bit(k))) return 0;
    if (sum < infinite) return radius(k) / sum;
    if (!flat(k)) return 0;
    int flats = 0;
    for (int i = 0; i < count(); ++i) flats += (moving & bit(i)) && flat(i);
    return 1.0 / flats;
  }

  // s phi at which element k starts to move in direction s.
  double threshold(const PendulumMemory& memory, int k, int s) const noexcept {
    return (flat(k) ? 0 : s * memory.place[index(k)]) + mu_of(k);
  }

  Branch branch(const PendulumMemory& memory, int s) const noexcept {
    if (memory.direction == s && memory.moving != 0) [[likely]]
      return {memory.force, memory.moving, together_[memory.moving].radius};
    return start(memory, s);
  }
  Branch start(const PendulumMemory& memory, int s) const noexcept {
    // Those with the lowest threshold start. Where all are at their stops, the one that leaves first would return last.
    Branch start{infinite, 0, 0};
    const unsigned held = stopped(memory, s);
    if (held != all()) {
      for (int k = 0; k < count(); ++k) {
        if (held & bit(k)) continue;
        const double at = threshold(memory, k, s);
        if (at < start.force)
          start = {at, bit(k), 0};
        else if (detail::equal(at, start.force))
          start.moving |= bit(k);
      }
    } else {
      double leaves = infinite;
      for (int k = 0; k < count(); ++k) {
        const double at = threshold(memory, k, -s);
        if (at > leaves) continue;
        const bool also = detail::equal(at, leaves);
        start.moving = bit(k) | (also ? start.moving : 0);
        start.force = also ? std::min(start.force, threshold(memory, k, s)) : threshold(memory, k, s);
        leaves = at;
      }
    }
    start.radius = together_[start.moving].radius;
    return start;
  }

  double distance_to_join(const PendulumMemory& memory, const Branch& now, int k, int s) const noexcept {
    if ((now.moving | stopped(memory, s)) & bit(k)) return infinite;
    const double rise = threshold(memory, k, s) - now.force;
    return rise > 0 ? rise * now.radius : 0;
  }
  double distance_to_stop(const PendulumMemory& memory, const Branch& now, int k, int s) const noexcept {
    const double part = share_of(now.radius, now.moving, k);
    return part > 0 ? std::max(capacity(k) - s * displacement(memory, k), 0.0) / part : infinite;
  }

  Change change(const PendulumMemory& memory, const Branch& now, int s) const noexcept {
    double nearest = infinite;
    for (int k = 0; k < count(); ++k)
      nearest = std::min(
          nearest, now.moving & bit(k) ? distance_to_stop(memory, now, k, s) : distance_to_join(memory, now, k, s));
    if (!(nearest < infinite)) return {infinite, false};
    unsigned stop = stopped(memory, s);
    if ((stop | now.moving) == all())
      for (int k = 0; k < count(); ++k)
        if (distance_to_stop(memory, now, k, s) <= nearest * (1 + same)) stop |= bit(k);
    return {nearest, stop == all()};
  }

  void move(PendulumMemory& memory, int s, double distance) const noexcept {
    for (;;) {
      const Branch now = branch(memory, s);
      const double nearest = change(memory, now, s).distance;
      if (!(distance >= nearest * (1 - same))) return shift(memory, now, s, distance, -1);
      shift(memory, now, s, nearest, nearest * (1 + same));
      distance -= nearest;
      if (stopped(memory, s) == all() || !(distance > 0)) return;
    }
  }

  // Move over a distance, and change what lies within `reach`.
  void shift(PendulumMemory& memory, const Branch& now, int s, double distance, double reach) const noexcept {
    double force = force_beyond(now, distance);
    unsigned moving = now.moving, stops = 0;
    for (int k = 0; k < count(); ++k) {
      if (distance_to_join(memory, now, k, s) <= reach) {
        moving |= bit(k);
        force = std::max(force, threshold(memory, k, s));
      }
      if (distance_to_stop(memory, now, k, s) <= reach) stops |= bit(k);
    }
    unsigned moved = 0;
    for (int k = 0; k < count(); ++k) {
      const double part = share_of(now.radius, now.moving, k);
      if (!(part > 0)) continue;
      moved |= bit(k);
      double& place = memory.place[index(k)];
      if (stops & bit(k))
        place = s * (flat(k) ? capacity(k) : capacity(k) / radius(k));
      else if (flat(k))
        place += s * part * distance;
      else
        place = s * (force - mu_of(k));
    }
    if (distance > 0) (s > 0 ? memory.at_backward : memory.at_forward) &= static_cast<std::uint8_t>(~moved);
    (s > 0 ? memory.at_forward : memory.at_backward) |= static_cast<std::uint8_t>(stops);
    memory.force = force;
    memory.direction = static_cast<std::int8_t>(s);
    memory.moving = static_cast<std::uint8_t>(moving & ~stops);
  }

  Piece::Line line(const PendulumMemory& memory, int s) const noexcept {
    const Branch now = branch(memory, s);
    const Together& moving = together_[now.moving];
    return {standard_gravity * now.force, moving.slope, moving.friction};
  }

  Together of_moving(unsigned moving) const noexcept {
    const double radius = sum_of_radii(moving);
    double friction = 0, stops_at = infinite;
    for (int k = 0; k < count(); ++k) {
      if (const double part = share_of(radius, moving, k); part > 0) friction += part * mu_of(k);
      if (moving & bit(k)) stops_at = std::min(stops_at, capacity(k) / this->radius(k) + mu_of(k));
    }
    return {radius, radius > 0 ? 1 / radius : 0, standard_gravity / radius, standard_gravity * friction, stops_at};
  }

  // Surface of a ring, counted from inside, in the lower (0) or upper (1) half.
  std::size_t surface(std::size_t ring, std::size_t half) const noexcept { return ring == 0 ? 0 : 2 * ring - 1 + half; }
  double surface_radius(std::size_t ring, std::size_t half) const noexcept { return radii_[surface(ring, half)]; }
  Element of_half(std::size_t ring, std::size_t half) const noexcept {
    const double outer = surface_radius(ring, half), inner = ring > 0 ? surface_radius(ring - 1, half) : 0;
    double turns = 0;
    for (std::size_t i = ring; i <= radii_.size() / 2; ++i)
      turns += capacities_[surface(i, half)] / surface_radius(i, half);
    return {outer - inner, mu_[surface(ring, half)], (outer - inner) * turns};
  }

  static std::string at_index(const char* name, std::size_t i) {
    return std::string("MultiPendulum: ") + name + "[" + std::to_string(i) + "]";
  }
  void check() const;

  std::vector<double> radii_, mu_, capacities_;
  double restitution_;
  bool nested_;
  std::vector<Element> elements_;
  std::vector<Together> together_;  // of each set of elements that may move, by its bits
  double push_ = 0;                 // [m/s^2]
};

inline void MultiPendulum::check() const {
  const bool in_series = !nested_;
  const std::size_t surfaces = radii_.size();
  const std::size_t elements = in_series ? surfaces : surfaces + 1;
  constexpr auto most = static_cast<std::size_t>(PendulumMemory::most_elements);
  if (surfaces == 0 || elements > most || (!in_series && (surfaces < 3 || surfaces % 2 == 0)))
    detail::refuse(std::string("MultiPendulum: radii must hold ") +
                       (in_series ? "1 to " + std::to_string(most) + " elements"
                                  : "3 surfaces (inner, lower, upper), 5 or 7 (from the innermost outward)"),
                   static_cast<double>(surfaces));
  const auto equal_count = [&](const char* name, const std::vector<double>& values) {
    detail::require(values.size() == surfaces,
                    std::string("MultiPendulum: ") + name + " must be as many as radii, " + std::to_string(surfaces),
                    static_cast<double>(values.size()));
  };
  equal_count("mu", mu_);
  equal_count("capacities", capacities_);
  for (std::size_t i = 0; i < surfaces; ++i) {
    detail::require(radii_[i] > 0 && (in_series || std::isfinite(radii_[i])),
                    at_index("radii", i) + (in_series ? " must be positive" : " must be positive and finite"),
                    radii_[i], "m");
    detail::require(mu_[i] > 0 && std::isfinite(mu_[i]), at_index("mu", i) + " must be positive and finite", mu_[i]);
    detail::require(capacities_[i] > 0, at_index("capacities", i) + " must be positive", capacities_[i], "m");
  }
  detail::require(restitution_ >= 0 && restitution_ <= 1, "MultiPendulum: restitution must be from 0 to 1",
                  restitution_);
  if (in_series) return;
  for (const std::size_t half : {std::size_t{0}, std::size_t{1}})
    for (std::size_t ring = 1; ring <= surfaces / 2; ++ring) {
      const std::size_t outer = surface(ring, half), inner = surface(ring - 1, half);
      detail::require(radii_[outer] > radii_[inner],
                      at_index("radii", outer) + " must be larger than that of the next inner surface, " +
                          detail::shortest(radii_[inner]) + " m",
                      radii_[outer], "m");
      detail::require(mu_[outer] >= mu_[inner],
                      at_index("mu", outer) + " must be at least that of the next inner surface, " +
                          detail::shortest(mu_[inner]) + ": else that one slides after it",
                      mu_[outer]);
      const double needed = radii_[inner] * (mu_[outer] - mu_[inner]);
      detail::require(needed <= capacities_[inner],
                      at_index("capacities", inner) + " must be at least radius times difference of mu to the next " +
                          "outer surface, " + detail::shortest(needed) +
                          " m: else it is at its stop before that slides",
                      capacities_[inner], "m");
    }
}

}  // namespace stickslip

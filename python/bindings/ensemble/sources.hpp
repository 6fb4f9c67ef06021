// Sources of the members of an ensemble, given in Python.
#pragma once

#include <atomic>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "bindings.hpp"
#include "drawn.hpp"
#include "excitation/components.hpp"
#include "stickslip/ensemble/detail/block.hpp"
#include "stickslip/ensemble/detail/lanes_simulator.hpp"
#include "stickslip/ensemble/member.hpp"
#include "stickslip/ensemble/one_of.hpp"
#include "stickslip/planar/any_planar_slider.hpp"
#include "stickslip/structure/identity.hpp"
#include "structure/structure.hpp"

namespace stickslip::python {

inline std::string type_of(const py::handle& object) {
  return py::type::of(object).attr("__name__").cast<std::string>();
}

/// A sample that a source in Python was asked for to learn its kind. The run does not ask for it again.
struct FirstSample {
  std::uint64_t seed = 0, member = 0;
  py::object made{};  // null for other objects
};

/// A source written in Python. Threads without the interpreter lock call it, one at a time; after the run has `ended`
/// nobody calls it.
class PythonSource {
 public:
  /// @param expected  the expected type, for the message if it has no `sample` or `configuration`
  PythonSource(const py::object& object, const std::atomic<bool>& ended, std::string expected, FirstSample first = {})
      : expected_(std::move(expected)), sample_(attribute(object, "sample")), first_(std::move(first)), ended_(ended) {
    const py::object configuration = attribute(object, "configuration");
    configuration_ =
        py::isinstance<py::str>(configuration)
            ? configuration.cast<std::string>()
            : py::module_::import("json").attr("dumps")(configuration, py::arg("sort_keys") = true).cast<std::string>();
  }

  const std::string& configuration() const noexcept { return configuration_; }

 protected:
  py::object attribute(const py::object& object, const char* name) const {
    if (!py::hasattr(object, name))
      throw py::type_error("ensemble: " + expected_ + "; " + type_of(object) + " has no " + name);
    return object.attr(name);
  }

  /// Calls `take` with the sample of a member, with the interpreter lock held.
  template <class Take>
  auto ask(std::uint64_t seed, std::uint64_t member, Take&& take) const {
    const std::scoped_lock turn(one_at_a_time_);  // before the interpreter lock, which the holder may release
    if (ended_) throw detail::Block::Stopped{};
    const py::gil_scoped_acquire held;
    if (first_.made && seed == first_.seed && member == first_.member)
      return take(std::exchange(first_.made, py::object()));
    return take(sample_(py::arg("seed") = seed, py::arg("member") = member));
  }

 private:
  std::string expected_;
  py::object sample_;
  mutable FirstSample first_;
  const std::atomic<bool>& ended_;
  mutable std::mutex one_at_a_time_;
  std::string configuration_;
};

/// Ground motions from Python.
class PythonMotions : public PythonSource {
 public:
  PythonMotions(const py::object& object, const std::atomic<bool>& ended)
      : PythonSource(object, ended,
                     "motions must be a GaussianExcitation, PoissonPulses, WithTransverse, WithVertical, GroundMotion, "
                     "a list of GroundMotion, or an object with sample(*, seed, member), duration and configuration") {
    const py::object duration = attribute(object, "duration");
    if (duration.is_none()) return;
    base_ = TimeBase{duration.cast<double>()};
    detail::require(std::isfinite(base_->duration) && base_->duration > 0,
                    "ensemble: the excitation's duration must be positive and finite", base_->duration, "s");
    if (py::hasattr(object, "dt") && !object.attr("dt").is_none()) base_->dt = object.attr("dt").cast<double>();
  }

  GroundMotion sample(std::uint64_t seed, std::uint64_t member) const {
    return ask(seed, member, [&](const py::object& made) {
      if (!py::isinstance<GroundMotion>(made))
        throw py::type_error("ensemble: the excitation's sample must return a GroundMotion, got " + type_of(made));
      auto motion = made.cast<GroundMotion>();
      if (base_ && std::abs(motion.duration() - base_->duration) > 1e-9 * base_->duration)
        throw std::invalid_argument("ensemble: the excitation's motions must last " +
                                    detail::shortest(base_->duration) + " s, its duration; member " +
                                    std::to_string(member) + " lasts " + detail::shortest(motion.duration()) + " s");
      return motion;
    });
  }

  std::optional<TimeBase> time_base() const noexcept { return base_; }

 private:
  std::optional<TimeBase> base_;
};

/// Sliders from Python.
class PythonSliders : public PythonSource {
 public:
  PythonSliders(const py::object& object, const std::atomic<bool>& ended, FirstSample first = {})
      : PythonSource(object, ended,
                     "sliders must be a Slider, a friction law, a list of these, or an object with "
                     "sample(*, seed, member) and configuration, such as Random",
                     std::move(first)) {}

  AnySlider sample(std::uint64_t seed, std::uint64_t member) const {
    return ask(seed, member, [&](const py::object& made) {
      if (auto slider = slider_of(made)) return *std::move(slider);
      throw py::type_error("ensemble: a sample of sliders must be a Slider or a friction law; that of member " +
                           std::to_string(member) + " is of type " + type_of(made));
    });
  }
};

/// What an ensemble can have as members beside sliders on one axis: how an object is read, and its name in messages.
template <class Member>
struct MemberKind;
template <>
struct MemberKind<AnyPlanarSlider> {
  static constexpr const char* noun = "PlanarSlider";
  static std::optional<AnyPlanarSlider> read(const py::handle& object) {
    if (py::isinstance<AnyPlanarSlider>(object)) return object.cast<const AnyPlanarSlider&>();
    return std::nullopt;
  }
};
template <>
struct MemberKind<AnyStructure> {
  static constexpr const char* noun = "structure";
  static std::optional<AnyStructure> read(const py::handle& object) { return structure_of(object); }
};

/// Members of one kind from Python.
template <class Member>
class PythonMembers : public PythonSource {
 public:
  PythonMembers(const py::object& object, const std::atomic<bool>& ended, FirstSample first)
      : PythonSource(object, ended, "sliders must have sample(*, seed, member) and configuration", std::move(first)) {}

  Member sample(std::uint64_t seed, std::uint64_t member) const {
    return ask(seed, member, [&](const py::object& made) {
      if (auto one = MemberKind<Member>::read(made)) return *std::move(one);
      throw py::type_error(std::string("ensemble: as the first sample of sliders is a ") + MemberKind<Member>::noun +
                           ", all must be; that of member " + std::to_string(member) + " is of type " + type_of(made));
    });
  }
};

/// The list of a list or a Drawn object, and whether members draw from it; nullopt for other objects.
inline std::optional<std::pair<py::sequence, Order>> list_of(const py::object& object, const char* name) {
  if (py::isinstance<Drawn>(object)) return std::pair(py::sequence(object.cast<const Drawn&>().items), Order::drawn);
  if (!py::isinstance<py::sequence>(object) || py::isinstance<py::str>(object) || py::hasattr(object, "sample"))
    return std::nullopt;
  if (py::len(object) == 0)
    throw std::invalid_argument(std::string("ensemble: ") + name + " must hold at least one, got an empty list");
  return std::pair(py::sequence(object), Order::in_turn);
}

[[noreturn]] inline void refuse_item(const char* name, std::size_t i, const char* expected, const py::handle& item) {
  throw py::type_error(std::string("ensemble: ") + name + "[" + std::to_string(i) + "] must be a " + expected +
                       ", got " + type_of(item));
}

/// An object of the kind of all members: a single one, the first of a list, the sample of a source for the first
/// member.
/// @param first  receives this sample
inline py::object first_of(const py::object& sliders, std::uint64_t seed, std::uint64_t first_member,
                           FirstSample& first) {
  if (const auto list = list_of(sliders, "sliders")) return list->first[0];
  if (!py::hasattr(sliders, "sample")) return sliders;
  first = {seed, first_member, sliders.attr("sample")(py::arg("seed") = seed, py::arg("member") = first_member)};
  return first.made;
}

/// Calls `f` with members of one kind: one for all, those of a list, or those of a source.
template <class Member, class F>
auto with_members(const py::object& sliders, const std::atomic<bool>& ended, F&& f, FirstSample first = {}) {
  using Kind = MemberKind<Member>;
  if (const auto one = Kind::read(sliders)) return f(*one);
  if (const auto list = list_of(sliders, "sliders")) {
    std::vector<Member> items;
    for (const py::handle item : list->first) {
      auto one = Kind::read(item);
      if (!one) refuse_item("sliders", items.size(), (std::string(Kind::noun) + ", as the first one").c_str(), item);
      items.push_back(*std::move(one));
    }
    return f(OneOf(std::move(items), list->second));
  }
  return f(PythonMembers<Member>(sliders, ended, std::move(first)));
}

/// Calls `f` with the sliders: one for all, those of a list, or those of a source.
template <class F>
auto with_sliders(const py::object& sliders, const std::atomic<bool>& ended, F&& f, FirstSample first = {}) {
  if (const auto one = slider_of(sliders)) return f(*one);
  if (const auto list = list_of(sliders, "sliders")) {
    std::vector<AnySlider> items;
    for (const py::handle item : list->first) {
      auto slider = slider_of(item);
      if (!slider) refuse_item("sliders", items.size(), "Slider or friction law", item);
      items.push_back(*std::move(slider));
    }
    return f(OneOf(std::move(items), list->second));
  }
  return f(PythonSliders(sliders, ended, std::move(first)));
}

/// A ground motion that was made for a member, or one of a list.
class MadeOrListed {
 public:
  MadeOrListed(GroundMotion made) : made_(std::move(made)) {}
  MadeOrListed(const GroundMotion* listed) : listed_(listed) {}
  operator const GroundMotion&() const { return listed_ ? *listed_ : *made_; }

 private:
  std::optional<GroundMotion> made_{};
  const GroundMotion* listed_ = nullptr;
};

/// The ground motions of an ensemble, given in Python, in one type: a type for each of them would compile every run six
/// times.
class Motions {
 public:
  /// Refers to the object, which must outlive it.
  Motions(const py::object& object, const std::atomic<bool>& ended) {
    if (const auto excitation = excitation_of(object)) {
      motions_.emplace<ExcitationReference>(*excitation);
    } else if (const auto components = components_of(object)) {
      components->visit([&]<class Together>(Together together) { motions_.emplace<Together>(std::move(together)); });
    } else if (py::isinstance<GroundMotion>(object)) {
      motions_.emplace<OneOf<GroundMotion>>(std::vector{object.cast<GroundMotion>()});
    } else if (const auto list = list_of(object, "motions")) {
      std::vector<GroundMotion> items;
      for (const py::handle item : list->first) {
        if (!py::isinstance<GroundMotion>(item)) refuse_item("motions", items.size(), "GroundMotion", item);
        items.push_back(item.cast<GroundMotion>());
      }
      motions_.emplace<OneOf<GroundMotion>>(std::move(items), list->second);
    } else {
      motions_.emplace<PythonMotions>(object, ended);
    }
  }

  MadeOrListed sample(std::uint64_t seed, std::uint64_t member) const {
    return with<MadeOrListed>([&](const auto& of) { return made_or_listed(of.sample(seed, member)); });
  }
  MadeOrListed sample_along_axis(std::uint64_t seed, std::uint64_t member) const {
    return with<MadeOrListed>(
        [&](const auto& of) { return made_or_listed(detail::motion_of<false>(of, seed, member)); });
  }
  std::optional<TimeBase> time_base() const {
    return with<std::optional<TimeBase>>([](const auto& of) { return detail::time_base_of(of); });
  }
  std::string configuration() const {
    return with<std::string>([](const auto& of) { return std::string(of.configuration()); });
  }

  /// The excitation along the axis if nothing else acts on a slider on the axis; else null.
  const ExcitationReference* alone_on_axis() const {
    if (const auto* one = std::get_if<ExcitationReference>(&motions_)) return one;
    if (const auto* pairs = std::get_if<Pairs>(&motions_)) return &pairs->along_axis();
    return nullptr;
  }

 private:
  static MadeOrListed made_or_listed(GroundMotion&& made) { return std::move(made); }
  static MadeOrListed made_or_listed(const GroundMotion& listed) { return &listed; }
  template <class Result, class F>
  Result with(F&& f) const {
    return std::visit(
        [&]<class M>(const M& of) -> Result {
          if constexpr (std::same_as<M, std::monostate>)
            throw std::logic_error("Motions: none");
          else
            return f(of);
        },
        motions_);
  }

  // The first one only until the constructor has chosen.
  std::variant<std::monostate, ExcitationReference, WithVertical<ExcitationReference, ExcitationReference>, Pairs,
               WithVertical<Pairs, ExcitationReference>, OneOf<GroundMotion>, PythonMotions>
      motions_{};
};

/// The vector lanes of a slider under an excitation alone; null where there are none.
inline std::unique_ptr<detail::Simulator> lanes_simulator(const AnySlider& slider, const Motions& motions,
                                                          std::uint64_t seed, bool settle) {
  const ExcitationReference* const alone = motions.alone_on_axis();
  if (!alone) return nullptr;
  return std::visit([&](const auto* one) { return detail::lanes_simulator(slider, *one, seed, settle); },
                    alone->excitation);
}

}  // namespace stickslip::python

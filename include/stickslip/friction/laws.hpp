// The friction laws of the library: the one list of them.
#pragma once

#include <concepts>
#include <type_traits>

#include "stickslip/friction/caster.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/friction/degrading.hpp"
#include "stickslip/friction/function_law.hpp"
#include "stickslip/friction/kumar.hpp"
#include "stickslip/friction/multi_pendulum.hpp"
#include "stickslip/friction/static_kinetic.hpp"
#include "stickslip/friction/stribeck.hpp"
#include "stickslip/friction/velocity_dependent.hpp"

// From this list come AnySlider, AnyPlanarSlider, the laws of structures, what the library compiles, and the classes of
// the Python package. A law outside the library needs no list.
//
// Each group has files of its own in src/*/engines, which take about as long to compile.
#define STICKSLIP_COULOMB_LAWS(X) X(Coulomb)
#define STICKSLIP_ANALYTIC_LAWS(X) \
  X(Caster) X(StaticKinetic<Caster>) X(VelocityDependent) X(StaticKinetic<VelocityDependent>) X(Stribeck)
#define STICKSLIP_CLOSED_FORM_LAWS(X) \
  X(StaticKinetic<Coulomb>) X(Degrading) X(StaticKinetic<Degrading>) X(MultiPendulum)
#define STICKSLIP_NUMERIC_LAWS(X) X(KumarFriction) X(FunctionLaw)

/// X(law) for each law of the library.
#define STICKSLIP_LAWS(X) \
  STICKSLIP_COULOMB_LAWS(X) STICKSLIP_ANALYTIC_LAWS(X) STICKSLIP_CLOSED_FORM_LAWS(X) STICKSLIP_NUMERIC_LAWS(X)

namespace stickslip {

template <class... Laws>
struct LawList;

namespace detail {

/// The laws kept so far, and those of the rest that meet a condition.
template <template <class> class Condition, class Kept, class... Rest>
struct Where {
  using type = Kept;
};
template <template <class> class Condition, class... Kept, class First, class... Rest>
struct Where<Condition, LawList<Kept...>, First, Rest...>
    : Where<Condition, std::conditional_t<Condition<First>::value, LawList<Kept..., First>, LawList<Kept...>>,
            Rest...> {};

}  // namespace detail

/// A list of friction laws.
template <class... Laws>
struct LawList {
  template <class Law>
  static constexpr bool has = (std::same_as<Law, Laws> || ...);

  /// The laws that meet a condition.
  /// @tparam Condition  a class template over the law, such as std::is_copy_assignable
  template <template <class> class Condition>
  using where = typename detail::Where<Condition, LawList<>, Laws...>::type;

  /// Call `work.template operator()<Law>()` for each law.
  template <class Work>
  static constexpr void for_each(Work&& work) {
    (work.template operator()<Laws>(), ...);
  }
};

namespace detail {

template <class First, class... Laws>
struct AfterFirst {
  using type = LawList<Laws...>;
};

}  // namespace detail

#define STICKSLIP_AFTER_COMMA(...) , __VA_ARGS__
/// The laws of the library.
using LibraryLaws = detail::AfterFirst<void STICKSLIP_LAWS(STICKSLIP_AFTER_COMMA)>::type;
#undef STICKSLIP_AFTER_COMMA

/// A law with static friction on top of another one.
template <class Law>
inline constexpr bool is_static_kinetic = false;
template <class Law>
inline constexpr bool is_static_kinetic<StaticKinetic<Law>> = true;

}  // namespace stickslip

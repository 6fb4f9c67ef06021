// The list of the friction laws, and what their parts say of them.
#include "stickslip/friction/laws.hpp"

#include <cmath>
#include <concepts>
#include <limits>
#include <string>
#include <tuple>
#include <variant>

#include "stickslip/base/parts.hpp"
#include "stickslip/planar/any_planar_slider.hpp"
#include "stickslip/sliding/any_slider.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;

namespace {

template <class Law>
using Symmetric = std::bool_constant<SymmetricLaw<Law>>;

struct Leaves {
  double stiffness;
  int leaves;
  static constexpr auto parts() {
    return std::tuple(Part{"stiffness", &Leaves::stiffness, "k", "N/m", Range::above(0)},
                      Part{"leaves", &Leaves::leaves, "", "", Range::between(1, 9)});
  }
};

}  // namespace

static_assert(std::same_as<LawList<Coulomb, Caster, Stribeck>::where<Symmetric>, LawList<Caster, Stribeck>>);
static_assert(std::same_as<LawList<Coulomb>::where<Symmetric>, LawList<>>);

TEST_CASE("sliders on one axis take each law of the list, those in the plane the isotropic ones", "[laws]") {
  std::size_t laws = 0, planar_laws = 0;
  LibraryLaws::for_each([&]<class Law>() {
    STATIC_REQUIRE(std::constructible_from<AnySlider, Slider<Law>>);
    if constexpr (IsotropicLaw<Law>) {
      STATIC_REQUIRE(std::constructible_from<AnyPlanarSlider, PlanarSlider<Law>>);
      ++planar_laws;
    }
    if constexpr (is_static_kinetic<Law>)
      STATIC_REQUIRE(LibraryLaws::has<std::remove_cvref_t<decltype(std::declval<const Law&>().sliding())>>);
    ++laws;
  });
  CHECK(laws == std::variant_size_v<AnySlider>);
  CHECK(planar_laws == std::variant_size_v<AnyPlanarSlider>);
}

TEST_CASE("each law of the list names its class, and a unit of each of its levels", "[laws]") {
  LibraryLaws::for_each([]<class Law>() {
    if constexpr (WithParts<Law>) {
      CHECK(std::string(Law::class_name).size() > 1);
      std::apply(
          [](const auto&... part) {
            const auto check = [](const std::string& name, const std::string& unit) {
              CHECK((name.find("level") == std::string::npos || unit == "m/s^2"));
            };
            (check(part.name, part.unit), ...);
          },
          Law::parts());
    }
  });
}

TEST_CASE("a range contains what its rule says", "[laws]") {
  const double nan = not_a_number, tiny = std::numeric_limits<double>::denorm_min();
  const Range level = Range::at_least(0), positive = Range::above(0), part = Range::between(0, 1);
  CHECK((level.rule() == "finite and at least 0" && level.or_infinite().rule() == "at least 0"));
  CHECK((positive.rule() == "positive and finite" && positive.or_infinite().rule() == "positive"));
  CHECK((part.rule() == "from 0 to 1" && Range::above(2).rule() == "finite and above 2"));
  CHECK((level.contains(0) && !level.contains(-tiny) && !level.contains(infinity) && !level.contains(nan)));
  CHECK((level.or_infinite().contains(infinity) && !level.or_infinite().contains(nan)));
  CHECK((positive.contains(tiny) && !positive.contains(0) && !positive.contains(infinity)));
  CHECK((part.contains(0) && part.contains(1) && !part.contains(1 + 1e-15) && !part.contains(nan)));
}

TEST_CASE("parts out of their range are refused by name", "[laws]") {
  detail::check_parts(Leaves{1, 9}, "Leaves");
  CHECK_THROWS_WITH(detail::check_parts(Leaves{0, 1}, "Leaves"),
                    "Leaves: stiffness must be positive and finite, got 0 N/m");
  CHECK_THROWS_WITH(detail::check_parts(Leaves{1, 10}, "Leaves"),
                    "Leaves: leaves must be a whole number from 1 to 9, got 10");
}

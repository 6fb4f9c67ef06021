#include "stickslip/carts/cart.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "carts/hold.hpp"
#include "carts/model.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/friction/caster.hpp"

namespace stickslip {

SwivelCaster SwivelCaster::from_geometry(Vector2 at, double heading, double mu, double trail, double wheel_width,
                                         double rolling_mu) {
  const Caster law = Caster::from_geometry(mu, trail, wheel_width, rolling_mu);
  return {at, heading, law.slip_level() / standard_gravity, law.reach(), rolling_mu};
}
SwivelCaster SwivelCaster::from_slip_level(Vector2 at, double heading, double slip_level, double reach,
                                           double rolling_mu) {
  return {at, heading, slip_level / standard_gravity, reach, rolling_mu};
}

void detail::check_support(const std::string& who, const Support& support) {
  const auto finite = [&](const char* name, double value, const char* unit) {
    require(std::isfinite(value), who + ": " + name + " must be finite", value, unit);
  };
  const auto at_least_0 = [&](const char* name, double value) {
    require(std::isfinite(value) && value >= 0, who + ": " + name + " must be finite and at least 0", value);
  };
  std::visit(
      [&](const auto& one) {
        finite("at", one.at.axis, "m");
        finite("at", one.at.transverse, "m");
        if constexpr (requires { one.heading; }) {
          finite("heading", one.heading, "rad");
          at_least_0("rolling_mu", one.rolling_mu);
        }
        if (one.share) at_least_0("share", *one.share);
        if constexpr (requires { one.reach; }) {
          at_least_0("side_mu", one.side_mu);
          require(one.reach > 0, who + ": reach must be positive", one.reach, "m");
        } else {
          at_least_0("mu", one.mu);
        }
      },
      support);
}

namespace {

std::string number_of(std::size_t i) { return "Cart: support " + std::to_string(i); }

Vector2 place_of(const Support& support) {
  return std::visit([](const auto& one) { return one.at; }, support);
}
std::optional<double> share_of(const Support& support) {
  return std::visit([](const auto& one) { return one.share; }, support);
}

// 1/n plus a linear function of the position: the least squares of shares whose sum is 1 and whose center is given.
std::vector<double> shares_of_equal_stiffness(const std::vector<Support>& supports, Vector2 center) {
  const auto n = static_cast<double>(supports.size());
  Vector2 middle{};
  double xx = 0, xy = 0, yy = 0, size = 0;
  for (const Support& one : supports) middle += (1 / n) * place_of(one);
  for (const Support& one : supports) {
    const Vector2 d = place_of(one) - middle;
    xx += d.axis * d.axis, xy += d.axis * d.transverse, yy += d.transverse * d.transverse;
    size = std::max(size, norm(d));
  }
  // The principal directions of the positions; in one without extent the center must be that of the supports.
  const double angle = std::atan2(2 * xy, xx - yy) / 2;
  const Vector2 off = center - middle;
  Vector2 slope{};
  for (const Vector2 axis : {Vector2{std::cos(angle), std::sin(angle)}, Vector2{-std::sin(angle), std::cos(angle)}}) {
    double spread = 0;
    for (const Support& one : supports) {
      const double d = dot(place_of(one) - middle, axis);
      spread += d * d;
    }
    const double way = dot(off, axis);
    if (spread > 1e-18 * n * size * size)
      slope += (way / spread) * axis;
    else
      detail::require(
          std::abs(way) <= 1e-9 * std::max(size, norm(off)),
          "Cart: the center of mass must lie on the line of the supports, or the cart would tip: it is off by",
          std::abs(way), "m");
  }
  std::vector<double> shares;
  for (std::size_t i = 0; i < supports.size(); ++i) {
    const double share = 1 / n + dot(place_of(supports[i]) - middle, slope);
    if (share < -1e-12)
      detail::refuse(
          "Cart: support " + std::to_string(i) +
              " would carry a negative share of the weight: move the center of mass toward the middle of the "
              "supports, or give a share to each; share",
          share);
    shares.push_back(std::max(share, 0.0));
  }
  return shares;
}

}  // namespace

Cart::Cart(std::vector<Support> supports, double radius_of_gyration, std::optional<Vector2> center,
           std::vector<Vector2> outline)
    : supports_(std::move(supports)), radius_(radius_of_gyration), outline_(std::move(outline)) {
  detail::require(!supports_.empty(), "Cart: supports must be at least 1", 0);
  detail::require(std::isfinite(radius_) && radius_ > 0, "Cart: radius_of_gyration must be positive and finite",
                  radius_, "m");
  for (std::size_t i = 0; i < supports_.size(); ++i) detail::check_support(number_of(i), supports_[i]);
  const auto given = static_cast<std::size_t>(
      std::count_if(supports_.begin(), supports_.end(), [](const Support& one) { return share_of(one).has_value(); }));
  if (center)
    for (const double value : {center->axis, center->transverse})
      detail::require(std::isfinite(value), "Cart: center must be finite", value, "m");
  if (given == 0) {
    center_ = center.value_or(Vector2{});
    shares_ = shares_of_equal_stiffness(supports_, center_);
  } else {
    for (std::size_t i = 0; i < supports_.size(); ++i)
      if (!share_of(supports_[i]))
        detail::refuse(
            number_of(i) + ": it has no share, but others have: give a share to each support or to none; shares given",
            static_cast<double>(given));
    double sum = 0, size = 0;
    for (const Support& one : supports_) {
      shares_.push_back(*share_of(one));
      sum += shares_.back();
      center_ += shares_.back() * place_of(one);
    }
    detail::require(std::abs(sum - 1) <= 1e-9, "Cart: the shares of the supports must have the sum 1", sum);
    for (const Support& one : supports_) size = std::max(size, norm(place_of(one) - center_));
    if (center && norm(*center - center_) > 1e-6 * std::max(size, radius_))
      detail::refuse("Cart: center must be where the shares put it, at (" + detail::shortest(center_.axis) + ", " +
                         detail::shortest(center_.transverse) + ") m, or the cart would tip; it is off by",
                     norm(*center - center_), "m");
  }
  for (const Vector2& corner : outline_)
    for (const double value : {corner.axis, corner.transverse})
      detail::require(std::isfinite(value), "Cart: outline must be finite", value, "m");
  if (outline_.empty())
    for (const Support& one : supports_) outline_.push_back(place_of(one));
  for (const Support& one : supports_) casters_ += std::holds_alternative<SwivelCaster>(one) ? 1 : 0;
}

Cart Cart::with_headings(std::span<const double> headings) const {
  detail::require(headings.size() == casters_,
                  "Cart: headings must be as many as it has swivel casters, " + std::to_string(casters_),
                  static_cast<double>(headings.size()));
  Cart other = *this;
  std::size_t next = 0;
  for (Support& one : other.supports_)
    if (auto* caster = std::get_if<SwivelCaster>(&one)) {
      detail::require(std::isfinite(headings[next]), "Cart: headings must be finite", headings[next], "rad");
      caster->heading = headings[next++];
    }
  return other;
}

double Cart::holds(Vector2 direction, std::span<const double> headings) const {
  const double length = norm(direction);
  detail::require(std::isfinite(length) && length > 0, "Cart: direction must be finite and not zero", length);
  const Cart turned = headings.empty() ? *this : with_headings(headings);
  const detail::CartModel model(turned);
  const CartState state = model.start();
  const detail::Vector3 load{direction.axis / length, direction.transverse / length, 0};
  return standard_gravity * detail::CartHold(model, state).along(load);
}

namespace detail {

CartModel::CartModel(const Cart& cart) : casters(cart.casters()), gyration(cart.radius_of_gyration()) {
  std::size_t caster = 0;
  for (std::size_t i = 0; i < cart.supports().size(); ++i) {
    const double share = cart.shares()[i];
    const Vector2 arm = place_of(cart.supports()[i]) - cart.center();
    Wheel wheel{arm.axis / gyration, arm.transverse / gyration, none, 0, 1, 0, none, none};
    const auto line = [&](bool along, double coefficient) {
      if (!(share * coefficient > 0)) return none;
      lines.push_back({i, along, share * coefficient});
      return lines.size() - 1;
    };
    if (const auto* swivel = std::get_if<SwivelCaster>(&cart.supports()[i])) {
      wheel.caster = caster++;
      wheel.per_reach = 1 / swivel->reach;
      headings.push_back(swivel->heading);
      wheel.across = line(false, swivel->side_mu);
      wheel.along = line(true, swivel->rolling_mu);
    } else if (std::holds_alternative<FixedWheel>(cart.supports()[i])) {
      const FixedWheel& fixed = std::get<FixedWheel>(cart.supports()[i]);
      wheel.cosine = std::cos(fixed.heading);
      wheel.sine = std::sin(fixed.heading);
      wheel.across = line(false, fixed.mu);
      wheel.along = line(true, fixed.rolling_mu);
    } else if (const double level = share * std::get<stickslip::Foot>(cart.supports()[i]).mu; level > 0) {
      feet.push_back({i, level});
    }
    wheels.push_back(wheel);
  }
  for (const Vector2& corner : cart.outline()) outline.push_back(corner - cart.center());
  const double speed = std::sqrt(standard_gravity * gyration);
  slow = 1e-13 * speed;
  halted = 1e-10 * speed;
  steady = 1e-9 * speed;
}

}  // namespace detail
}  // namespace stickslip

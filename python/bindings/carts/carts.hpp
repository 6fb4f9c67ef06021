// Carts, and their responses together with the cart and the ground motion.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "parts.hpp"
#include "stickslip/carts/cart.hpp"
#include "stickslip/carts/forces.hpp"
#include "stickslip/carts/integrate.hpp"
#include "stickslip/carts/response.hpp"
#include "stickslip/carts/state.hpp"
#include "stickslip/carts/support.hpp"

namespace stickslip::python {

/// The Python class SwivelCaster.
struct CasterAsGiven {
  Vector2 at;
  double heading;
  std::optional<double> mu, trail, wheel_width, slip_level, reach;
  double rolling_mu;
  std::optional<double> share;
  std::optional<std::string> lock;  // "wheel" or "both"

  bool swivels() const { return lock != "both"; }
  Support support() const;
};
using SupportAsGiven = std::variant<CasterAsGiven, FixedWheel, Foot>;

/// The Python class Cart.
class CartAsGiven {
 public:
  std::vector<SupportAsGiven> supports;
  double radius_of_gyration;
  std::optional<std::pair<double, double>> center;
  std::vector<Vector2> outline;

  CartAsGiven(std::vector<SupportAsGiven> supports, double radius_of_gyration,
              std::optional<std::pair<double, double>> center, std::vector<Vector2> outline);

  const Cart& cart() const noexcept { return cart_; }

 private:
  Cart cart_;
};

template <>
inline constexpr auto parts<CasterAsGiven> = std::tuple(&CasterAsGiven::at, &CasterAsGiven::heading, &CasterAsGiven::mu,
                                                        &CasterAsGiven::trail, &CasterAsGiven::wheel_width,
                                                        &CasterAsGiven::slip_level, &CasterAsGiven::reach,
                                                        &CasterAsGiven::rolling_mu, &CasterAsGiven::share,
                                                        &CasterAsGiven::lock);
template <>
inline constexpr auto parts<FixedWheel> = std::tuple(&FixedWheel::at, &FixedWheel::heading, &FixedWheel::mu,
                                                     &FixedWheel::rolling_mu, &FixedWheel::share);
template <>
inline constexpr auto parts<Foot> = std::tuple(&Foot::at, &Foot::mu, &Foot::share);
template <>
inline constexpr auto parts<CartAsGiven> = std::tuple(&CartAsGiven::supports, &CartAsGiven::radius_of_gyration,
                                                      &CartAsGiven::center, &CartAsGiven::outline);
template <>
inline constexpr auto parts<CartState> = std::tuple(&CartState::displacement, &CartState::yaw, &CartState::velocity,
                                                    &CartState::yaw_rate, &CartState::headings, &CartState::mode,
                                                    &CartState::lines);
template <>
inline constexpr auto parts<CartEvent> = std::tuple(&CartEvent::time, &CartEvent::displacement, &CartEvent::yaw,
                                                    &CartEvent::kind, &CartEvent::support, &CartEvent::along);
template <>
inline constexpr auto parts<Wall> = std::tuple(&Wall::point, &Wall::direction);
template <>
inline constexpr auto parts<Clearance> = std::tuple(&Clearance::least, &Clearance::time, &Clearance::hit_time,
                                                    &Clearance::hit_speed);
template <>
inline constexpr auto parts<SupportWork> = std::tuple(&SupportWork::scrub, &SupportWork::roll, &SupportWork::slide);
template <>
inline constexpr auto parts<CartEnergy> = std::tuple(&CartEnergy::initial, &CartEnergy::input, &CartEnergy::dissipated,
                                                     &CartEnergy::kinetic, &CartEnergy::elastic,
                                                     &CartEnergy::by_support);
template <>
inline constexpr auto parts<Reach> = std::tuple(&Reach::low, &Reach::high);
template <>
inline constexpr auto parts<CartResponse> =
    std::tuple(&CartResponse::displacement, &CartResponse::velocity, &CartResponse::yaw, &CartResponse::yaw_rate,
               &CartResponse::headings, &CartResponse::events, &CartResponse::peak, &CartResponse::peak_time,
               &CartResponse::peak_yaw, &CartResponse::peak_outline, &CartResponse::peak_outline_time,
               &CartResponse::peak_corner, &CartResponse::reach, &CartResponse::residual, &CartResponse::residual_yaw,
               &CartResponse::time_moving, &CartResponse::rests, &CartResponse::margin, &CartResponse::clearances,
               &CartResponse::energy, &CartResponse::truncated, &CartResponse::components, &CartResponse::state);

struct CartResponseWithInputs {
  CartResponse response;
  py::object cart;
  py::object motion;
  double yaw, yaw_rate;  // at the start
  Vector2 velocity;
  bool settle;
  std::vector<Wall> walls;
  py::object time{}, events{};         // arrays, made on first access
  std::optional<CartForces> forces{};  // likewise
};
template <>
inline constexpr auto parts<CartResponseWithInputs> =
    std::tuple(&CartResponseWithInputs::response, &CartResponseWithInputs::cart, &CartResponseWithInputs::motion,
               &CartResponseWithInputs::yaw, &CartResponseWithInputs::yaw_rate, &CartResponseWithInputs::velocity,
               &CartResponseWithInputs::settle, &CartResponseWithInputs::walls);

/// A wall as a pair of vectors in Python: a point on it, and its direction.
Wall wall_of(const py::object& given, const std::string& name);
std::vector<Wall> walls_of(const py::object& given, const std::string& name);

void bind_supports(py::module_& m);
void bind_cart(py::module_& m);
void bind_cart_advance(py::module_& m);
void bind_cart_response(py::module_& m);
void bind_cart_outcomes(py::module_& m);

}  // namespace stickslip::python

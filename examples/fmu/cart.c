/* A cart on four swivel casters at the corners of a rectangle, as an FMU. */
#include <stickslip/stickslip.h>
#include "variables.h"

typedef stickslip_cart_state model_state;

static stickslip_cart cart(const double* value) {
  stickslip_cart of = {.supports = 4, .radius_of_gyration = value[RADIUS_OF_GYRATION]};
  for (int i = 0; i < 4; ++i) {
    const stickslip_support caster = {.kind = value[LOCKED_1 + i] == 0 ? STICKSLIP_SWIVEL_CASTER : STICKSLIP_FOOT,
                                      .at = {(i < 2 ? 0.5 : -0.5) * value[LENGTH], (i % 2 ? -0.5 : 0.5) * value[WIDTH]},
                                      .heading = value[HEADING_1 + i],
                                      .mu = value[LOCKED_1 + i] == 0 ? value[SIDE_MU] : value[LOCKED_MU],
                                      .reach = value[REACH],
                                      .rolling_mu = value[ROLLING_MU]};
    of.support[i] = caster;
  }
  return of;
}

static int advance(const double* value, double step, const double* end, model_state* state) {
  const stickslip_cart of = cart(value);
  const stickslip_planar_segment segment = {step,
                                            {value[GROUND_ACCELERATION], value[TRANSVERSE_ACCELERATION]},
                                            {end[GROUND_ACCELERATION], end[TRANSVERSE_ACCELERATION]},
                                            value[VERTICAL_ACCELERATION],
                                            end[VERTICAL_ACCELERATION]};
  return stickslip_advance_cart(&of, &segment, state);
}

/* The parameters are those of a step without duration. */
static const char* check(const double* value) {
  model_state at_rest = {0};
  for (int i = LOCKED_1; i < LOCKED_1 + 4; ++i)
    if (value[i] != 0 && value[i] != 1) return "locked must be 0 or 1";
  return advance(value, 0, value, &at_rest) == STICKSLIP_OK ? 0 : stickslip_message();
}

static void set_outputs(double* value, const model_state* state) {
  value[DISPLACEMENT] = state->displacement[0];
  value[TRANSVERSE_DISPLACEMENT] = state->displacement[1];
  value[YAW] = state->yaw;
  value[VELOCITY] = state->velocity[0];
  value[TRANSVERSE_VELOCITY] = state->velocity[1];
  value[YAW_RATE] = state->yaw_rate;
}

#include "co_simulation.h"

/* A friction pendulum bearing under a rigid mass, as an FMU. */
#include <math.h>
#include <stickslip/stickslip.h>
#include "variables.h"

static const double g = 9.80665; /* [m/s^2] */
typedef stickslip_pendulum_state model_state;

static stickslip_pendulum bearing(const double* value) {
  const stickslip_pendulum of = {.surfaces = 1,
                                 .radii = {value[RADIUS]},
                                 .mu = {value[MU]},
                                 .capacities = {value[CAPACITY]},
                                 .restitution = value[RESTITUTION],
                                 .damping = 2 * sqrt(g / value[RADIUS]) * value[DAMPING_RATIO]};
  return of;
}

static int move(const double* value, const stickslip_segment* segment, model_state* state) {
  const stickslip_pendulum of = bearing(value);
  return stickslip_advance_pendulum(&of, segment, state, 0);
}

static double force(const double* value, const model_state* state) {
  const stickslip_state* motion = &state->motion;
  const double weight = g + value[VERTICAL_ACCELERATION];
  const double dish = motion->displacement / value[RADIUS] + value[MU] * motion->mode;
  return (motion->in_flight || weight < 0 ? 0 : weight * dish) + bearing(value).damping * motion->velocity;
}

#include "one_axis.h"

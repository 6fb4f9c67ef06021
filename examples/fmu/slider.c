/* A block on friction, with an optional spring, damper and stops, on level ground, as an FMU. */
#include <stickslip/stickslip.h>
#include "variables.h"

static const double g = 9.80665; /* [m/s^2] */
typedef stickslip_state model_state;

static stickslip_slider slider(const double* value) {
  const stickslip_slider of = {.slip_level = g * value[MU],
                               .static_level = g * value[MU_STATIC],
                               .natural_frequency = value[NATURAL_FREQUENCY],
                               .damping = 2 * value[NATURAL_FREQUENCY] * value[DAMPING_RATIO],
                               .gap = value[GAP],
                               .backward_gap = value[GAP],
                               .restitution = value[RESTITUTION]};
  return of;
}

static int move(const double* value, const stickslip_segment* segment, model_state* state) {
  const stickslip_slider of = slider(value);
  return stickslip_advance(&of, segment, state);
}

static double force(const double* value, const model_state* state) {
  const stickslip_slider of = slider(value);
  const double weight = g + value[VERTICAL_ACCELERATION];
  const double friction = state->in_flight || weight < 0 ? 0 : value[MU] * weight * state->mode;
  return friction + of.damping * state->velocity + of.natural_frequency * of.natural_frequency * state->displacement;
}

#include "one_axis.h"

/* The step and the outputs of an object on one axis. The file that includes this one defines model_state, whose first
 * member, or all of it, is a stickslip_state, and
 *
 *     move(value, segment, state)    the step
 *     force(value, state)            on the ground, per unit mass, at the end of the step */
static int advance(const double* value, double step, const double* end, model_state* state) {
  const stickslip_segment segment = {step, value[GROUND_ACCELERATION], end[GROUND_ACCELERATION],
                                     value[VERTICAL_ACCELERATION], end[VERTICAL_ACCELERATION]};
  return move(value, &segment, state);
}

/* The parameters are those of a step without duration. */
static const char* check(const double* value) {
  model_state at_rest = {0};
  if (!(value[MASS] > 0)) return "mass must be positive";
  return advance(value, 0, value, &at_rest) == STICKSLIP_OK ? 0 : stickslip_message();
}

static void set_outputs(double* value, const model_state* state) {
  const stickslip_state* motion = (const stickslip_state*)state;
  value[DISPLACEMENT] = motion->displacement;
  value[VELOCITY] = motion->velocity;
  value[FORCE] = value[MASS] * (motion->mode == 0 ? -value[GROUND_ACCELERATION] : force(value, state));
}

#include "co_simulation.h"

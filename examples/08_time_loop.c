/* Example 8 in C: a block stands on the floor of a building, which your own code integrates. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <stickslip/stickslip.h>

static const double pi = 3.14159265358979323846;

/* One storey, damping 5 %, period 0.5 s, integrated by the semi-implicit Euler method. */
struct building {
  double displacement, velocity; /* of the floor, relative to the ground [m], [m/s] */
};

/* Advances by one step; returns the absolute acceleration of the floor [m/s^2]. */
static double step(struct building* b, double ground_acceleration, double dt) {
  const double wn = 2 * pi / 0.5;
  const double pull = wn * wn * b->displacement + 2 * 0.05 * wn * b->velocity;
  b->velocity -= (ground_acceleration + pull) * dt;
  b->displacement += b->velocity * dt;
  return -pull;
}

int main(void) {
  const double dt = 0.005; /* [s] */
  const stickslip_slider slider = {.slip_level = 0.3 * 9.80665};
  stickslip_model* model;
  if (stickslip_create(&slider, &model) != STICKSLIP_OK) {
    fprintf(stderr, "%s\n", stickslip_message());
    return EXIT_FAILURE;
  }
  stickslip_state block = {0}; /* at rest */
  struct building building = {0, 0};
  double floor = 0;

  for (int i = 1; i <= 2000; ++i) {
    const double t = i * dt;
    const double ground = 2 * exp(-t / 4) * sin(2 * pi * t / 0.5); /* [m/s^2] */
    const double next = step(&building, ground, dt);
    const stickslip_segment segment = {.duration = dt, .start = floor, .end = next};
    if (stickslip_step(model, &segment, &block) != STICKSLIP_OK) {
      fprintf(stderr, "%s\n", stickslip_message());
      return EXIT_FAILURE;
    }
    floor = next;
  }
  stickslip_destroy(model);
  printf("after the earthquake the block is %.4f m from where it stood, %s\n", block.displacement,
         block.mode == 0 ? "at rest" : "still sliding");
  return EXIT_SUCCESS;
}

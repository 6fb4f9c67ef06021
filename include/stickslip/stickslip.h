/* Sliders with Coulomb friction, blocks that rock and carts, for codes in C and Fortran with their own time loop.
 *
 * A slider, a segment and a state are structs of numbers, which the caller owns. Members that you leave out of an
 * initializer, as in `stickslip_slider slider = {0};`, are 0. Two ways to advance a slider give the same bits:
 *
 *     stickslip_model* model;                              made once; a step takes some 15 ns more than in C++
 *     if (stickslip_create(&slider, &model) != STICKSLIP_OK) puts(stickslip_message());
 *     stickslip_step(model, &segment, &state);             in the time loop
 *     stickslip_destroy(model);
 *
 *     stickslip_advance(&slider, &segment, &state);        nothing to create or destroy: checks the slider at each call
 *
 * The same sliders move in two horizontal directions with stickslip_step_planar and stickslip_advance_planar, which
 * take a stickslip_planar_segment and a stickslip_planar_state. A pendulum with several surfaces moves with
 * stickslip_advance_pendulum, a block that rocks with stickslip_advance_slender_block or
 * stickslip_advance_rocking_block, and a cart with stickslip_advance_cart.
 *
 * Only stickslip_create and stickslip_advance_cart allocate memory. The only global data are the last message of each
 * thread. No exception leaves these functions.
 *
 * SI units. A level is a friction force per unit mass: the coefficient of friction times 9.80665 m/s^2.
 *
 * Link to stickslip::c, which needs no other library, or to stickslip::stickslip, which contains it. stickslip.f90, in
 * the same folder, is the module for Fortran. */
#ifndef STICKSLIP_STICKSLIP_H
#define STICKSLIP_STICKSLIP_H

#ifdef __cplusplus
extern "C" {
#endif

/* A mass on friction, with an optional spring, damper and stops, on level or sloping ground:
 *     x'' + a N+/g sgn(x') + c x' + wn^2 x = p(t)
 *     p = (g + a_z) sin(slope) - n cos(slope),   N = (g + a_z) cos(slope) + n sin(slope),   N+ = max(N, 0)
 * x is its displacement relative to the ground, along the slope and positive downhill; n and a_z are the horizontal and
 * the upward ground acceleration. The slider remains at rest while |p - wn^2 x| <= a_static N+/g. */
typedef struct stickslip_slider {
  double slip_level;        /* a, friction during sliding [m/s^2], finite and at least 0 */
  double static_level;      /* a_static, maximum friction at rest [m/s^2], finite and at least a; 0: equal to a */
  double natural_frequency; /* wn, of the spring and the mass without friction [rad/s], finite and at least 0 */
  double damping;           /* c, of the damper per unit mass [1/s], finite and at least 0; 2 wn times damping ratio */
  double slope_degrees;     /* slope of the ground [degrees], from 0 to less than 90 */
  double gap;               /* stop at x = gap [m], at least 0; 0: none */
  double backward_gap;      /* stop at x = -backward_gap [m], at least 0; 0: none */
  double restitution;       /* speed after an impact on a stop divided by the speed before it, from 0 to 1 */
  int one_way;              /* 1: the slider never slides backward; 0: it slides both ways */
  int clipped;              /* 1: while N < 0 it stays on the ground without friction; 0: it flies and lands */
} stickslip_slider;

/* Ground acceleration, linear in time from `start` to `end` over `duration`. */
typedef struct stickslip_segment {
  double duration;       /* [s], finite; the state is unchanged if it is not positive */
  double start;          /* n, horizontal ground acceleration at the start [m/s^2], finite */
  double end;            /* n at the end [m/s^2], finite */
  double vertical_start; /* a_z, upward ground acceleration at the start [m/s^2], finite */
  double vertical_end;   /* a_z at the end [m/s^2], finite */
} stickslip_segment;

/* The complete state, as six doubles. All zeros: at rest at x = 0. */
typedef struct stickslip_state {
  double displacement; /* x, relative to the ground [m], finite */
  double velocity;     /* x', relative to the ground [m/s], finite */
  double mode;         /* 0: stuck; 1 or -1: sliding, the sign of x'. Store it: x' = 0 alone does not imply rest */
  double in_flight;    /* 1 while the slider has left the ground, else 0 */
  double gap;          /* between slider and ground, in flight [m], finite and at least 0 */
  double gap_velocity; /* rate of change of the gap, in flight [m/s], finite */
} stickslip_state;

/* For a slider in the plane, whose friction opposes the velocity vector: ground acceleration with two horizontal
 * components. The first component of a vector is along the axis (on a slope: downhill), the second along the transverse
 * direction, 90 degrees clockwise from the axis as seen from above. */
typedef struct stickslip_planar_segment {
  double duration;       /* [s], finite; the state is unchanged if it is not positive */
  double start[2];       /* horizontal ground acceleration at the start [m/s^2], finite */
  double end[2];         /* horizontal ground acceleration at the end [m/s^2], finite */
  double vertical_start; /* a_z, upward ground acceleration at the start [m/s^2], finite */
  double vertical_end;   /* a_z at the end [m/s^2], finite */
} stickslip_planar_segment;

/* The complete state of a slider in the plane, as eight doubles. All zeros: at rest at r = 0. */
typedef struct stickslip_planar_state {
  double displacement[2]; /* r, relative to the ground [m], finite */
  double velocity[2];     /* r', relative to the ground [m/s], finite */
  double mode;            /* 0: stuck; 1: sliding; 2: sliding along the stop, pressed against it. Store it, as above */
  double in_flight;       /* 1 while the slider has left the ground, else 0 */
  double gap;             /* between slider and ground, in flight [m], finite and at least 0 */
  double gap_velocity;    /* rate of change of the gap, in flight [m/s], finite */
} stickslip_planar_state;

/* A friction pendulum with several surfaces, in one horizontal direction: a series of elements k with the same force F,
 * in which F/N = u_k / R_k +- mu_k while element k slides, |u_k| <= d_k, and the displacement is the sum of all u_k. */
typedef struct stickslip_pendulum {
  int surfaces;         /* how many of the entries below count: 1 to 8; nested 3, 5 or 7 */
  int nested;           /* 0: the surfaces are the elements. 1: nested surfaces, from the innermost, which occurs twice,
                           outward: inner, lower, upper, (lower, upper); a triple pendulum has 3 */
  double radii[8];      /* effective radii R [m], positive */
  double mu[8];         /* coefficients of friction, positive and finite */
  double capacities[8]; /* d, travel to the stop [m], at least 0; 0: none */
  double restitution;   /* of the impact where all surfaces are at their stops, from 0 to 1 */
  double damping;       /* c, of a damper in parallel, per unit mass [1/s], finite and at least 0 */
  int clipped;          /* as in stickslip_slider */
} stickslip_pendulum;

/* The complete state of a pendulum with several surfaces. All zeros: at rest at its center. */
typedef struct stickslip_pendulum_state {
  stickslip_state motion;
  double memory[13]; /* of its elements: u_k / R_k (of a flat one u_k) of up to eight, then what moved last. Store it */
} stickslip_pendulum_state;

/* A block that rocks on its corners: slender, of small angles, without slip or flight (Housner 1963),
 *     theta'' = p^2 (G/g)(theta - s alpha) - p^2 n/g,    s = sgn(theta),   G = g + a_z > 0
 * At theta = 0 its rate becomes restitution times that before. */
typedef struct stickslip_slender_block {
  double p;           /* frequency parameter [rad/s], positive */
  double alpha;       /* from its side to the line from the corner to the center of mass [rad], below pi/2 */
  double alpha_left;  /* that of its left corner, if it differs; 0: alpha */
  double restitution; /* rate after an impact over that before, from 0 to 1 */
} stickslip_slender_block;

/* A rigid block that rocks, slides and leaves the ground, with large rotations and plastic impacts. */
typedef struct stickslip_rocking_block {
  double width, height;   /* [m], positive */
  double mu;              /* coefficient of friction; 0: it never slips */
  double restitution;     /* of its base, up to 1; 0: that of the impact law, Housner's without slip */
  double center_offset;   /* of the center of mass to the right of the middle of the base [m] */
  double center_height;   /* of the center of mass [m]; 0: half the height */
  double gyration_radius; /* about the center of mass [m]; 0: that of a uniform block */
} stickslip_rocking_block;

/* The complete state of either block. All zeros: at rest. */
typedef struct stickslip_rocking_state {
  double rotation;   /* theta, positive to the right, about the right corner [rad] */
  double rate;       /* theta' [rad/s] */
  double mode;       /* -1, 1: on its left, right corner; 0: at rest; 2: sliding on its base; 3: in flight. Store it */
  double overturned; /* -1, 1: it lies on its left, right side; 0: it does not */
  double slip;       /* direction in which its base or its corner slips, -1 or 1; 0 if it sticks, and in flight */
  double displacement, velocity; /* of the base or the corner, in flight of the center of mass [m], [m/s] */
  double rise, climb;            /* of the center of mass in flight, above its height at rest [m], and its rate [m/s] */
} stickslip_rocking_state;

enum { STICKSLIP_MOST_SUPPORTS = 16 };
enum stickslip_support_kind { STICKSLIP_SWIVEL_CASTER = 0, STICKSLIP_FIXED_WHEEL = 1, STICKSLIP_FOOT = 2 };

/* What a cart stands on. Directions are angles from its axis toward the transverse direction. */
typedef struct stickslip_support {
  int kind;          /* a stickslip_support_kind */
  double at[2];      /* of a caster the pivot; in the frame of the cart [m] */
  double heading;    /* of a caster at the start, from its wheel to its pivot; of a wheel its direction [rad] */
  double mu;         /* friction across the wheel over its load; of a foot in any direction */
  double reach;      /* of a caster, over which it aligns with its path [m], positive */
  double rolling_mu; /* rolling resistance over the load */
  double share;      /* of the weight; all 0: those of equal stiffness */
} stickslip_support;

/* A rigid cart in the plane. */
typedef struct stickslip_cart {
  int supports; /* how many of the entries below count: 1 to 16 */
  stickslip_support support[STICKSLIP_MOST_SUPPORTS];
  double radius_of_gyration; /* about the center of mass [m], positive */
  double center[2];          /* of mass, in the frame of the cart [m]; with shares it follows from them */
} stickslip_cart;

/* The complete state of a cart. All zeros: at rest, with the headings of its casters. */
typedef struct stickslip_cart_state {
  double displacement[2], yaw;                  /* of the center of mass [m]; [rad] */
  double velocity[2], yaw_rate;                 /* [m/s], [rad/s] */
  double started;                               /* 1 after the first step: what follows then counts */
  double headings[STICKSLIP_MOST_SUPPORTS];     /* of the casters in order, relative to the cart [rad] */
  double moving;                                /* 0 at rest, else 1 */
  double known;                                 /* how many of the contacts count. Store them all */
  double contacts[2 * STICKSLIP_MOST_SUPPORTS]; /* directions in which wheels slide along and across, and feet */
} stickslip_cart_state;

/* A slider whose numbers have been checked. */
typedef struct stickslip_model stickslip_model;

/* Return values. */
enum stickslip_status {
  STICKSLIP_OK = 0,
  STICKSLIP_INVALID_ARGUMENT = 1, /* a number is outside its range, NaN or infinite, or a pointer is null */
  STICKSLIP_OVERFLOW = 2,         /* the motion leaves the range of doubles */
  STICKSLIP_NO_CONVERGENCE = 3,   /* over a million steps in 1/100 of the segment: spring or damper too stiff for it */
  STICKSLIP_ERROR = 4             /* any other error */
};

/* Checks a slider and makes a model of it, to be advanced by stickslip_step.
 *
 * slider   its numbers, which are copied
 * model    receives the model, which you release with stickslip_destroy; null after an error
 * Returns STICKSLIP_OK or another stickslip_status; stickslip_message then describes the error. */
int stickslip_create(const stickslip_slider* slider, stickslip_model** model);

/* Advances a model through one segment, with every breakaway, reversal, arrest, impact, lift-off and landing within it:
 * thesis (4.51) to (4.53), (2.44), (2.50). Exact to round-off, with a damper to 1e-12 of the scale, for segments of any
 * length.
 *
 * model    from stickslip_create. It never changes: any number of states, on any number of threads, may use it
 * segment  the ground acceleration
 * state    at the start; replaced by the state at the end, and unchanged by an error. `mode` must be the sign of
 *          `velocity` unless that is 0. Threads must not share a state
 * Returns STICKSLIP_OK or another stickslip_status; stickslip_message then describes the error. */
int stickslip_step(const stickslip_model* model, const stickslip_segment* segment, stickslip_state* state);

/* Releases a model. It must not be used afterward, and no thread may be in stickslip_step with it. Null is ignored. */
void stickslip_destroy(stickslip_model* model);

/* Advances a slider through one segment, as stickslip_step does, without a model: the slider is checked at each call.
 */
int stickslip_advance(const stickslip_slider* slider, const stickslip_segment* segment, stickslip_state* state);

/* Advance a model, or a slider that is checked at each call, in the plane,
 *     r'' + a N+/g r'/|r'| + c r' + wn^2 r = p(t)
 *     p = ((g + a_z) sin(slope) - n cos(slope), -t),   N = (g + a_z) cos(slope) + n sin(slope),   N+ = max(N, 0)
 * with the horizontal ground acceleration (n, t). The slider remains at rest while |p - wn^2 r| <= a_static N+/g. Its
 * stop is a circle, |r| = gap, that reflects the radial velocity times the restitution; the stop has no friction.
 *
 * model, slider  as above; `backward_gap` must be equal to `gap`, and `one_way` must be 0
 * segment        the ground acceleration
 * state          at the start; replaced by the state at the end, and unchanged by an error. `mode` must not be 0 if
 *                `velocity` is not 0; if it is 2, |r| must be the gap. Threads must not share a state
 * Return STICKSLIP_OK or another stickslip_status; stickslip_message then describes the error. Accuracy: 1e-12 of the
 * scale of r. The slider stays where it stops, and passes rest without stopping where it turns. */
int stickslip_step_planar(const stickslip_model* model, const stickslip_planar_segment* segment,
                          stickslip_planar_state* state);
int stickslip_advance_planar(const stickslip_slider* slider, const stickslip_planar_segment* segment,
                             stickslip_planar_state* state);

/* Advances a pendulum with several surfaces through one segment, exactly, as stickslip_advance does a slider.
 *
 * displacements  receives u_k of the elements at the end, in their order [m], of nested surfaces lower inner, upper
 * inner, then outward; room for eight. May be null */
int stickslip_advance_pendulum(const stickslip_pendulum* pendulum, const stickslip_segment* segment,
                               stickslip_pendulum_state* state, double* displacements);

/* Advance a block through one segment, with every uplift, impact, slip, stick, liftoff and landing.
 *
 * segment  the ground acceleration; a slender block needs g + a_z > 0
 * state    at the start; replaced by the state at the end, and unchanged by an error. A start by hand is a rotation and a rate
 *          with mode 1 to the right, -1 to the left. What has overturned stays so
 * Return STICKSLIP_OK or another stickslip_status; stickslip_message then describes the error: STICKSLIP_NO_CONVERGENCE where
 * friction does not decide how a block slips. A slender block is exact to round-off; it has overturned at |theta| = pi/2,
 * because what the record will bring is not known. */
int stickslip_advance_slender_block(const stickslip_slender_block* block, const stickslip_segment* segment,
                                    stickslip_rocking_state* state);
int stickslip_advance_rocking_block(const stickslip_rocking_block* block, const stickslip_segment* segment,
                                    stickslip_rocking_state* state);

/* Advances a cart through one segment, with every slip, stick and reversal of its supports, as stickslip_advance does a
 * slider in the plane. A start in motion needs a velocity or a yaw rate only. */
int stickslip_advance_cart(const stickslip_cart* cart, const stickslip_planar_segment* segment,
                           stickslip_cart_state* state);

/* Checks a slider, as stickslip_create does, without making a model. */
int stickslip_check(const stickslip_slider* slider);

/* Message of the last failed call of this thread, null-terminated: what was expected, and the value. Empty if none
 * failed. Valid until this thread's next call that fails. */
const char* stickslip_message(void);

#ifdef __cplusplus
}
#endif

#endif

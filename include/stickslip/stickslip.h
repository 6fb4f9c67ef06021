/* A slider under Coulomb friction, for codes in C and Fortran with a time loop of their own.
 *
 * A slider, a segment and a state are structs of numbers, which the caller owns. Nothing is allocated, there are no
 * globals but the last message of each thread, and no exception leaves these functions. Zero, as in
 * `stickslip_slider slider = {0};`, is the value of all that is left out.
 *
 * SI units. A level is a friction force per unit mass: the coefficient of friction times 9.80665 m/s^2.
 *
 * Link to stickslip::c, which needs no other library, or to stickslip::stickslip, which contains it. */
#ifndef STICKSLIP_STICKSLIP_H
#define STICKSLIP_STICKSLIP_H

#ifdef __cplusplus
extern "C" {
#endif

/* A mass on friction, with an optional spring, damper and stops, on level or sloping ground:
 *     x'' + a N+/g sgn(x') + c x' + wn^2 x = p(t)
 *     p = (g + a_z) sin(slope) - n cos(slope),   N = (g + a_z) cos(slope) + n sin(slope),   N+ = max(N, 0)
 * x is its displacement relative to the ground, along the slope and positive downhill; n and a_z are the horizontal and
 * the upward ground acceleration. At rest it stays while |p - wn^2 x| <= a_static N+/g. */
typedef struct stickslip_slider {
  double slip_level;        /* a, what resists sliding [m/s^2], finite and at least 0 */
  double static_level;      /* a_static, what holds at rest [m/s^2], finite and at least slip_level; 0: slip_level */
  double natural_frequency; /* wn, of the spring and the mass without friction [rad/s], finite and at least 0 */
  double damping;           /* c, of the damper per unit mass [1/s], finite and at least 0; 2 wn damping ratio */
  double slope_degrees;     /* slope of the ground [degrees], from 0 to less than 90 */
  double gap;               /* stop at x = gap [m], at least 0; 0: none */
  double backward_gap;      /* stop at x = -backward_gap [m], at least 0; 0: none */
  double restitution;       /* speed after an impact on a stop over that before it, from 0 to 1 */
  int one_way;              /* 1: it never slides backward; 0: both ways */
  int clipped;              /* 1: while N < 0 it stays on the ground without friction; 0: it flies and lands */
} stickslip_slider;

/* Ground acceleration, straight from `start` to `end` within `duration`. */
typedef struct stickslip_segment {
  double duration;       /* [s], finite; where it is not positive nothing happens */
  double start;          /* n, horizontal ground acceleration at its beginning [m/s^2], finite */
  double end;            /* n at its end [m/s^2], finite */
  double vertical_start; /* a_z, upward ground acceleration at its beginning [m/s^2], finite */
  double vertical_end;   /* a_z at its end [m/s^2], finite */
} stickslip_segment;

/* All that the motion to come depends on, as six doubles. All zeros: at rest at x = 0. */
typedef struct stickslip_state {
  double displacement; /* x, relative to the ground [m] */
  double velocity;     /* x', relative to the ground [m/s] */
  double mode;         /* 0: stuck; 1 or -1: sliding, the sign of x'. Carry it: at x' = 0 it tells rest from motion */
  double in_flight;    /* 1 while it has left the ground, else 0 */
  double gap;          /* between slider and ground, in flight [m] */
  double gap_velocity; /* rate of the gap, in flight [m/s] */
} stickslip_state;

/* What the functions return. */
enum stickslip_status {
  STICKSLIP_OK = 0,
  STICKSLIP_INVALID_ARGUMENT = 1, /* a number is outside its range, NaN or infinite, or a pointer is null */
  STICKSLIP_OVERFLOW = 2,         /* the motion leaves the range of doubles */
  STICKSLIP_NO_CONVERGENCE = 3,   /* events follow each other faster than time can be resolved: a spring too stiff */
  STICKSLIP_ERROR = 4             /* any other error */
};

/* Moves a slider over one segment, with every breakaway, reversal, arrest, impact, lift-off and landing within it:
 * thesis (4.51) to (4.53), (2.44), (2.50). Exact to round-off, with a damper to 1e-12 of the scale, for segments of any
 * length.
 *
 * slider   what moves; checked at each call
 * segment  the ground acceleration
 * state    at the beginning; becomes the state at the end. Unchanged by an error. `mode` must be the sign of `velocity`
 *          where that is not 0
 * Returns STICKSLIP_OK or another stickslip_status; stickslip_message says what was wrong.
 * Threads may call it at the same time, each with a state of its own. */
int stickslip_advance(const stickslip_slider* slider, const stickslip_segment* segment, stickslip_state* state);

/* Checks a slider, as stickslip_advance does, before a run begins. */
int stickslip_check(const stickslip_slider* slider);

/* What was wrong in the last call of this thread that did not return STICKSLIP_OK: what was expected and the value, in
 * English, with a zero at its end; empty before there was one. Valid until this thread's next such call. */
const char* stickslip_message(void);

#ifdef __cplusplus
}
#endif

#endif

/* MEX function for MATLAB and Octave: advances a slider through one segment, by the interface in C.
 *
 *     state = stickslip_advance(slider, segment, state)
 *
 * slider   struct with any of the fields of stickslip_slider; those that it lacks are 0
 * segment  struct with any of the fields of stickslip_segment
 * state    the six numbers of stickslip_state; zeros(1, 6): at rest at x = 0
 *
 * Units and ranges: stickslip/stickslip.h. An error has the identifier stickslip:invalid. */
#include <string.h>
#include <mex.h>
#include <stickslip/stickslip.h>

enum { STATE = sizeof(stickslip_state) / sizeof(double) };

/* Takes the value of a field, if the field has this name. */
#define TAKE(TO, NAME)             \
  if (strcmp(field, #NAME) == 0) { \
    TO.NAME = mxGetScalar(value);  \
    continue;                      \
  }

void mexFunction(int outputs, mxArray* out[], int inputs, const mxArray* in[]) {
  stickslip_slider slider = {0};
  stickslip_segment segment = {0};
  stickslip_state state;
  int i;
  if (inputs != 3 || outputs > 1 || !mxIsStruct(in[0]) || mxGetNumberOfElements(in[0]) != 1 || !mxIsStruct(in[1]) ||
      mxGetNumberOfElements(in[1]) != 1 || !mxIsDouble(in[2]) || mxGetNumberOfElements(in[2]) != STATE)
    mexErrMsgIdAndTxt("stickslip:invalid", "state = stickslip_advance(slider, segment, state): two structs, 6 numbers");
  for (i = 0; i < mxGetNumberOfFields(in[0]); ++i) {
    const char* field = mxGetFieldNameByNumber(in[0], i);
    const mxArray* value = mxGetFieldByNumber(in[0], 0, i);
    TAKE(slider, slip_level)
    TAKE(slider, static_level)
    TAKE(slider, natural_frequency)
    TAKE(slider, damping)
    TAKE(slider, slope_degrees)
    TAKE(slider, gap)
    TAKE(slider, backward_gap)
    TAKE(slider, restitution)
    TAKE(slider, one_way)
    TAKE(slider, clipped)
    mexErrMsgIdAndTxt("stickslip:invalid", "stickslip_slider has no field %s", field);
  }
  for (i = 0; i < mxGetNumberOfFields(in[1]); ++i) {
    const char* field = mxGetFieldNameByNumber(in[1], i);
    const mxArray* value = mxGetFieldByNumber(in[1], 0, i);
    TAKE(segment, duration)
    TAKE(segment, start)
    TAKE(segment, end)
    TAKE(segment, vertical_start)
    TAKE(segment, vertical_end)
    mexErrMsgIdAndTxt("stickslip:invalid", "stickslip_segment has no field %s", field);
  }
  memcpy(&state, mxGetPr(in[2]), sizeof state);
  if (stickslip_advance(&slider, &segment, &state) != STICKSLIP_OK)
    mexErrMsgIdAndTxt("stickslip:invalid", "%s", stickslip_message());
  out[0] = mxCreateDoubleMatrix(1, STATE, mxREAL);
  memcpy(mxGetPr(out[0]), &state, sizeof state);
}

/* The functions of FMI 2.0 for co-simulation, around a model: the file that includes this one includes variables.h, which
 * build.py writes, and defines
 *
 *     model_state                         what the model remembers; all zeros: at rest
 *     check(value)                        what is wrong with the parameters; NULL if nothing is
 *     advance(value, step, end, state)    the step, over which the inputs go from value to end
 *     set_outputs(value, state)           from the state and the inputs at the end of the step
 *
 * Inputs are linear in time within a step if the master sets their derivatives, and constant if it does not. */
#include <fmi2Functions.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
  double value[VARIABLES];
  double slope[INPUTS]; /* derivatives of the inputs, for the next step alone */
  model_state state;
  int running; /* the parameters are fixed */
  char name[64];
  fmi2CallbackFunctions callbacks;
} instance;

static fmi2Status fail(const instance* m, const char* message) {
  if (m->callbacks.logger)
    m->callbacks.logger(m->callbacks.componentEnvironment, m->name, fmi2Error, "logStatusError", "%s", message);
  return fmi2Error;
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions* callbacks, fmi2Boolean visible, fmi2Boolean logging) {
  (void)resources, (void)visible, (void)logging;
  instance* m = type == fmi2CoSimulation && strcmp(guid, GUID) == 0 ? calloc(1, sizeof *m) : NULL;
  if (!m) return NULL;
  memcpy(m->value, starts, sizeof starts);
  strncpy(m->name, name, sizeof m->name - 1);
  m->callbacks = *callbacks;
  return m;
}
void fmi2FreeInstance(fmi2Component c) { free(c); }

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean tolerance_defined, fmi2Real tolerance, fmi2Real start,
                               fmi2Boolean stop_defined, fmi2Real stop) {
  (void)c, (void)tolerance_defined, (void)tolerance, (void)start, (void)stop_defined, (void)stop;
  return fmi2OK;
}
fmi2Status fmi2EnterInitializationMode(fmi2Component c) { return (void)c, fmi2OK; }
fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
  instance* m = c;
  const char* wrong = check(m->value);
  if (wrong) return fail(m, wrong);
  m->running = 1;
  set_outputs(m->value, &m->state);
  return fmi2OK;
}
fmi2Status fmi2Terminate(fmi2Component c) { return (void)c, fmi2OK; }
fmi2Status fmi2Reset(fmi2Component c) {
  instance* m = c;
  memcpy(m->value, starts, sizeof starts);
  memset(m->slope, 0, sizeof m->slope);
  memset(&m->state, 0, sizeof m->state);
  m->running = 0;
  return fmi2OK;
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real step, fmi2Boolean final) {
  (void)time, (void) final;
  instance* m = c;
  double end[INPUTS];
  for (int i = 0; i < INPUTS; ++i) end[i] = m->value[i] + step * m->slope[i];
  if (advance(m->value, step, end, &m->state) != STICKSLIP_OK) return fail(m, stickslip_message());
  memcpy(m->value, end, sizeof end);
  memset(m->slope, 0, sizeof m->slope);
  set_outputs(m->value, &m->state);
  return fmi2OK;
}
fmi2Status fmi2CancelStep(fmi2Component c) { return fail(c, "no step is pending"); }

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference* v, size_t n, fmi2Real* value) {
  instance* m = c;
  for (size_t i = 0; i < n; ++i) {
    if (v[i] >= VARIABLES) return fail(m, "no such variable");
    value[i] = m->value[v[i]];
  }
  return fmi2OK;
}
fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference* v, size_t n, const fmi2Real* value) {
  instance* m = c;
  for (size_t i = 0; i < n; ++i) {
    if (v[i] >= VARIABLES || (v[i] >= INPUTS && v[i] < INPUTS + OUTPUTS)) return fail(m, "no such input or parameter");
    if (v[i] >= INPUTS && m->running) return fail(m, "parameters are fixed after the initialization");
    m->value[v[i]] = value[i];
  }
  return fmi2OK;
}
fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference* v, size_t n, const fmi2Integer* order,
                                       const fmi2Real* value) {
  instance* m = c;
  for (size_t i = 0; i < n; ++i) {
    if (v[i] >= INPUTS || order[i] != 1) return fail(m, "only first derivatives of inputs can be set");
    m->slope[v[i]] = value[i];
  }
  return fmi2OK;
}

/* So that a master can repeat a step. */
fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate* saved) {
  if (!*saved) *saved = malloc(sizeof(instance));
  if (!*saved) return fail(c, "out of memory");
  memcpy(*saved, c, sizeof(instance));
  return fmi2OK;
}
fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate saved) { return memcpy(c, saved, sizeof(instance)), fmi2OK; }
fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate* saved) {
  (void)c;
  free(*saved);
  *saved = NULL;
  return fmi2OK;
}

/* What every FMU must export, and this one has no use for. */
const char* fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }
const char* fmi2GetVersion(void) { return fmi2Version; }
fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t n, const fmi2String categories[]) {
  return (void)c, (void)on, (void)n, (void)categories, fmi2OK;
}
#define NO_VARIABLES(NAME, TYPE)                                                                      \
  fmi2Status NAME(fmi2Component c, const fmi2ValueReference* v, size_t n, TYPE* value) {              \
    return (void)v, (void)value, n == 0 ? fmi2OK : fail(c, #NAME ": all variables are of type Real"); \
  }
NO_VARIABLES(fmi2GetInteger, fmi2Integer)
NO_VARIABLES(fmi2GetBoolean, fmi2Boolean)
NO_VARIABLES(fmi2GetString, fmi2String)
NO_VARIABLES(fmi2SetInteger, const fmi2Integer)
NO_VARIABLES(fmi2SetBoolean, const fmi2Boolean)
NO_VARIABLES(fmi2SetString, const fmi2String)
#define NO_STATUS(NAME, TYPE)                                                \
  fmi2Status NAME(fmi2Component c, const fmi2StatusKind kind, TYPE* value) { \
    return (void)kind, (void)value, fail(c, #NAME ": no step is pending");   \
  }
NO_STATUS(fmi2GetStatus, fmi2Status)
NO_STATUS(fmi2GetRealStatus, fmi2Real)
NO_STATUS(fmi2GetIntegerStatus, fmi2Integer)
NO_STATUS(fmi2GetBooleanStatus, fmi2Boolean)
NO_STATUS(fmi2GetStringStatus, fmi2String)
fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference* v, size_t n,
                                        const fmi2Integer* order, fmi2Real* value) {
  return (void)v, (void)n, (void)order, (void)value, fail(c, "outputs have no derivatives");
}
fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference* unknown, size_t unknowns,
                                        const fmi2ValueReference* known, size_t knowns, const fmi2Real* change,
                                        fmi2Real* result) {
  (void)unknown, (void)unknowns, (void)known, (void)knowns, (void)change, (void)result;
  return fail(c, "outputs have no derivatives");
}
fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate saved, size_t* size) {
  return (void)saved, (void)size, fail(c, "states cannot be serialized");
}
fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate saved, fmi2Byte bytes[], size_t size) {
  return (void)saved, (void)bytes, (void)size, fail(c, "states cannot be serialized");
}
fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate* saved) {
  return (void)bytes, (void)size, (void)saved, fail(c, "states cannot be serialized");
}

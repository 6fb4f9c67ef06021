// Ownership of the objects of SUNDIALS.
#pragma once

#include <nvector/nvector_serial.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>
#include <sundials/sundials_nonlinearsolver.h>
#include <sundials/sundials_version.h>

#include <memory>
#include <new>
#include <type_traits>

#if SUNDIALS_VERSION_MAJOR < 6
#error "stickslip needs SUNDIALS 6 or newer"
#endif

namespace stickslip::detail::sundials {

static_assert(std::is_same_v<sunrealtype, double>, "stickslip needs SUNDIALS of double precision");

template <class Handle, auto destroy>
struct Destroy {
  void operator()(Handle handle) const { destroy(handle); }
};
template <class Handle, auto destroy>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Destroy<Handle, destroy>>;

template <class Pointer>
Pointer made(Pointer pointer) {
  if (pointer == nullptr) throw std::bad_alloc();
  return pointer;
}

// Error messages go into exceptions, not to the terminal.
inline SUNContext make_context() {
  SUNContext context = nullptr;
#if SUNDIALS_VERSION_MAJOR >= 7
  if (SUNContext_Create(SUN_COMM_NULL, &context) != 0) throw std::bad_alloc();
  SUNContext_ClearErrHandlers(context);
#else
  if (SUNContext_Create(nullptr, &context) != 0) throw std::bad_alloc();
#endif
  return context;
}

inline void free_context(SUNContext context) { SUNContext_Free(&context); }
using Context = Owned<SUNContext, &free_context>;
using Vector = Owned<N_Vector, &N_VDestroy>;
using Matrix = Owned<SUNMatrix, &SUNMatDestroy>;
using LinearSolver = Owned<SUNLinearSolver, &SUNLinSolFree>;
using NonlinearSolver = Owned<SUNNonlinearSolver, &SUNNonlinSolFree>;

}  // namespace stickslip::detail::sundials

// What the library uses of FFTW, for the page, by kissfft: FFTW is not compiled to WebAssembly here.
#pragma once

#include <cstddef>

using fftw_complex = double[2];
struct StickslipPlan;
using fftw_plan = StickslipPlan*;
constexpr unsigned FFTW_ESTIMATE = 0, FFTW_DESTROY_INPUT = 0;

/// As FFTW's functions of the same names; n > 0.
fftw_plan fftw_plan_dft_r2c_1d(int n, double* in, fftw_complex* out, unsigned flags);
fftw_plan fftw_plan_dft_c2r_1d(int n, fftw_complex* in, double* out, unsigned flags);
void fftw_execute(fftw_plan plan);
void fftw_execute_dft_c2r(fftw_plan plan, fftw_complex* in, double* out);
void fftw_destroy_plan(fftw_plan plan);
void* fftw_malloc(std::size_t size);
void fftw_free(void* memory);
int fftw_alignment_of(double* memory);

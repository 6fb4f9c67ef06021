// Discrete Fourier transforms of any length.
#include <fftw3.h>

#include <bit>
#include <complex>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <utility>
#include <vector>

namespace {

using Complex = std::complex<double>;

/// Without the check for NaN and infinity of std::complex.
Complex product(Complex a, Complex b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

/// The transform of a power of two of values, in place, with exponents of -2 pi i.
/// @param roots  exp(-2 pi i k / n) for k < n / 2
void transform(std::vector<Complex>& values, const std::vector<Complex>& roots) {
  const std::size_t n = values.size();
  for (std::size_t i = 1, j = 0; i < n; ++i) {
    std::size_t bit = n / 2;
    for (; (j & bit) != 0; bit /= 2) j ^= bit;
    j |= bit;
    if (i < j) std::swap(values[i], values[j]);
  }
  for (std::size_t half = 1; half < n; half *= 2)
    for (std::size_t i = 0; i < n; i += 2 * half)
      for (std::size_t k = 0; k < half; ++k) {
        const Complex odd = product(values[i + half + k], roots[k * (n / (2 * half))]), even = values[i + k];
        values[i + k] = even + odd;
        values[i + half + k] = even - odd;
      }
}

}  // namespace

/// L. I. Bluestein, IEEE Trans. Audio Electroacoust. 18 (1970), 451-455: k l = (k^2 + l^2 - (k - l)^2) / 2 makes the
/// transform a convolution with the chirp exp(i pi k^2 / n).
struct StickslipPlan {
  explicit StickslipPlan(int length) : n(static_cast<std::size_t>(length)), chirp(n) {
    const std::size_t size = std::bit_ceil(2 * n);
    for (std::size_t k = 0; k < n; ++k) {
      const auto square = static_cast<std::uint64_t>(k) * k % (2 * n);  // of the angle, pi k^2 / n modulo 2 pi
      chirp[k] = std::polar(1.0, -std::numbers::pi * static_cast<double>(square) / static_cast<double>(n));
    }
    for (std::size_t k = 0; k < size / 2; ++k)
      roots.push_back(std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(size)));
    kernel.resize(size);
    for (std::size_t k = 0; k < n; ++k) kernel[k] = kernel[(size - k) % size] = std::conj(chirp[k]);
    transform(kernel, roots);
  }

  /// The transform of `values`, of which there are n.
  std::vector<Complex> operator()(std::vector<Complex> values) const {
    for (std::size_t k = 0; k < n; ++k) values[k] = product(values[k], chirp[k]);
    values.resize(kernel.size());
    transform(values, roots);
    // The inverse is the conjugate of the transform of the conjugate.
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = std::conj(product(values[k], kernel[k]));
    transform(values, roots);
    const double scale = 1 / static_cast<double>(values.size());
    for (std::size_t k = 0; k < n; ++k) values[k] = product(std::conj(values[k]) * scale, chirp[k]);
    values.resize(n);
    return values;
  }

  std::size_t n;
  std::vector<Complex> chirp, roots, kernel;
  double* samples = nullptr;  // of a transform of real numbers
  fftw_complex* lines = nullptr;
};

fftw_plan fftw_plan_dft_r2c_1d(int n, double* in, fftw_complex* out, unsigned) {
  auto* const plan = new StickslipPlan(n);
  plan->samples = in;
  plan->lines = out;
  return plan;
}

fftw_plan fftw_plan_dft_c2r_1d(int n, fftw_complex*, double*, unsigned) { return new StickslipPlan(n); }

void fftw_execute(fftw_plan plan) {
  const std::vector<Complex> result = (*plan)({plan->samples, plan->samples + plan->n});
  for (std::size_t k = 0; k <= plan->n / 2; ++k) {
    plan->lines[k][0] = result[k].real();
    plan->lines[k][1] = result[k].imag();
  }
}

void fftw_execute_dft_c2r(fftw_plan plan, fftw_complex* in, double* out) {
  // sum_k c_k exp(2 pi i k l / n) over a Hermitian c is real: the transform of its conjugate.
  std::vector<Complex> values(plan->n);
  for (std::size_t k = 0; k <= plan->n / 2; ++k) {
    values[k] = {in[k][0], -in[k][1]};
    if (k > 0) values[plan->n - k] = {in[k][0], in[k][1]};
  }
  values[0] = in[0][0];
  if (plan->n % 2 == 0) values[plan->n / 2] = in[plan->n / 2][0];
  const std::vector<Complex> result = (*plan)(std::move(values));
  for (std::size_t i = 0; i < plan->n; ++i) out[i] = result[i].real();
}

void fftw_destroy_plan(fftw_plan plan) { delete plan; }
void* fftw_malloc(std::size_t size) { return std::malloc(size); }
void fftw_free(void* memory) { std::free(memory); }
int fftw_alignment_of(double*) { return 0; }

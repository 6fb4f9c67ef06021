// Discrete Fourier transforms of any length.
#include <fftw3.h>

#include <complex>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <utility>
#include <vector>

#include <kissfft/kissfft.hh>

namespace {

using Complex = std::complex<double>;

/// The smallest number from `least` on without prime factors above 5, for which kissfft is fast.
std::size_t fast_size(std::size_t least) {
  for (std::size_t size = least;; ++size) {
    std::size_t rest = size;
    for (const std::size_t factor : {2, 3, 5})
      while (rest % factor == 0) rest /= factor;
    if (rest == 1) return size;
  }
}

}  // namespace

/// kissfft takes n^2 operations where n is prime. L. I. Bluestein, IEEE Trans. Audio Electroacoust. 18 (1970), 451-455:
/// k l = (k^2 + l^2 - (k - l)^2) / 2 makes the transform a convolution with the chirp exp(i pi k^2 / n), of any length
/// from 2 n - 1 on.
struct StickslipPlan {
  explicit StickslipPlan(int length)
      : n(static_cast<std::size_t>(length)),
        chirp(n),
        kernel(fast_size(2 * n)),
        forward(kernel.size(), false),
        backward(kernel.size(), true) {
    const std::size_t size = kernel.size();
    std::vector<Complex> mirrored(size);
    for (std::size_t k = 0; k < n; ++k) {
      const auto square = static_cast<std::uint64_t>(k) * k % (2 * n);  // of the angle, pi k^2 / n modulo 2 pi
      chirp[k] = std::polar(1.0, -std::numbers::pi * static_cast<double>(square) / static_cast<double>(n));
      mirrored[k] = mirrored[(size - k) % size] = std::conj(chirp[k]) / static_cast<double>(size);
    }
    forward.transform(mirrored.data(), kernel.data());
  }

  /// The transform of `values`, of which there are n.
  std::vector<Complex> operator()(std::vector<Complex> values) const {
    std::vector<Complex> lines(kernel.size());
    for (std::size_t k = 0; k < n; ++k) values[k] *= chirp[k];
    values.resize(kernel.size());
    forward.transform(values.data(), lines.data());
    for (std::size_t k = 0; k < lines.size(); ++k) lines[k] *= kernel[k];
    backward.transform(lines.data(), values.data());
    values.resize(n);
    for (std::size_t k = 0; k < n; ++k) values[k] *= chirp[k];
    return values;
  }

  std::size_t n;
  std::vector<Complex> chirp, kernel;
  kissfft<double> forward, backward;
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

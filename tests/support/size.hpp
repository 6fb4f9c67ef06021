// The size of a test: full, or small under sanitizers, which run the same code on fewer cases.
#pragma once

namespace test {

template <class Size>
constexpr Size size([[maybe_unused]] Size full, [[maybe_unused]] Size small) {
#ifdef __SANITIZE_ADDRESS__
  return small;
#else
  return full;
#endif
}

}  // namespace test

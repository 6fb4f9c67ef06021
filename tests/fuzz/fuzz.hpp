// The interface between the driver and a fuzz target, tests/fuzz/<target>.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

/// Runs one case; the bytes may be anything. Ends in `finding` or lets an exception escape where an invariant is
/// broken.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

/// Valid inputs to be mutated; {} if random bytes do.
std::vector<std::string> fuzz_seeds();

/// Reports a broken invariant and ends the program.
[[noreturn]] inline void finding(const std::string& message) {
  std::fprintf(stderr, "finding: %s\n", message.c_str());
  std::abort();
}

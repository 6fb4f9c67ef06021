// What is compiled for several instruction sets is tested on each that this processor has.
#pragma once

#include <hwy/highway.h>

#include <cstdint>
#include <string>

namespace test {

/// Runs `body` with the name of each instruction set, while that is the one in use.
template <class Body>
void on_each_instruction_set(Body&& body) {
  struct Restore {
    ~Restore() {
      hwy::SetSupportedTargetsForTest(0);
      hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    }
  } restore;
  for (std::int64_t sets = hwy::SupportedTargets(); sets != 0; sets &= sets - 1) {
    const std::int64_t set = sets & -sets;
    hwy::SetSupportedTargetsForTest(set);
    hwy::GetChosenTarget().Update(set);
    body(std::string(hwy::TargetName(set)));
  }
}

}  // namespace test

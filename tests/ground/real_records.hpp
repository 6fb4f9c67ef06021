// Real records of agencies, which the repository does not contain.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

#include "support/catch.hpp"

namespace test {

/// A file in the folder that $STICKSLIP_RECORDS names. Where there is none the test is to return: ctest shows it as
/// skipped, and `script/test` prints why.
inline std::optional<std::filesystem::path> real_record(const std::string& name) {
  const char* folder = std::getenv("STICKSLIP_RECORDS");
  if (folder && std::filesystem::exists(std::filesystem::path(folder) / name))
    return std::filesystem::path(folder) / name;
  std::cout << "skipped: \"" << Catch::getResultCapture().getCurrentTestName() << "\" needs " << name
            << ": set STICKSLIP_RECORDS to a folder of real records\n";
  return std::nullopt;
}

}  // namespace test

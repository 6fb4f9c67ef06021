// The thesis's figures as values: CSV files and the summary, without Python.
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
#include "reproduction/thesis.hpp"

namespace {

constexpr const char* usage =
    "usage: thesis_figures [NUMBER...] [--members N] [--seed N] [--out FOLDER] [--check] [--expectations]\n"
    "  writes a CSV file for each figure (all of them if none is named) to FOLDER, prints the summary\n"
    "  --check         2000 members and seed 2 unless given; each number against what is expected of it\n"
    "  --expectations  prints what python/stickslip/thesis_expected.txt is made of\n";

std::string expected() {
  std::ifstream stream(STICKSLIP_THESIS_EXPECTED);
  if (!stream) throw std::runtime_error("cannot read " STICKSLIP_THESIS_EXPECTED);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string file_name(const std::string& number) {
  std::string name = number.find(' ') != std::string::npos ? number : "figure " + number;
  std::ranges::transform(name, name.begin(), [](unsigned char c) {
    return static_cast<char>(c == ' ' || c == '.' ? '_' : std::tolower(c));
  });
  return name + ".csv";
}

std::uint64_t count(const std::string& option, const std::string& text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
    throw std::invalid_argument(option + " must be a whole number, got " + text);
  return value;
}

int run(const std::vector<std::string>& arguments) {
  using namespace stickslip;
  std::vector<std::string> numbers;
  std::filesystem::path out = "thesis";
  bool check = false, expectations = false;
  std::optional<std::uint64_t> members, seed;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    const auto value = [&]() -> const std::string& {
      if (i + 1 == arguments.size()) throw std::invalid_argument(argument + " needs a value");
      return arguments[++i];
    };
    if (argument == "--members") {
      members = count(argument, value());
    } else if (argument == "--seed") {
      seed = count(argument, value());
    } else if (argument == "--out") {
      out = value();
    } else if (argument == "--check") {
      check = true;
    } else if (argument == "--expectations") {
      expectations = true;
    } else if (argument.starts_with("-")) {
      std::fputs(usage, stderr);
      return 2;
    } else {
      numbers.push_back(argument);
    }
  }
  for (const std::string& number : numbers)
    if (std::ranges::find(Thesis::numbers(), number) == Thesis::numbers().end())
      Thesis().figure(number);  // throws the error
  if (numbers.empty()) numbers.assign(Thesis::numbers().begin(), Thesis::numbers().end());
  ThesisOptions options{.members = members.value_or(check ? 2000 : 100'000), .seed = seed.value_or(check ? 2 : 1)};
  std::string told;
  options.progress = [&](std::string_view what, double) {
    if (what != told) std::fprintf(stderr, "%.*s\n", static_cast<int>(what.size()), what.data());
    told = what;
  };
  const std::string all_expected = check ? expected() : "";
  Thesis thesis(options);
  std::vector<ThesisFigure> figures;
  std::vector<ThesisCheck> checks;
  for (const std::string& number : numbers) {
    figures.push_back(thesis.figure(number));
    if (expectations) std::fputs(thesis_expectations(figures.back()).c_str(), stdout);
    if (check)
      for (ThesisCheck& c : thesis_check(figures.back(), all_expected)) {
        if (!c.holds)
          std::printf("%s: found %.9g, expected %.9g, allowed %.3g\n", c.what.c_str(), c.found, c.expected, c.allowed);
        checks.push_back(std::move(c));
      }
    if (check || expectations) continue;
    std::filesystem::create_directories(out);
    const std::filesystem::path file = out / file_name(number);
    std::ofstream stream(file);
    stream << thesis_csv(figures.back());
    if (!stream.flush()) throw std::runtime_error("cannot write " + file.string());
  }
  if (check) {
    std::printf("%s\n", thesis_verdict(checks).c_str());
    return std::ranges::all_of(checks, &ThesisCheck::holds) ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  if (!expectations) std::fputs(thesis_summary(figures).c_str(), stdout);
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "thesis_figures: %s\n", error.what());
    return 2;
  }
}

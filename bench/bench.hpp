// Compares the run times of several pieces of work, and reports how reliable the comparison is.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <functional>
#include <stickslip/build_info.hpp>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace bench {

/// Makes the compiler assume that `value` is read.
template <class T>
void keep(const T& value) {
  asm volatile("" : : "g"(&value) : "memory");
}

/// The options of a bench on its command line.
struct Options {
  bool json = false;        ///< print machine-readable results
  bool check = false;       ///< check the results only
  bool additional = false;  ///< an option of this bench alone
  int rounds = 21;
};

/// Reads [--check] [--json] [--rounds N] and one more option if it is named; otherwise prints the usage and exits with
/// 2.
inline Options options(int argc, char** argv, const std::string& name, const std::string& additional = {}) {
  Options result;
  for (int i = 1; i < argc; ++i) {
    const std::string_view option = argv[i];
    if (option == "--json") {
      result.json = true;
    } else if (option == "--check") {
      result.check = true;
    } else if (!additional.empty() && option == additional) {
      result.additional = true;
    } else if (option == "--rounds" && i + 1 < argc && std::atoi(argv[i + 1]) > 0) {
      result.rounds = std::atoi(argv[++i]);
    } else {
      const std::string more = additional.empty() ? "" : " [" + additional + "]";
      std::fprintf(stderr, "usage: %s [--check] [--json] [--rounds N]%s\n", name.c_str(), more.c_str());
      std::exit(2);
    }
  }
  return result;
}

inline std::string json_string(std::string_view text) { return '"' + std::string(text) + '"'; }

/// Stops the bench: wrong results are not worth timing.
inline void require(bool holds, std::string_view what, double found, double allowed) {
  if (holds) return;
  std::fprintf(stderr, "wrong answer: %.*s: %.3g, allowed %.3g\n", static_cast<int>(what.size()), what.data(), found,
               allowed);
  std::exit(EXIT_FAILURE);
}

inline void require_below(std::string_view what, double found, double allowed) {
  require(found <= allowed, what, found, allowed);  // NaN is rejected, too
}

/// The quantile of the numbers at the given fraction.
inline double quantile(std::vector<double> numbers, double part) {
  std::sort(numbers.begin(), numbers.end());
  const double place = part * static_cast<double>(numbers.size() - 1);
  const auto below = static_cast<std::size_t>(place), above = std::min(below + 1, numbers.size() - 1);
  return numbers[below] + (place - static_cast<double>(below)) * (numbers[above] - numbers[below]);
}

/// Times of one piece of work, each round one [ns per item].
struct Timing {
  std::string name;
  std::vector<double> times;

  double least() const { return quantile(times, 0); }
  double median() const { return quantile(times, 0.5); }
  /// Interquartile range as a fraction of the median.
  double spread() const { return (quantile(times, 0.75) - quantile(times, 0.25)) / median(); }
  bool reliable() const { return spread() <= 0.1; }

  /// Median of the ratios of the same round.
  double ratio(const Timing& base) const {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < times.size(); ++i) ratios.push_back(times[i] / base.times[i]);
    return quantile(std::move(ratios), 0.5);
  }
};

/// Processor time of all threads [s]: the time used by other programs is not counted.
inline double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Wall-clock time [s].
inline double wall_time() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Pieces of work that take turns, so that a slow spell of the machine affects all of them alike.
class Bench {
 public:
  /// @param items  number of items of one round, by which its time is divided
  explicit Bench(std::size_t items, double (*clock)() = processor_time)
      : items_(static_cast<double>(items)), clock_(clock) {}

  void add(std::string name, std::function<void()> work) { add(std::move(name), items_, std::move(work)); }

  /// Work with a different number of items.
  void add(std::string name, double items, std::function<void()> work) {
    works_.push_back({std::move(name), items, std::move(work)});
  }

  /// The first round warms up, the others are timed.
  std::vector<Timing> run(int rounds) const {
    std::vector<Timing> timings;
    for (const Work& work : works_) timings.push_back({work.name, {}});
    for (int round = 0; round <= rounds; ++round)
      for (std::size_t i = 0; i < works_.size(); ++i) {
        const double begin = clock_();
        works_[i].run();
        const double taken = clock_() - begin;
        if (round > 0) timings[i].times.push_back(taken * 1e9 / works_[i].items);
      }
    return timings;
  }

 private:
  struct Work {
    std::string name;
    double items;
    std::function<void()> run;
  };

  double items_;
  double (*clock_)();
  std::vector<Work> works_;
};

/// The name that the system reports.
inline std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

inline void print_machine() {
  const stickslip::BuildInfo& build = stickslip::build_info();
  std::printf("%s, 1 of %u threads\n%s, %s %s, commit %s\n", processor().c_str(), std::thread::hardware_concurrency(),
              build.compiler.c_str(), build.build_type.c_str(), build.compiler_flags.c_str(), build.commit.c_str());
}

/// The rows as JSON: {"commit": ..., "rows": {NAME: {"median": ..., "least": ..., "spread": ...}}}.
inline void print_rows(const std::vector<Timing>& timings) {
  std::printf("{\"commit\": %s, \"rows\": {", json_string(stickslip::build_info().commit).c_str());
  const char* comma = "";
  for (const Timing& timing : timings) {
    std::printf("%s\n  %s: {\"median\": %.3f, \"least\": %.3f, \"spread\": %.3f}", comma,
                json_string(timing.name).c_str(), timing.median(), timing.least(), timing.spread());
    comma = ",";
  }
  std::printf("}}\n");
}

/// @param base  the row with which the others are compared
inline void print_table(std::string_view title, const std::vector<Timing>& timings, std::size_t base) {
  std::printf("\n%-44.*s %8s %8s %8s %8s\n", static_cast<int>(title.size()), title.data(), "median", "least", "spread",
              "ratio");
  bool reliable = true;
  for (const Timing& timing : timings) {
    std::printf("%-44s %8.2f %8.2f %7.0f%%%s %7.2f\n", timing.name.c_str(), timing.median(), timing.least(),
                100 * timing.spread(), timing.reliable() ? " " : "!", timing.ratio(timings[base]));
    reliable = reliable && timing.reliable();
  }
  if (!reliable) std::printf("! unreliable: the middle half of the rounds spreads by more than 10 %% of the median\n");
}

}  // namespace bench

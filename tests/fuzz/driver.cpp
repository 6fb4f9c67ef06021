// Generates the inputs of a fuzz target where libFuzzer is not available; gives libFuzzer the seeds where it is.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>
#include <iterator>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz.hpp"

namespace {

using namespace std::string_view_literals;
using Random = std::mt19937_64;

constexpr std::size_t longest = std::size_t{1} << 18;  // bytes of an input

std::size_t below(Random& random, std::size_t limit) {
  return limit == 0 ? 0 : static_cast<std::size_t>(random() % limit);
}

/// A whole number below `limit`, small ones as frequent as large ones.
std::size_t mostly_small(Random& random, std::size_t limit) {
  return below(random, 1 + below(random, 1 + below(random, limit)));
}

bool in_number(char c) { return std::string_view("0123456789+-.eE").find(c) != std::string_view::npos; }

void mutate(std::string& input, const std::vector<std::string>& seeds, Random& random) {
  static constexpr auto extremes = std::to_array<std::string_view>({"",
                                                                    "0",
                                                                    "-0",
                                                                    "-1",
                                                                    "1",
                                                                    "1e-320",
                                                                    "1e308",
                                                                    "-1e999",
                                                                    "1e15",
                                                                    "4294967296",
                                                                    "2147483648",
                                                                    "nan",
                                                                    "-inf",
                                                                    "Infinity",
                                                                    "1.234-100",
                                                                    "1.5+2",
                                                                    "0x1p-3",
                                                                    "*****",
                                                                    "1.5D-05",
                                                                    ".005",
                                                                    "0,5",
                                                                    "9007199254740993",
                                                                    "18446744073709551616"});
  static constexpr std::string_view alphabet = "0123456789.,;-+eEdD \n\r\t#|()[]=*xN\0\x80\xC0\xED\xFF"sv;
  const auto any_byte = [&] {
    return random() % 4 == 0 ? static_cast<char>(random()) : alphabet[below(random, alphabet.size())];
  };
  const std::size_t at = below(random, input.size() + 1), rest = input.size() - at;
  switch (random() % 7) {
    case 0:
      if (rest > 0) input[at] = static_cast<char>(input[at] ^ (1 << random() % 8));
      break;
    case 1:
      if (rest > 0) input[at] = any_byte();
      break;
    case 2:
      input.insert(at, 1 + mostly_small(random, 16), any_byte());
      break;
    case 3:
      input.erase(at, 1 + mostly_small(random, rest + 1));
      break;
    case 4: {  // repeats a stretch
      const std::string stretch = input.substr(at, 1 + mostly_small(random, rest + 1));
      const std::size_t room = longest - std::min(longest, input.size());
      std::string copies;
      for (std::size_t n = 1 + mostly_small(random, 64); n > 0 && copies.size() + stretch.size() <= room; --n)
        copies += stretch;
      input.insert(at, copies);
      break;
    }
    case 5:  // continues with another seed
      if (!seeds.empty()) {
        const std::string& other = seeds[below(random, seeds.size())];
        input = input.substr(0, at) + other.substr(below(random, other.size() + 1));
      }
      break;
    default: {  // another number
      const auto first = std::find_if(input.begin() + static_cast<std::ptrdiff_t>(at), input.end(), in_number);
      const auto last = std::find_if_not(first, input.end(), in_number);
      const std::string_view extreme = extremes[below(random, extremes.size())];
      input.replace(first, last, extreme.begin(), extreme.end());
    }
  }
}

}  // namespace

#ifdef STICKSLIP_LIBFUZZER

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t capacity);

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t capacity,
                                               unsigned int seed) {
  static const std::vector<std::string> seeds = fuzz_seeds();
  Random random(seed);
  if (random() % 4 != 0) return LLVMFuzzerMutate(data, size, capacity);
  std::string input(data, data + size);
  if (!seeds.empty() && (size < 2 || random() % 16 == 0)) input = seeds[below(random, seeds.size())];
  mutate(input, seeds, random);
  input.resize(std::min(input.size(), capacity));
  std::copy(input.begin(), input.end(), data);
  return input.size();
}

#else

// A sanitizer that reports an error aborts, so that the handler below saves the input.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() { return "abort_on_error=1"; }
extern "C" const char* __ubsan_default_options();
extern "C" const char* __ubsan_default_options() { return "abort_on_error=1:print_stacktrace=1"; }

namespace {

std::string current;        // the input that runs
char file[256] = "crash-";  // where it is saved if it fails
bool replays = false;
volatile std::sig_atomic_t interrupted = 0;

/// Saves the current input, unless it is from a file. Calls only functions that are safe in a signal handler.
void save() {
  if (replays) return;
  std::uint64_t hash = 14695981039346656037u;  // FNV-1a
  for (const char byte : current) hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211u;
  char* end = file + std::strlen(file);
  for (int shift = 60; shift >= 0; shift -= 4) *end++ = "0123456789abcdef"[hash >> shift & 15];
  *end++ = '\n';
  constexpr std::string_view message = "the input is saved in ";
  bool written =
      ::write(2, message.data(), message.size()) > 0 && ::write(2, file, static_cast<std::size_t>(end - file)) > 0;
  *--end = '\0';
  const int descriptor = ::open(file, O_WRONLY | O_CREAT | O_TRUNC, 0644);
  for (std::size_t done = 0; written && done < current.size();) {
    const ::ssize_t count = ::write(descriptor, current.data() + done, current.size() - done);
    written = count > 0;
    done += written ? static_cast<std::size_t>(count) : 0;
  }
  ::close(descriptor);
}

extern "C" void on_failure(int signal) {
  constexpr std::string_view hang = "finding: a case takes longer than a minute\n";
  if (signal == SIGALRM && ::write(2, hang.data(), hang.size()) < 0) ::_exit(2);
  save();
  ::_exit(1);
}

extern "C" void on_interrupt(int) { interrupted = 1; }

/// Runs the current input; returns whether no error was found.
bool passes() {
  ::alarm(60);
  try {
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(current.data()), current.size());
    ::alarm(0);
    return true;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "finding: an exception escapes: %s\n", error.what());
  } catch (...) {
    std::fprintf(stderr, "finding: an exception escapes\n");
  }
  return false;
}

std::string random_bytes(Random& random) {
  std::string bytes(mostly_small(random, 4096), '\0');
  for (char& byte : bytes) byte = static_cast<char>(random());
  return bytes;
}

template <class T>
T number(std::string_view option, const char* text) {
  T value{};
  const char* const end = text == nullptr ? nullptr : text + std::strlen(text);
  if (text == nullptr || std::from_chars(text, end, value).ptr != end || text == end || value < T{})
    throw std::invalid_argument(std::string(option) + " needs a number that is not negative");
  return value;
}

int run(int argc, char** argv) {
  const std::string_view program = std::string_view(argv[0]).substr(std::string_view(argv[0]).rfind('/') + 1);
  const std::string_view target = program.substr(program.find('_') + 1).substr(0, 200);
  std::strncat(file, std::string(target).append("-").c_str(), 201);

  double seconds = 10;
  std::uint64_t seed = std::random_device()();
  std::vector<std::string> files;
  for (int i = 1; i < argc; ++i)
    if (const std::string_view argument = argv[i]; argument == "--seconds")
      seconds = number<double>(argument, argv[++i]);
    else if (argument == "--seed")
      seed = number<std::uint64_t>(argument, argv[++i]);
    else if (argument.starts_with("--"))
      throw std::invalid_argument("usage: " + std::string(program) + " [--seconds S] [--seed N] [FILE...]");
    else
      files.emplace_back(argument);

#ifndef __SANITIZE_ADDRESS__  // which reports these with a stack trace
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL}) std::signal(signal, on_failure);
#endif
  for (const int signal : {SIGABRT, SIGALRM}) std::signal(signal, on_failure);
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, on_interrupt);

  if (!files.empty()) {
    replays = true;
    for (const std::string& name : files) {
      std::ifstream stream(name, std::ios::binary);
      if (!stream) throw std::invalid_argument("cannot read " + name);
      current.assign(std::istreambuf_iterator<char>(stream), {});
      if (!passes()) return 1;
    }
    std::printf("%.*s: %zu files pass\n", static_cast<int>(target.size()), target.data(), files.size());
    return 0;
  }

  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  const auto elapsed = [begin] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  const std::vector<std::string> seeds = fuzz_seeds();
  Random random(seed);
  std::uint64_t cases = 0;
  std::printf("%.*s: seed %llu\n", static_cast<int>(target.size()), target.data(),
              static_cast<unsigned long long>(seed));
  std::fflush(stdout);
  for (const std::string& whole : seeds) {
    current = whole;
    if (!passes()) return save(), 1;
  }
  for (; interrupted == 0 && (seconds == 0 || elapsed() < seconds); ++cases) {
    if (seeds.empty() || random() % 16 == 0) {
      current = random_bytes(random);
    } else {
      current = seeds[below(random, seeds.size())];
      for (std::size_t n = 1 + mostly_small(random, 16); n > 0; --n) mutate(current, seeds, random);
    }
    if (!passes()) return save(), 1;
  }
  std::printf("%.*s: %llu cases pass, %.0f a second\n", static_cast<int>(target.size()), target.data(),
              static_cast<unsigned long long>(cases), static_cast<double>(cases) / elapsed());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}

#endif

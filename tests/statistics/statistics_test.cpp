// Sums over members: they are the named moments, in whatever order the members are merged.
#include "stickslip/statistics/tally.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

#include "lanes/instruction_sets.hpp"
#include "lanes/row_moments.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;
using detail::Sketch;
using detail::Tally;
using detail::TallyTree;

namespace {

constexpr std::size_t times = 11, frequencies = 5;

/// The values of a member.
struct Member {
  std::array<double, times> x, v;
  std::array<double, frequencies> density;
  std::array<double, detail::features> feature;
};

/// Members whose means, scales and skewness differ from time to time and from block to block.
std::vector<Member> members(std::uint64_t seed, std::size_t count, double offset = 0) {
  std::mt19937_64 bits(seed);
  std::normal_distribution<double> normal;
  std::vector<Member> result(count);
  for (Member& m : result) {
    for (std::size_t i = 0; i < times; ++i) {
      const double z = normal(bits);
      m.x[i] = offset + 0.3 * static_cast<double>(i) + std::exp(z / 2) + static_cast<double>(seed % 7);
      m.v[i] = offset + z + 0.5 * normal(bits) - 0.2 * static_cast<double>(seed % 5);
    }
    for (double& d : m.density) d = std::exp(normal(bits));
    for (double& f : m.feature) f = offset + normal(bits);
  }
  return result;
}

constexpr std::array<std::array<int, 2>, Tally::moments> powers = {
    {{0, 0}, {0, 0}, {2, 0}, {1, 1}, {0, 2}, {3, 0}, {2, 1}, {1, 2}, {0, 3}, {4, 0}, {2, 2}, {0, 4}}};

long double power(long double base, int exponent) {
  long double result = 1;
  for (int i = 0; i < exponent; ++i) result *= base;
  return result;
}

/// The tally of members, and the same sums of magnitudes, by which errors are measured; two passes in long double.
struct Direct {
  Tally tally{times, frequencies}, magnitude{times, frequencies};

  explicit Direct(const std::vector<Member>& all) {
    using Real = long double;
    const auto n = static_cast<Real>(all.size());
    tally.count = all.size();
    const auto mean_of = [&](auto value) {
      Real sum = 0, magnitudes = 0;
      for (const Member& m : all) sum += value(m), magnitudes += std::abs(static_cast<Real>(value(m)));
      return std::pair{sum / n, magnitudes / n};
    };
    const auto put = [](double& to, double& size, std::pair<Real, Real> both) {
      to = static_cast<double>(both.first);
      size = static_cast<double>(both.second);
    };
    for (std::size_t i = 0; i < times; ++i) {
      const auto x = mean_of([i](const Member& m) { return m.x[i]; });
      const auto v = mean_of([i](const Member& m) { return m.v[i]; });
      put(tally.moment(Tally::x)[i], magnitude.moment(Tally::x)[i], x);
      put(tally.moment(Tally::v)[i], magnitude.moment(Tally::v)[i], v);
      for (std::size_t k = Tally::xx; k < Tally::moments; ++k) {
        Real sum = 0, size = 0;
        for (const Member& m : all) {
          const Real term = power(m.x[i] - x.first, powers[k][0]) * power(m.v[i] - v.first, powers[k][1]);
          sum += term, size += std::abs(term);
        }
        put(tally.moment(static_cast<Tally::Moment>(k))[i], magnitude.moment(static_cast<Tally::Moment>(k))[i],
            {sum, size});
      }
    }
    for (std::size_t f = 0; f < frequencies; ++f) {
      const auto mean = mean_of([f](const Member& m) { return m.density[f]; });
      put(tally.density_mean()[f], magnitude.density_mean()[f], mean);
      Real sum = 0;
      for (const Member& m : all) sum += power(m.density[f] - mean.first, 2);
      put(tally.density_scatter()[f], magnitude.density_scatter()[f], {sum, sum});
    }
    std::array<Real, detail::features> mean{};
    for (std::size_t a = 0; a < detail::features; ++a) {
      const auto both = mean_of([a](const Member& m) { return m.feature[a]; });
      put(tally.mean(a), magnitude.mean(a), both);
      mean[a] = both.first;
    }
    for (std::size_t a = 0; a < detail::features; ++a)
      for (std::size_t b = 0; b < detail::features; ++b) {
        Real sum = 0, size = 0;
        for (const Member& m : all) {
          const Real term = (m.feature[a] - mean[a]) * (m.feature[b] - mean[b]);
          sum += term, size += std::abs(term);
        }
        put(tally.scatter(a, b), magnitude.scatter(a, b), {sum, size});
      }
  }
};

/// Largest difference of any sum, relative to the sum of the magnitudes of its terms.
double worst(const Tally& got, const Direct& want) {
  double result = got.count == want.tally.count && got.sums().size() == want.tally.sums().size() ? 0 : infinity;
  for (std::size_t i = 0; i < got.sums().size(); ++i) {
    const double error = std::abs(got.sums()[i] - want.tally.sums()[i]) / want.magnitude.sums()[i];
    result = std::max(result, std::isnan(error) ? infinity : error);
  }
  return result;
}

std::vector<Member> joined(std::vector<Member> a, const std::vector<Member>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

bool same_bits(const Tally& a, const Tally& b) { return a.count == b.count && std::ranges::equal(a.sums(), b.sums()); }

}  // namespace

TEST_CASE("the tallies of two sets merge into that of their union", "[statistics]") {
  // A shifted moment is a sum of up to eight products; their magnitudes add up to less than 2^4 of those of the union,
  // and each has some eight roundings of 1.1e-16: 2e-14, twice (left and right). What is put in is rounded too.
  for (const auto& [left, right] : {std::pair{64, 64}, std::pair{64, 1}, std::pair{1, 64}, std::pair{1, 1},
                                    std::pair{1000, 3}, std::pair{7, 500}}) {
    const auto a = members(3, static_cast<std::size_t>(left)), b = members(11, static_cast<std::size_t>(right));
    const Direct whole(joined(a, b));
    on_each_instruction_set([&](const std::string& set) {
      Tally merged = Direct(a).tally;
      merged.merge(Direct(b).tally);
      INFO(set << ": " << left << " and " << right);
      CHECK(worst(merged, whole) < 5e-14);
    });
  }
}

TEST_CASE("an empty tally changes nothing, from either side", "[statistics]") {
  const Tally some = Direct(members(3, 20)).tally;
  Tally left = some, right;
  left.merge(Tally());
  right.merge(some);
  CHECK(same_bits(left, some));
  CHECK(same_bits(right, some));
}

TEST_CASE("many merges one after another lose no more than their roundings", "[statistics]") {
  // 200 blocks in a row: the roundings of 200 merges, of either sign: 5e-14 sqrt(200) = 7e-13 even if each were that
  // bad.
  std::vector<Member> all;
  Tally sum;
  for (std::uint64_t block = 0; block < 200; ++block) {
    const auto some = members(block, 1 + block % 9);
    sum.merge(Direct(some).tally);
    all = joined(std::move(all), some);
  }
  CHECK(worst(sum, Direct(all)) < 7e-13);
}

TEST_CASE("a variance of 1 about a mean of 1e8 keeps its digits", "[statistics]") {
  // Means are rounded to 1.5e-8, four times in a merge. The blocks' means differ by some 2 (the seeds' offsets), and
  // the variance is off by twice the product, 2.4e-7, of itself 1.2e-7; fourth moments by twice that.
  std::vector<Member> all;
  Tally sum;
  for (std::uint64_t block = 0; block < 20; ++block) {
    const auto some = members(block, 64, 1e8);
    Tally tally(times, frequencies);
    tally.count = some.size();
    for (std::size_t i = 0; i < times; ++i) {
      std::vector<double> x, v;
      for (const Member& m : some) x.push_back(m.x[i]), v.push_back(m.v[i]);
      detail::row_moments(x.data(), v.data(), some.size(), tally.sums().data() + i, times, nullptr);
    }
    sum.merge(tally);
    all = joined(std::move(all), some);
  }
  const Direct direct(all);
  for (std::size_t k = 0; k < Tally::moments; ++k)
    for (std::size_t i = 0; i < times; ++i) {
      const auto m = static_cast<Tally::Moment>(k);
      INFO("moment " << k);
      REQUIRE(std::abs(sum.moment(m)[i] - direct.tally.moment(m)[i]) <=
              (k < Tally::xx ? 1e-15 : 2.5e-7) * direct.magnitude.moment(m)[i]);
    }
}

TEST_CASE("a row of any number of members has the moments of just those, on every instruction set", "[statistics]") {
  // 64 additions and five roundings in each term, and those of the mean: together below 1e-14 of the same sums about
  // zero.
  constexpr std::size_t stride = 3, width = 64;
  const auto all = members(5, width);
  for (std::size_t count = 1; count <= width; ++count) {
    const std::vector<Member> some(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count));
    const Direct direct(some);
    std::vector<double> x(width, not_a_number), v(width, not_a_number);  // values past the last member are ignored
    for (std::size_t i = 0; i < count; ++i) x[i] = some[i].x[0], v[i] = some[i].v[0];
    on_each_instruction_set([&](const std::string& set) {
      INFO(set << ": " << count << " members");
      std::vector<double> sums(Tally::moments * stride, -7), again = sums;
      std::vector<double> central(4 * width, 1);
      const detail::CentralSums adds{&central[0], &central[width], &central[2 * width], &central[3 * width]};
      detail::row_moments(x.data(), v.data(), count, sums.data(), stride, nullptr);
      detail::row_moments(x.data(), v.data(), count, again.data(), stride, &adds);
      bool right = sums == again;
      for (std::size_t k = 0; k < Tally::moments; ++k) {
        const auto m = static_cast<Tally::Moment>(k);
        long double about_zero = 0;
        for (const Member& one : some)
          about_zero += std::abs(power(one.x[0], k == Tally::x ? 1 : powers[k][0]) *
                                 power(one.v[0], k == Tally::v ? 1 : powers[k][1]));
        right = right && std::abs(sums[k * stride] - direct.tally.moment(m)[0]) <= 1e-14L * about_zero;
        right = right && sums[k * stride + 1] == -7 && sums[k * stride + 2] == -7;
      }
      REQUIRE(right);
      const double mean_x = sums[0], mean_v = sums[stride];
      for (std::size_t i = 0; i < count; ++i) {
        const double e = x[i] - mean_x, f = v[i] - mean_v;
        right = right && central[i] == Approx(1 + v[i]).epsilon(1e-14) &&
                central[width + i] == Approx(1 + f * f).epsilon(1e-14) &&
                central[2 * width + i] == Approx(1 + f * f * f * f).epsilon(1e-14) &&
                central[3 * width + i] == Approx(1 + e * f).epsilon(1e-14).margin(1e-14);
      }
      REQUIRE(right);
    });
  }
}

TEST_CASE("moments of any number of times merge, on every instruction set", "[statistics]") {
  for (std::size_t count = 1; count <= 20; ++count) {
    const auto random = gaussian(count, 2 * Tally::moments * count, 1);
    std::vector<double> left(random.begin(), random.begin() + static_cast<std::ptrdiff_t>(Tally::moments * count));
    const std::vector<double> right(random.begin() + static_cast<std::ptrdiff_t>(left.size()), random.end());
    // One by one they do not know of their neighbors.
    std::vector<double> one_by_one = left;
    for (std::size_t i = 0; i < count; ++i) {
      std::array<double, Tally::moments> l{}, r{};
      for (std::size_t k = 0; k < Tally::moments; ++k) l[k] = left[k * count + i], r[k] = right[k * count + i];
      detail::merge_moments(3, 5, l.data(), r.data(), 1);
      for (std::size_t k = 0; k < Tally::moments; ++k) one_by_one[k * count + i] = l[k];
    }
    on_each_instruction_set([&](const std::string& set) {
      std::vector<double> merged = left;
      detail::merge_moments(3, 5, merged.data(), right.data(), count);
      INFO(set << ": " << count << " times");
      CHECK(difference(merged, one_by_one) <= 1e-13);  // of numbers up to 10
    });
  }
}

TEST_CASE("a tree of tallies has the same bits, in whatever order and parts its blocks came", "[statistics]") {
  constexpr std::size_t blocks = 13;
  std::vector<Tally> leaves;
  for (std::uint64_t block = 0; block < blocks; ++block) leaves.push_back(Direct(members(block, 5 + block % 3)).tally);
  const auto tree_of = [&](const std::vector<std::size_t>& which) {
    TallyTree tree;
    for (const std::size_t block : which) tree.insert({0, block}, leaves[block]);
    return tree;
  };
  std::vector<std::size_t> order(blocks);
  std::iota(order.begin(), order.end(), 0);
  const TallyTree in_order = tree_of(order);
  const Tally total = in_order.total();
  CHECK(in_order.nodes().size() == 3);  // of 8, 4 and 1 blocks
  CHECK(in_order.count() == total.count);

  std::mt19937_64 bits(1);
  for (int trial = 0; trial < 200; ++trial) {
    std::ranges::shuffle(order, bits);
    REQUIRE(same_bits(tree_of(order).total(), total));
    // Three parts, each a tree, put together.
    const std::size_t first = bits() % (blocks + 1), second = first + bits() % (blocks + 1 - first);
    const auto part = [&](std::size_t begin, std::size_t end) {
      return tree_of(
          {order.begin() + static_cast<std::ptrdiff_t>(begin), order.begin() + static_cast<std::ptrdiff_t>(end)});
    };
    TallyTree whole = part(first, second);
    for (const TallyTree& other : {part(second, blocks), part(0, first)})
      for (const auto& [place, tally] : other.nodes()) whole.insert(place, tally);
    REQUIRE(whole.nodes().size() == in_order.nodes().size());
    REQUIRE(same_bits(whole.total(), total));
  }
}

TEST_CASE("a tree lists the blocks that it holds", "[statistics]") {
  TallyTree tree;
  CHECK_FALSE(tree.overlaps({0, 0}));
  CHECK(tree.total().count == 0);
  const Tally leaf = Direct(members(1, 2)).tally;
  for (const std::uint64_t block : {4U, 5U, 6U, 7U, 10U}) tree.insert({0, block}, leaf);
  REQUIRE(tree.nodes().size() == 2);
  CHECK(tree.nodes().contains({2, 1}));
  CHECK(tree.count() == 10);
  for (std::uint64_t block = 0; block < 12; ++block)
    CHECK(tree.overlaps({0, block}) == ((block >= 4 && block < 8) || block == 10));
  CHECK(tree.overlaps({1, 5}));        // 10 and 11
  CHECK(tree.overlaps({3, 0}));        // 0 to 7
  CHECK(tree.overlaps({60, 0}));       // all there are
  CHECK_FALSE(tree.overlaps({2, 0}));  // 0 to 3
  CHECK_FALSE(tree.overlaps({2, 3}));  // 12 to 15
  CHECK_FALSE(tree.overlaps({60, 1}));
}

TEST_CASE("a sketch gives any value of a sample to its accuracy", "[statistics]") {
  std::mt19937_64 bits(2);
  std::normal_distribution<double> normal(0, 40);
  std::vector<double> values = {0, 0, 0, 1e-300, 1e300, 5e-324};
  for (int i = 0; i < 5000; ++i) values.push_back(std::exp(normal(bits)));
  Sketch sketch;
  for (const double value : values) sketch.add(value);
  std::ranges::sort(values);
  REQUIRE(sketch.count() == values.size());
  bool close = true;
  for (std::size_t rank = 0; rank < values.size(); ++rank) {
    if (values[rank] != 0 && values[rank] < 1e-307) continue;  // where doubles themselves are coarser
    close = close && std::abs(sketch.value_at(rank) - values[rank]) <= (Sketch::accuracy + 1e-9) * values[rank];
  }
  CHECK(close);

  // A level is known to a bin: what is counted as above exceeds it, and what exceeds it by a bin's width is counted.
  bool bounded = sketch.above(0) == values.size() - 3;
  const auto exceed = [&](double level) {
    return static_cast<std::uint64_t>(std::ranges::count_if(values, [&](double value) { return value > level; }));
  };
  for (std::size_t i = 4; i < values.size(); i += 7) {
    const std::uint64_t above = sketch.above(values[i]);
    bounded = bounded && above <= exceed(values[i]) && above >= exceed(values[i] * (1 + 2.01 * Sketch::accuracy));
  }
  CHECK(bounded);
}

TEST_CASE("sketches merge exactly, in any order, and come back from their bins", "[statistics]") {
  std::array<Sketch, 3> parts;
  Sketch all;
  const auto values = gaussian(3, 3000, 1);
  for (std::size_t i = 0; i < values.size(); ++i) {
    parts[i % 3].add(std::abs(values[i]));
    all.add(std::abs(values[i]));
  }
  Sketch forward = parts[0], backward = parts[2];
  forward.merge(parts[1]), forward.merge(parts[2]);
  backward.merge(parts[1]), backward.merge(parts[0]);
  CHECK(forward.bins() == all.bins());
  CHECK(backward.bins() == all.bins());
  CHECK(forward.count() == 3000);
  const Sketch read = Sketch::from_bins(all.bins());
  CHECK(read.count() == 3000);
  CHECK(read.value_at(1500) == all.value_at(1500));
}

TEST_CASE("bins that no values fall into are refused", "[statistics][errors]") {
  Sketch ends;
  ends.add(0), ends.add(5e-324), ends.add(1.7976931348623157e308);
  CHECK(Sketch::from_bins(ends.bins()).count() == 3);
  const std::int32_t highest = ends.bins().rbegin()->first;
  const auto refuses = [](std::map<std::int32_t, std::uint64_t> bins, const char* text) {
    CHECK_THROWS_WITH(Sketch::from_bins(std::move(bins)), Catch::Matchers::ContainsSubstring(text));
  };
  refuses({{highest + 1, 1}}, "a bin must be");
  refuses({{-highest * 2, 1}}, "a bin must be");
  refuses({{0, 0}}, "counts must be positive and add up to less than 2^64, got 0");
  refuses({{0, UINT64_MAX}, {1, 1}}, "counts must be positive and add up to less than 2^64, got 1");
}

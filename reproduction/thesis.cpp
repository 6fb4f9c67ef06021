// The list of figures, their output as text, their summary, and the comparison with the expected values.
#include "reproduction/thesis.hpp"
#include <stickslip/base/error.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "reproduction/figures.hpp"

namespace stickslip {

namespace {

struct Entry {
  std::string_view number;
  ThesisFigure (*draw)(Thesis&);
};

constexpr std::array contents{
    Entry{"2.1", detail::figure_2_1}, Entry{"2.2", detail::figure_2_2},          Entry{"2.3", detail::figure_2_3},
    Entry{"2.4", detail::figure_2_4}, Entry{"2.5", detail::figure_2_5},          Entry{"2.6", detail::figure_2_6},
    Entry{"3.1", detail::figure_3_1}, Entry{"3.2", detail::figure_3_2},          Entry{"3.3", detail::figure_3_3},
    Entry{"4.1", detail::figure_4_1}, Entry{"4.2", detail::figure_4_2},          Entry{"4.3", detail::figure_4_3},
    Entry{"4.4", detail::figure_4_4}, Entry{"4.5", detail::figure_4_5},          Entry{"4.6", detail::figure_4_6},
    Entry{"4.7", detail::figure_4_7}, Entry{"4.8", detail::figure_4_8},          Entry{"5.1", detail::figure_5_1},
    Entry{"5.2", detail::figure_5_2}, Entry{"5.3", detail::figure_5_3},          Entry{"5.4", detail::figure_5_4},
    Entry{"5.5", detail::figure_5_5}, Entry{"5.6", detail::figure_5_6},          Entry{"Table 5.1", detail::table_5_1},
    Entry{"5.7", detail::figure_5_7}, Entry{"Section 5.6", detail::section_5_6}, Entry{"A.2", detail::figure_a_2}};

constexpr auto listed = [] {
  std::array<std::string_view, contents.size()> result{};
  for (std::size_t i = 0; i < contents.size(); ++i) result[i] = contents[i].number;
  return result;
}();

std::string format(const char* form, double value) {
  char text[40];
  std::snprintf(text, sizeof text, form, value);
  return text;
}
std::string exactly(double value) { return format("%.17g", value); }

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + '"';
}

// A number in the format of the summary.
std::string digits(double value) { return format("%.4g", value); }
std::string digits(double value, double error) {
  return error > 0 ? digits(value) + " +- " + format("%.1g", error) : digits(value);
}

// One checked number: its position and value.
struct Number {
  std::string place;
  double value, error;
  std::uint64_t members;
};

// All points of simulations, up to nine points of each other curve, three numbers of each statement.
std::vector<Number> numbers_of(const ThesisFigure& figure) {
  std::vector<Number> result;
  for (std::size_t p = 0; p < figure.panels.size(); ++p)
    for (std::size_t c = 0; c < figure.panels[p].curves.size(); ++c) {
      const ThesisCurve& curve = figure.panels[p].curves[c];
      if (curve.y.empty()) continue;
      const std::size_t last = curve.y.size() - 1, parts = curve.members > 0 ? last : std::min<std::size_t>(last, 8);
      for (std::size_t i = 0; i <= parts; ++i) {
        const std::size_t at = parts == 0 ? 0 : i * last / parts;
        const std::string place = std::to_string(p) + "/" + std::to_string(c) + "/" + std::to_string(at);
        result.push_back({place + " x", curve.x[at], 0, 0});
        result.push_back({place + " y", curve.y[at], curve.error.empty() ? 0 : curve.error[at], curve.members});
      }
    }
  for (std::size_t s = 0; s < figure.statements.size(); ++s) {
    const ThesisStatement& statement = figure.statements[s];
    const std::string place = "statement/" + std::to_string(s);
    result.push_back({place, statement.found, statement.error, statement.members});
    result.push_back({place + " said", statement.said, 0, 0});
    result.push_back({place + " within", statement.within, 0, 0});
  }
  return result;
}

// What a panel, a curve or a statement says, in one line. The place begins with "text", which no number's does.
using Texts = std::map<std::string, std::string, std::less<>>;

// The label without the number of members, which differs from run to run.
std::string lasting_label(const ThesisCurve& curve) {
  std::string label = curve.label;
  if (curve.members == 0) return label;
  const std::string members = detail::number(curve.members);
  if (const std::size_t at = label.find(members); at != std::string::npos) label.replace(at, members.size(), "N");
  return label;
}

/// @param expected  the numbers expected of the statements, by place: the verdicts are those on these numbers, which
///                  have the same standard errors in every run
Texts texts_of(const ThesisFigure& figure, const std::map<std::string, Estimate, std::less<>>& expected) {
  Texts result;
  for (std::size_t p = 0; p < figure.panels.size(); ++p) {
    const ThesisPanel& panel = figure.panels[p];
    const auto axis = [](const std::string& name, bool log) { return name + (log ? " (logarithmic)" : ""); };
    result.emplace("text " + std::to_string(p),
                   panel.title + " | " + axis(panel.x, panel.log_x) + " | " + axis(panel.y, panel.log_y));
    for (std::size_t c = 0; c < panel.curves.size(); ++c)
      result.emplace("text " + std::to_string(p) + "/" + std::to_string(c),
                     std::string(stickslip::name_of(panel.curves[c].kind)) + " | " + lasting_label(panel.curves[c]));
  }
  for (std::size_t s = 0; s < figure.statements.size(); ++s) {
    const ThesisStatement& statement = figure.statements[s];
    const std::string place = "statement/" + std::to_string(s);
    const auto number = expected.find(place);
    const bool agrees = number == expected.end() ? statement.agrees() : statement.agrees_with(number->second);
    result.emplace("text " + place, statement.where + " | " + statement.claim + " | " + name_of(statement.bound) +
                                        " | " + (agrees ? "agrees" : "differs"));
  }
  return result;
}

// One expected number: its position, value, standard error, and the members from which it was computed.
struct Expected {
  std::string place;
  double value, error, members;

  // The key of its scale: the curve and the axis, "0/3/", "x"; a statement has its own.
  std::string scale() const {
    return place.starts_with("statement") ? place : place.substr(0, place.rfind('/')) + place.back();
  }
};

struct Expectations {
  std::vector<Expected> numbers;
  Texts texts;
};

Expectations expectations_of(const std::string& number, const std::string& expectations) {
  Expectations result;
  std::istringstream lines(expectations);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(number + ',')) continue;
    std::array<std::string, 5> cells;
    std::istringstream row(line);
    for (std::string& cell : cells) std::getline(row, cell, ',');
    if (cells[1].starts_with("text "))
      result.texts.emplace(cells[1], line.substr(cells[0].size() + cells[1].size() + 2));
    else
      result.numbers.push_back(
          {cells[1], std::stod(cells[2]), std::stod(cells[3]), cells[4].empty() ? 0 : std::stod(cells[4])});
  }
  return result;
}

}  // namespace

namespace detail {

std::string number(double value) { return format("%.6g", value); }

std::string number(std::uint64_t count) {
  std::string text = std::to_string(count);
  for (std::size_t place = text.size(); place > 3;) text.insert(place -= 3, 1, ',');
  return text;
}

ThesisStatement about(std::string where, std::string claim, double said, double within, Estimate found,
                      std::string why) {
  return {std::move(where), std::move(claim), Bound::about, said, within, found.value, found.error, std::move(why)};
}
ThesisStatement at_most(std::string where, std::string claim, double said, Estimate found, std::string why) {
  return {std::move(where), std::move(claim), Bound::at_most, said, 0, found.value, found.error, std::move(why)};
}
ThesisStatement at_least(std::string where, std::string claim, double said, Estimate found, std::string why) {
  return {std::move(where), std::move(claim), Bound::at_least, said, 0, found.value, found.error, std::move(why)};
}

}  // namespace detail

bool ThesisStatement::agrees_with(Estimate number) const {
  const double scatter = 3 * number.error;
  switch (bound) {
    case Bound::at_most:
      return number.value <= said * (1 + 1e-12) + scatter;
    case Bound::at_least:
      return number.value >= said * (1 - 1e-12) - scatter;
    default:
      return std::abs(number.value - said) <= within + scatter || number.value == said;
  }
}

const char* name_of(ThesisCurve::Kind kind) noexcept {
  constexpr std::array names{"thesis", "theory", "exact", "unstable", "points", "simulation", "limit", "region"};
  return names[static_cast<std::size_t>(kind)];
}

const char* name_of(ThesisStatement::Bound bound) noexcept {
  constexpr std::array names{"about", "at most", "at least"};
  return names[static_cast<std::size_t>(bound)];
}

Thesis::Thesis(ThesisOptions options) : options_(std::move(options)) {
  detail::require(options_.members >= 100, "Thesis: members must be at least 100",
                  static_cast<double>(options_.members));
}

std::span<const std::string_view> Thesis::numbers() noexcept { return listed; }

ThesisFigure Thesis::figure(std::string_view number) {
  const auto entry = std::ranges::find(contents, number, &Entry::number);
  if (entry == contents.end()) {
    std::string message = "Thesis: number must be one of";
    for (const Entry& e : contents) message += (e.number == contents[0].number ? " " : ", ") + std::string(e.number);
    throw std::invalid_argument(message + ", got " + std::string(number));
  }
  number_ = number;
  if (options_.progress) options_.progress(number_, 0);
  const auto begin = std::chrono::steady_clock::now();
  ThesisFigure figure = entry->draw(*this);
  for (ThesisStatement& statement : figure.statements)
    if (statement.error > 0 && statement.members == 0) statement.members = options_.members;
  figure.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return figure;
}

const Ensemble& Thesis::ensemble(const std::string& what, std::uint64_t members, bool velocity_spectrum,
                                 const std::function<Ensemble(const EnsembleOptions&)>& run) {
  const std::string key = what + ", " + std::to_string(members) + (velocity_spectrum ? ", spectrum" : "");
  if (const auto kept = ensembles_.find(key); kept != ensembles_.end()) return kept->second;
  EnsembleOptions options{
      .members = members, .seed = options_.seed, .threads = options_.threads, .velocity_spectrum = velocity_spectrum};
  if (options_.progress)
    options.progress = [&](const EnsembleProgress& progress) {
      options_.progress(number_ + ": " + what,
                        static_cast<double>(progress.done) / static_cast<double>(progress.members));
    };
  return ensembles_.emplace(key, run(options)).first->second;
}

std::string thesis_csv(const ThesisFigure& figure) {
  std::string text = "panel,label,kind,members,x,y,error\n";
  for (const ThesisPanel& panel : figure.panels)
    for (const ThesisCurve& curve : panel.curves)
      for (std::size_t i = 0; i < curve.x.size(); ++i)
        text += quoted(panel.title) + ',' + quoted(curve.label) + ',' + name_of(curve.kind) + ',' +
                std::to_string(curve.members) + ',' + exactly(curve.x[i]) + ',' + exactly(curve.y[i]) + ',' +
                (curve.error.empty() ? "" : exactly(curve.error[i])) + '\n';
  return text;
}

std::string thesis_summary(std::span<const ThesisFigure> figures) {
  std::ostringstream text;
  for (const ThesisFigure& figure : figures) {
    text << (figure.number.find(' ') != std::string::npos ? "" : "Figure ") << figure.number << ", "
         << format("%.2g", figure.seconds) << " s";
    if (!figure.thesis_cost.empty()) text << " (the thesis: " << figure.thesis_cost << ")";
    text << '\n';
    for (const ThesisStatement& s : figure.statements) {
      const bool exact = s.bound == ThesisStatement::Bound::about;
      text << (s.agrees() ? "  agrees  " : "  differs ") << (s.where.empty() ? "here" : s.where) << ": " << s.claim
           << ": " << (exact ? "" : name_of(s.bound) + std::string(" ")) << digits(s.said)
           << (s.where.empty() ? " (documentation), " : " (thesis), ") << digits(s.found, s.error) << " here"
           << (s.why.empty() ? "" : "; " + s.why) << '\n';
    }
  }
  return text.str();
}

std::string thesis_expectations(const ThesisFigure& figure) {
  std::string text;
  for (const Number& n : numbers_of(figure))
    text += figure.number + ',' + n.place + ',' + format("%.9g", n.value) + ',' + format("%.3g", n.error) +
            (n.error > 0 ? ',' + std::to_string(n.members) : "") + '\n';
  for (const auto& [place, said] : texts_of(figure, {})) text += figure.number + ',' + place + ',' + said + '\n';
  return text;
}

std::vector<ThesisCheck> thesis_check(const ThesisFigure& figure, const std::string& expectations) {
  const auto& [expected, expected_texts] = expectations_of(figure.number, expectations);
  std::map<std::string, double, std::less<>> scales;  // the largest expected magnitude of each curve
  std::map<std::string, Estimate, std::less<>> estimates;
  for (const Expected& e : expected) {
    if (std::isfinite(e.value)) scales[e.scale()] = std::max(scales[e.scale()], std::abs(e.value));
    estimates[e.place] = {e.value, e.error};
  }
  std::map<std::string, Number, std::less<>> found;
  for (Number& n : numbers_of(figure)) found.emplace(n.place, n);

  std::vector<ThesisCheck> checks;
  for (const Expected& e : expected) {
    const std::string what = figure.number + " " + e.place;
    const auto entry = found.extract(e.place);
    if (entry.empty()) {
      checks.push_back({what + " (missing)", std::nan(""), e.value, 0, false, false});
      continue;
    }
    const Number& n = entry.mapped();
    // The error of the expected value, and that of the number of members simulated here.
    const double error = e.error * std::sqrt(1 + (n.members > 0 ? e.members / static_cast<double>(n.members) : 0));
    const double allowed = 5 * error + 1e-6 * std::abs(e.value) + 1e-12 * scales[e.scale()];
    const bool same = n.value == e.value || (std::isnan(n.value) && std::isnan(e.value));
    checks.push_back({what, n.value, e.value, allowed, same || std::abs(n.value - e.value) <= allowed,
                      e.value != 0 && allowed >= 0.5 * std::abs(e.value)});
  }
  for (const auto& [place, n] : found)
    checks.push_back({figure.number + " " + place + " (not expected)", n.value, std::nan(""), 0, false, false});

  const auto add_text = [&](const std::string& what, bool holds) {
    checks.push_back({figure.number + " " + what, std::nan(""), std::nan(""), 0, holds, false});
  };
  Texts texts = texts_of(figure, estimates);
  for (const auto& [place, text] : expected_texts) {
    const auto entry = texts.extract(place);
    if (entry.empty())
      add_text(place + " (missing): " + text, false);
    else if (entry.mapped() == text)
      add_text(place + ": " + text, true);
    else
      add_text(place + ": " + entry.mapped() + " (expected: " + text + ")", false);
  }
  for (const auto& [place, text] : texts) add_text(place + " (not expected): " + text, false);
  return checks;
}

std::string thesis_verdict(std::span<const ThesisCheck> checks) {
  const auto off = std::ranges::count(checks, false, &ThesisCheck::holds);
  const auto loose = std::ranges::count(checks, true, &ThesisCheck::loose);
  const auto texts =
      std::ranges::count_if(checks, [](const ThesisCheck& c) { return std::isnan(c.found) && std::isnan(c.expected); });
  return std::to_string(static_cast<std::ptrdiff_t>(checks.size()) - texts) + " numbers and " + std::to_string(texts) +
         " texts checked, none skipped; " + std::to_string(loose) +
         " numbers with so few members that half of them would hold too; " + std::to_string(off) + " off";
}

}  // namespace stickslip

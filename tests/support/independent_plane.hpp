// An independent opinion on sliders in the plane, in long double. While it slides, it integrates in polar form
//     t' = u,   r' = u^2 e,   (ln u)' = q.e - w a - c u,   phi' = q x e,   e = (cos phi, sin phi),
// in regularized time dt = u d(tau), by extrapolation of the midpoint rule; a stop is where u has fallen by 18 orders.
// A slip that begins smoothly starts with the fixed point of collocation. It shares nothing with the library.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

namespace test {

class IndependentPlane {
 public:
  using Real = long double;
  static constexpr Real g = 9.80665L;
  static constexpr Real never = std::numeric_limits<Real>::infinity();

  /// Friction per unit mass under weight 1: while it slides, as a function of path and speed, and at rest. Between
  /// `knots` of the path it is smooth, and continues smoothly beyond them for the given piece.
  struct Level {
    std::function<Real(std::size_t piece, Real path, Real speed)> resist;
    std::function<Real(Real path)> hold;
    std::vector<Real> knots{};
  };
  struct Mounting {
    Real natural_frequency = 0, damping = 0;
    bool pendulum = false;
    Real gap = never, restitution = 0;
    bool flight = true;
  };
  /// The load and the normal force, linear within the duration.
  struct Segment {
    Real duration;
    std::array<Real, 2> start, end;
    Real normal_start = g, normal_end = g;
  };
  enum class Kind { breakaway, arrest, reversal, impact, liftoff, landing };
  struct Event {
    Kind kind;
    Real time;
  };
  enum class Mode { stuck, sliding, along };
  struct TooLong : std::runtime_error {
    TooLong() : std::runtime_error("more steps than this integrator is meant for") {}
  };

  IndependentPlane(Level level, Mounting mounting) : level_(std::move(level)), on_(mounting) {}

  Real x = 0, y = 0, vx = 0, vy = 0, path = 0;
  Mode mode = Mode::stuck;
  bool in_flight = false;
  Real height = 0, climb = 0;  // gap to the ground and its rate
  Real peak = 0, dissipated = 0, damped = 0, lost = 0;
  std::vector<Event> events{};
  Real clock = 0;  // time since the first segment
  Real min_speed = never;
  long steps = 0, max_steps = 200'000;
  Real tolerance = 1e-17L;

  void begin(Real px, Real py, Real ux, Real uy) {
    x = px, y = py, vx = ux, vy = uy;
    mode = ux != 0 || uy != 0 ? Mode::sliding : Mode::stuck;
    peak = std::hypot(x, y);
  }

  void advance(Segment s) {
    const Real from = clock, duration = s.duration;
    Real done = 0;
    const auto normal = [&](Real t) { return s.normal_start + (s.normal_end - s.normal_start) * (t / duration); };
    while (done < duration) {
      const Real n0 = normal(done), n1 = s.normal_end, left = duration - done;
      const Real zero = n0 * n1 < 0 ? done + left * (n0 / (n0 - n1)) : duration;
      if (in_flight) {
        const Real rate = (n1 - n0) / left;
        const auto above = [&](Real t) { return height + t * (climb - t * (n0 / 2 + t * rate / 6)); };
        Real lands = never;
        Real before = left * 1e-12L;
        for (int i = 1; i <= 4000 && lands == never; ++i) {
          const Real after = left * i / 4000;
          if (above(after) <= 0) {
            Real low = before, high = after;
            for (int k = 0; k < 80; ++k) {
              const Real middle = (low + high) / 2;
              (above(middle) > 0 ? low : high) = middle;
            }
            lands = high;
          }
          before = after;
        }
        const Real t = std::min(lands, left);
        part(s, duration, done, done + t, from, false);
        const Real up = above(t), rises = climb - t * (n0 + t * rate / 2);
        height = std::max(up, Real(0)), climb = rises;
        done = t < left ? done + t : duration;
        if (lands == never) continue;
        clock = from + done;
        tell(Kind::landing);
        in_flight = false;
        const Real impulse = std::max(-climb, Real(0));
        height = climb = 0;
        land(impulse);
      } else if (n0 < 0 || (std::abs(n0) < 1e-15L * g && n1 < 0)) {
        if (on_.flight) {
          in_flight = true, height = climb = 0;
          clock = from + done;
          tell(Kind::liftoff);
        } else {
          part(s, duration, done, zero, from, false);
          done = zero;
        }
      } else {
        const Real until = n1 < 0 ? (std::abs(n0) < 1e-15L * g ? done : zero) : duration;
        part(s, duration, done, until, from, true);
        done = until;
      }
    }
    clock = from + duration;
  }

 private:
  template <std::size_t n>
  using Vector = std::array<Real, n>;

  Level level_;
  Mounting on_;
  // The load of the part that is integrated, from its beginning on.
  Real px_ = 0, py_ = 0, dpx_ = 0, dpy_ = 0, w_ = 0, dw_ = 0, span_ = 0, from_ = 0;
  std::size_t piece_ = 0;

  void tell(Kind kind) { events.push_back({kind, clock}); }
  Real k(Real t) const {
    const Real stiffness = on_.natural_frequency * on_.natural_frequency;
    return on_.pendulum ? stiffness * weight(t) : stiffness;
  }
  Real weight(Real t) const { return std::max(w_ + dw_ * t, Real(0)); }
  std::array<Real, 2> net(Real t, Real at_x, Real at_y) const {
    return {px_ + dpx_ * t - k(t) * at_x, py_ + dpy_ * t - k(t) * at_y};
  }
  void find_piece() {
    piece_ = 0;
    while (piece_ < level_.knots.size() && path >= level_.knots[piece_]) ++piece_;
  }
  Real knot() const { return piece_ < level_.knots.size() ? level_.knots[piece_] : never; }
  void count() {
    if (++steps > max_steps) throw TooLong();
  }

  // One step of the midpoint rule, extrapolated. @return the error in units of `scale`
  template <std::size_t n, class F>
  static Real extrapolate(const F& f, const Vector<n>& from, Real h, const Vector<n>& scale, Vector<n>& to) {
    constexpr int rows = 9;
    std::array<Vector<n>, rows> table;
    Real error = 0;
    const Vector<n> slope = f(from);
    for (int j = 0; j < rows; ++j) {
      const int parts = 2 * (j + 1);
      const Real step = h / parts;
      Vector<n> before = from, now;
      for (std::size_t i = 0; i < n; ++i) now[i] = from[i] + step * slope[i];
      for (int m = 1; m < parts; ++m) {
        const Vector<n> d = f(now);
        for (std::size_t i = 0; i < n; ++i) before[i] = std::exchange(now[i], before[i] + 2 * step * d[i]);
      }
      const Vector<n> d = f(now);
      Vector<n> row;
      for (std::size_t i = 0; i < n; ++i) row[i] = (now[i] + before[i] + step * d[i]) / 2;
      for (int c = 1; c <= j; ++c) {
        const Real ratio = Real(j + 1) / Real(j + 1 - c), by = 1 / (ratio * ratio - 1);
        Vector<n> better;
        for (std::size_t i = 0; i < n; ++i) better[i] = row[i] + (row[i] - table[c - 1][i]) * by;
        table[c - 1] = std::exchange(row, better);
      }
      if (j == rows - 1) {
        error = 0;
        for (std::size_t i = 0; i < n; ++i) error = std::max(error, std::abs(row[i] - table[j - 1][i]) / scale[i]);
        if (!(error < never)) error = 1e9L;
        to = row;
      }
      table[j] = row;
    }
    return error;
  }

  // Where a function of the state at the end of a step changes its sign, from below to above.
  template <std::size_t n, class F, class G>
  static Real locate(const F& f, const Vector<n>& from, Real low, Real high, const Vector<n>& scale, const G& value) {
    Vector<n> at;
    const auto of = [&](Real h) {
      extrapolate(f, from, h, scale, at);
      return value(at);
    };
    Real below = low > 0 ? of(low) : value(from), above = of(high);
    if (below >= 0) return low;
    int side = 0;
    for (int i = 0; i < 90 && high - low > 0x1p-62L * high; ++i) {
      Real h = i % 4 == 3 ? (low + high) / 2 : (low * above - high * below) / (above - below);
      if (!(h > low && h < high)) h = (low + high) / 2;
      const Real v = of(h);
      if (v == 0) return h;
      if (v < 0) {
        low = h, below = v;
        if (std::exchange(side, -1) == -1) above /= 2;
      } else {
        high = h, above = v;
        if (std::exchange(side, 1) == 1) below /= 2;
      }
    }
    return high;
  }

  void part(const Segment& s, Real duration, Real begin, Real end, Real from, bool touching) {
    if (!(end > begin)) return;
    const auto line = [&](Real a, Real b, Real t) { return a + (b - a) * (t / duration); };
    px_ = line(s.start[0], s.end[0], begin), dpx_ = (s.end[0] - s.start[0]) / duration;
    py_ = line(s.start[1], s.end[1], begin), dpy_ = (s.end[1] - s.start[1]) / duration;
    w_ = touching ? std::max(line(s.normal_start, s.normal_end, begin) / g, Real(0)) : 0;
    dw_ = touching ? (s.normal_end - s.normal_start) / duration / g : 0;
    span_ = end - begin, from_ = from + begin;
    Real t = 0;
    bool stopped = false;
    std::array<Real, 2> came{};
    while (t < span_) {
      count();
      find_piece();
      clock = from_ + t;
      if (mode == Mode::stuck) {
        const auto [delay, pressed] = departure(t);
        const bool leaves = delay < span_ - t || (delay == 0 && t < span_);
        if (stopped && !(leaves && delay == 0)) tell(Kind::arrest);
        if (!leaves) return;
        t += delay;
        clock = from_ + t;
        const auto q = net(t, x, y);
        if (!stopped || delay > 0)
          tell(Kind::breakaway);
        else if (q[0] * came[0] + q[1] * came[1] <= 0)
          tell(Kind::reversal);
        stopped = false;
        if (pressed)
          mode = Mode::along;
        else
          t = start(t);
        continue;
      }
      if (mode == Mode::along) {
        t = along(t, came);
      } else if (!touching) {
        t = fly(t);
      } else {
        t = slide(t, came);
      }
      if (mode == Mode::stuck) stopped = true;
    }
    clock = from_ + span_;
    if (stopped) tell(Kind::arrest);
  }

  bool at_wall() const { return std::hypot(x, y) >= on_.gap * (1 - 1e-16L); }

  // First time from t on at which |q|^2 exceeds the square of the level; both change linearly.
  static Real exceeds(Real qx, Real qy, Real rx, Real ry, Real l, Real dl, Real span) {
    const auto over = [&](Real t) { return std::hypot(qx + rx * t, qy + ry * t) - (l + dl * t); };
    const Real tiny = 1e-17L * (std::hypot(qx, qy) + std::abs(l) + std::hypot(rx, ry) * span);
    if (over(0) > tiny) return 0;
    const Real a = rx * rx + ry * ry - dl * dl, b = qx * rx + qy * ry - l * dl, c = qx * qx + qy * qy - l * l;
    if (std::abs(over(0)) <= tiny) {
      if (b > 0 || (b == 0 && a > 0)) return 0;
      const Real t = a > 0 ? -2 * b / a : never;
      return t < span ? t : never;
    }
    const Real d = b * b - a * c;
    if (d <= 0) return never;
    const Real root = std::sqrt(d);
    const Real t = b + root > 0 ? -c / (b + root) : never;
    const Real other = a != 0 ? (-b + root) / a : never;
    Real first = never;
    for (const Real candidate : {t, other})
      if (candidate >= 0 && candidate < span && over(candidate + span * 1e-9L) > over(candidate - span * 1e-9L))
        first = std::min(first, candidate);
    return first;
  }

  std::pair<Real, bool> departure(Real t) const {
    const Real holds = level_.hold(path), l = holds * (w_ + dw_ * t), dl = holds * dw_, left = span_ - t;
    const auto q = net(t, x, y), last = net(span_, x, y);
    const Real rx = (last[0] - q[0]) / left, ry = (last[1] - q[1]) / left;
    if (!at_wall()) return {exceeds(q[0], q[1], rx, ry, l, dl, left), false};
    const Real r = std::hypot(x, y), nx = x / r, ny = y / r;
    const Real push = q[0] * nx + q[1] * ny, pushes = last[0] * nx + last[1] * ny;
    const Real turn = push * pushes < 0 ? left * (push / (push - pushes)) : left;
    for (int half = 0; half < 2; ++half) {
      const Real from = half ? turn : 0, until = half ? left : turn;
      if (!(until > from)) continue;
      const Real middle = push + (pushes - push) * ((from + until) / 2 / left);
      const bool pressed = middle > 0;
      Real sx = rx, sy = ry, ax = q[0] + rx * from, ay = q[1] + ry * from;
      if (pressed) {
        const Real across = -ax * ny + ay * nx, change = -sx * ny + sy * nx;
        ax = across, ay = 0, sx = change, sy = 0;
      }
      const Real when = exceeds(ax, ay, sx, sy, l + dl * from, dl, until - from);
      if (when < never) return {from + when, pressed};
    }
    return {never, false};
  }

  // From rest at t; returns the time at which it moves.
  Real start(Real t) {
    mode = Mode::sliding;
    const Real left = span_ - t;
    const auto q = net(t, x, y), last = net(span_, x, y);
    const Real load = std::hypot(q[0], q[1]), l = weight(t) * level_.resist(piece_, path, 0);
    const Real rx = (last[0] - q[0]) / left, ry = (last[1] - q[1]) / left, rate = std::hypot(rx, ry);
    const Real unit = load + l + (rate + std::abs(dw_) * level_.hold(path)) * left;
    if (load <= 1e-16L * unit && l <= 1e-16L * unit) {  // without load: along its rate
      const Real h = 1e-6L * left, grows = rate - dw_ * level_.resist(piece_, path, 0);
      move_to(h, rx / rate, ry / rate, grows * h * h / 2, grows * h * h * h / 6);
      return t + h;
    }
    const Real ex = q[0] / load, ey = q[1] / load;
    if (load - l > 0.02L * load) {
      Real h = 1e-10L * left;
      if (on_.natural_frequency > 0) h = std::min(h, 1e-10L / on_.natural_frequency);
      if (rate > 0) h = std::min(h, 1e-9L * load / rate);
      move_to(h, ex, ey, (load - l) * h, (load - l) * h * h / 2);
      return t + h;
    }
    return collocate(t, load, l, rate);
  }
  void move_to(Real, Real ex, Real ey, Real speed, Real way) {
    vx = speed * ex, vy = speed * ey, x += way * ex, y += way * ey, path += way;
  }

  // A slip that begins smoothly: e = (q - v')/|q - v'| on Chebyshev nodes, repeated until it no longer changes.
  Real collocate(Real t, Real load, Real l, Real rate) {
    constexpr int n = 13;
    const Real left = span_ - t;
    const Real steep = rate + std::abs(dw_) * level_.hold(path) + on_.damping * load;
    Real h = left;
    if (steep > 0) h = std::min(h, 2e-3L * l / steep);
    if (on_.natural_frequency > 0) h = std::min(h, 2e-3L / on_.natural_frequency);
    for (int attempt = 0; attempt < 40; ++attempt, h /= 4) {
      std::array<Real, n> at, weight_of;
      for (int i = 0; i < n; ++i) {
        at[i] = (1 - std::cos(std::acos(-1.0L) * i / (n - 1))) / 2;
        weight_of[i] = (i % 2 ? -1 : 1) * (i == 0 || i == n - 1 ? 0.5L : 1);
      }
      std::array<std::array<Real, n>, n> d{}, integral{};
      for (int i = 0; i < n; ++i) {
        Real sum = 0;
        for (int j = 0; j < n; ++j)
          if (i != j) d[i][j] = weight_of[j] / weight_of[i] / (at[i] - at[j]), sum += d[i][j];
        d[i][i] = -sum;
      }
      for (int j = 0; j < n; ++j) {  // integrals of the Lagrange polynomials, by Gauss-Legendre with 8 points
        static constexpr std::array<Real, 4> point{0.1834346424956498049394761L, 0.5255324099163289858177390L,
                                                   0.7966664774136267395915539L, 0.9602898564975362316835609L};
        static constexpr std::array<Real, 4> mass{0.3626837833783619829651504L, 0.3137066458778872873379622L,
                                                  0.2223810344533744705443560L, 0.1012285362903762591525314L};
        for (int i = 1; i < n; ++i) {
          Real sum = 0;
          for (int p = 0; p < 8; ++p) {
            const Real z = at[i] / 2 * (1 + (p < 4 ? point[p] : -point[p - 4]));
            Real value = 1;
            for (int m = 0; m < n; ++m)
              if (m != j) value *= (z - at[m]) / (at[j] - at[m]);
            sum += mass[p % 4] * value;
          }
          integral[i][j] = sum * at[i] / 2;
        }
      }
      std::array<Real, n> ex, ey, u{}, s{}, rx{}, ry{}, next, friction{}, viscous{};
      const auto q0 = net(t, x, y);
      for (int i = 0; i < n; ++i) ex[i] = q0[0] / load, ey[i] = q0[1] / load;
      const auto integrate = [&](const std::array<Real, n>& f, int i) {
        Real sum = 0;
        for (int j = 0; j < n; ++j) sum += integral[i][j] * f[j];
        return h * sum;
      };
      Real change = 1, previous = 1;
      for (int turn = 0; turn < 60 && change > 1e-18L; ++turn) {
        std::array<Real, n> ax, ay, a, f, along_x, along_y;
        for (int i = 0; i < n; ++i) {
          const auto q = net(t + h * at[i], x + rx[i], y + ry[i]);
          a[i] = weight(t + h * at[i]) * level_.resist(piece_, path + s[i], u[i]);
          ax[i] = q[0] - on_.damping * u[i] * ex[i], ay[i] = q[1] - on_.damping * u[i] * ey[i];
          f[i] = ax[i] * ex[i] + ay[i] * ey[i] - a[i];
        }
        previous = std::exchange(change, 0);
        Real most = 0;
        for (int i = 0; i < n; ++i) next[i] = integrate(f, i), most = std::max(most, std::abs(next[i]));
        for (int i = 0; i < n; ++i) change = std::max(change, std::abs(next[i] - u[i]) / (most > 0 ? most : 1));
        u = next;
        for (int i = 0; i < n; ++i) along_x[i] = u[i] * ex[i], along_y[i] = u[i] * ey[i];
        for (int i = 0; i < n; ++i) friction[i] = a[i] * u[i], viscous[i] = on_.damping * u[i] * u[i];
        for (int i = 0; i < n; ++i)
          s[i] = integrate(u, i), rx[i] = integrate(along_x, i), ry[i] = integrate(along_y, i);
        for (int i = 0; i < n; ++i) {
          Real dx = 0, dy = 0;
          for (int j = 0; j < n; ++j) dx += d[i][j] * along_x[j], dy += d[i][j] * along_y[j];
          const Real bx = ax[i] - dx / h, by = ay[i] - dy / h, b = std::hypot(bx, by);
          change = std::max({change, std::abs(bx / b - ex[i]), std::abs(by / b - ey[i])});
          ex[i] = bx / b, ey[i] = by / b;
        }
      }
      if (change > 1e-16L && !(change < 1e-13L && previous < 1e-12L)) continue;
      if (!(u[n - 1] > 0)) continue;
      vx = u[n - 1] * ex[n - 1], vy = u[n - 1] * ey[n - 1];
      dissipated += integrate(friction, n - 1), damped += integrate(viscous, n - 1);
      x += rx[n - 1], y += ry[n - 1], path += s[n - 1];
      return t + h;
    }
    throw TooLong();
  }

  // The first of several events in a step from `from` to `to`; shortens the step. @return which
  struct Watch {
    std::function<Real(const Real*)> value;  // rises through zero
    bool turning = false;                    // only watched
  };

  Real slide(Real t, std::array<Real, 2>& came) {
    using V = Vector<8>;  // t, x, y, ln u, phi, path, dissipated, damped
    const auto f = [&](const V& z) -> V {
      const Real u = std::exp(z[3]), ex = std::cos(z[4]), ey = std::sin(z[4]);
      const auto q = net(z[0], z[1], z[2]);
      const Real a = (w_ + dw_ * z[0]) * level_.resist(piece_, z[5], u);
      return {u,
              u * u * ex,
              u * u * ey,
              q[0] * ex + q[1] * ey - a - on_.damping * u,
              -q[0] * ey + q[1] * ex,
              u * u,
              a * u * u,
              on_.damping * u * u * u};
    };
    const Real speed = std::hypot(vx, vy);
    V z{t, x, y, std::log(speed), std::atan2(vy, vx), path, 0, 0};
    const auto q0 = net(t, x, y);
    const Real level = weight(t) * level_.hold(path);
    const Real fast = std::max(speed, (std::hypot(q0[0], q0[1]) + level +
                                       (std::hypot(dpx_, dpy_) + std::abs(dw_) * level_.hold(path)) * span_) *
                                          span_);
    const Real wide = std::max(fast * span_, std::hypot(x, y));
    const V scale{span_, wide, wide, 1, 1, wide, fast * fast, fast * fast};
    const bool from_wall = at_wall();
    bool left_wall = !from_wall;
    Real h = 0.5L /
             (std::hypot(q0[0], q0[1]) + level + (on_.damping + on_.natural_frequency) * speed + 1e-3L * fast / span_);
    const auto inside = [&](const V& s) { return std::hypot(s[1], s[2]) - on_.gap; };
    const auto radial = [&](const V& s) { return s[1] * std::cos(s[4]) + s[2] * std::sin(s[4]); };
    const auto save = [&](const V& s) {
      x = s[1], y = s[2], path = s[5];
      const Real u = std::exp(s[3]);
      vx = u * std::cos(s[4]), vy = u * std::sin(s[4]);
      dissipated += s[6], damped += s[7];
      peak = std::max(peak, std::hypot(x, y));
      min_speed = std::min(min_speed, u);
    };
    for (;;) {
      count();
      V to;
      const Real error = extrapolate(f, z, h, scale, to);
      if (error > tolerance * 10) {
        h *= std::max(0.1L, 0.8L * std::pow(tolerance / error, 1 / 17.0L));
        continue;
      }
      if (!left_wall && inside(to) >= 0) {
        h /= 2;
        if (h < 1e-30L) throw TooLong();
        continue;
      }
      const Real grows = std::min(Real(2), 0.9L * std::pow(tolerance / (error + 1e-25L), 1 / 17.0L));
      Real first = never;
      int which = 0;
      const auto consider = [&](Real at, int kind) {
        if (at < first) first = at, which = kind;
      };
      if (to[0] >= span_) consider(locate(f, z, 0, h, scale, [&](const V& s) { return s[0] - span_; }), 1);
      if (to[5] >= knot()) consider(locate(f, z, 0, h, scale, [&](const V& s) { return s[5] - knot(); }), 2);
      Real farthest = h;
      if (radial(z) > 0 && radial(to) < 0) {
        farthest = locate(f, z, 0, h, scale, [&](const V& s) { return -radial(s); });
        V turn;
        extrapolate(f, z, farthest, scale, turn);
        if (turn[0] <= span_) peak = std::max(peak, std::min(std::hypot(turn[1], turn[2]), on_.gap));
        if (left_wall && inside(turn) > 0) consider(locate(f, z, 0, farthest, scale, inside), 3);
      }
      if (left_wall && inside(to) >= 0) consider(locate(f, z, 0, farthest, scale, inside), 3);
      if (which) {
        extrapolate(f, z, first, scale, to);
        save(to);
        if (which == 1) return span_;
        if (which == 2) {
          path = knot();
          return to[0];
        }
        clock = from_ + to[0];
        strike(to[0]);
        return to[0];
      }
      left_wall = true;
      z = to;
      h *= grows;
      min_speed = std::min(min_speed, std::exp(z[3]));
      if (std::exp(z[3]) < 1e-18L * fast) {
        save(z);
        came = {vx, vy};
        vx = vy = 0, mode = Mode::stuck;
        return z[0];
      }
    }
  }

  // Without friction.
  Real fly(Real t) {
    using V = Vector<7>;  // t, x, y, vx, vy, path, damped
    const auto f = [&](const V& z) -> V {
      const auto q = net(z[0], z[1], z[2]);
      const Real u = std::hypot(z[3], z[4]);
      return {1, z[3], z[4], q[0] - on_.damping * z[3], q[1] - on_.damping * z[4], u, on_.damping * u * u};
    };
    V z{t, x, y, vx, vy, path, 0};
    const Real fast = std::hypot(vx, vy) + (std::hypot(px_, py_) + std::hypot(dpx_, dpy_) * span_) * span_ + 1e-300L;
    const Real wide = std::max(fast * span_, std::hypot(x, y));
    const V scale{span_, wide, wide, fast, fast, wide, fast * fast};
    bool left_wall = !at_wall();
    Real h = (span_ - t) / 10;
    const auto inside = [&](const V& s) { return std::hypot(s[1], s[2]) - on_.gap; };
    const auto radial = [&](const V& s) { return s[1] * s[3] + s[2] * s[4]; };
    const auto save = [&](const V& s) {
      x = s[1], y = s[2], vx = s[3], vy = s[4], path = s[5], damped += s[6];
      peak = std::max(peak, std::hypot(x, y));
    };
    for (;;) {
      count();
      if (span_ - z[0] <= h) h = span_ - z[0];
      V to;
      const Real error = extrapolate(f, z, h, scale, to);
      if (error > tolerance * 10 && h > 1e-9L * span_) {
        h *= std::max(0.1L, 0.8L * std::pow(tolerance / error, 1 / 17.0L));
        continue;
      }
      if (!left_wall && inside(to) >= 0) {
        h /= 2;
        if (h < 1e-30L) throw TooLong();
        continue;
      }
      const Real grows = std::min(Real(1.5), 0.9L * std::pow(tolerance / (error + 1e-25L), 1 / 17.0L));
      Real farthest = h;
      bool hits = left_wall && inside(to) >= 0;
      if (radial(z) > 0 && radial(to) < 0) {
        farthest = locate(f, z, 0, h, scale, [&](const V& s) { return -radial(s); });
        V turn;
        extrapolate(f, z, farthest, scale, turn);
        peak = std::max(peak, std::min(std::hypot(turn[1], turn[2]), on_.gap));
        hits = hits || (left_wall && inside(turn) > 0);
      }
      if (hits) {
        extrapolate(f, z, locate(f, z, 0, farthest, scale, inside), scale, to);
        save(to);
        clock = from_ + to[0];
        strike(to[0]);
        return to[0];
      }
      left_wall = true;
      z = to;
      if (!(z[0] < span_ * (1 - 1e-18L))) {
        save(z);
        return span_;
      }
      h *= grows;
    }
  }

  void strike(Real t) {
    const Real r = std::hypot(x, y), nx = x / r, ny = y / r;
    x = on_.gap * nx, y = on_.gap * ny;
    peak = std::max(peak, on_.gap);
    const Real out = std::max(vx * nx + vy * ny, Real(0)), aside = -vx * ny + vy * nx;
    if (out > 1e-12L * std::abs(aside)) tell(Kind::impact);
    Real back = on_.restitution * out;
    const auto q = net(t, x, y);
    const Real speed = std::hypot(back, aside);
    const Real friction = speed > 0 ? weight(t) * level_.resist(piece_, path, speed) * back / speed : 0;
    const Real push = q[0] * nx + q[1] * ny + aside * aside / on_.gap - friction;
    const bool pressed = push > 0 && back * back <= 1e-19L * on_.gap * push;
    if (pressed) back = 0;
    lost += (out * out - back * back) / 2;
    vx = -aside * ny - back * nx, vy = aside * nx - back * ny;
    mode = vx == 0 && vy == 0 ? Mode::stuck : pressed ? Mode::along : Mode::sliding;
  }

  // Along the stop.
  Real along(Real t, std::array<Real, 2>& came) {
    using V = Vector<6>;  // t, angle, speed, path, dissipated, damped
    const Real angle = std::atan2(y, x);
    Real across = -vx * std::sin(angle) + vy * std::cos(angle);
    if (across == 0) {
      const auto q = net(t, x, y);
      across = -q[0] * std::sin(angle) + q[1] * std::cos(angle);
    }
    const Real turn = across < 0 ? -1 : 1;
    const auto normal = [&](const V& z) {
      const Real c = std::cos(z[1]), s = std::sin(z[1]);
      const auto q = net(z[0], on_.gap * c, on_.gap * s);
      return q[0] * c + q[1] * s + z[2] * z[2] / on_.gap;
    };
    const auto f = [&](const V& z) -> V {
      const Real c = std::cos(z[1]), s = std::sin(z[1]), u = z[2];
      const auto q = net(z[0], on_.gap * c, on_.gap * s);
      const Real a = (w_ + dw_ * z[0]) * level_.resist(piece_, z[3], u);
      return {1,     turn * u / on_.gap, turn * (-q[0] * s + q[1] * c) - a - on_.damping * u, u,
              a * u, on_.damping * u * u};
    };
    V z{t, angle, std::hypot(vx, vy), path, 0, 0};
    const Real fast = z[2] + (std::hypot(px_, py_) + std::hypot(dpx_, dpy_) * span_) * span_;
    const V scale{span_, 1, fast, fast * span_, fast * fast, fast * fast};
    Real h = (span_ - t) / 40;
    const auto save = [&](const V& s) {
      x = on_.gap * std::cos(s[1]), y = on_.gap * std::sin(s[1]);
      vx = -turn * s[2] * std::sin(s[1]), vy = turn * s[2] * std::cos(s[1]);
      path = s[3], dissipated += s[4], damped += s[5];
    };
    if (normal(z) < -1e-15L * (std::hypot(px_, py_) + z[2] * z[2] / on_.gap)) {
      mode = Mode::sliding;
      return t;
    }
    for (;;) {
      count();
      if (span_ - z[0] <= h) h = span_ - z[0];
      V to;
      const Real error = extrapolate(f, z, h, scale, to);
      if (error > tolerance * 10 && h > 1e-9L * span_) {
        h *= std::max(0.1L, 0.8L * std::pow(tolerance / error, 1 / 17.0L));
        continue;
      }
      Real first = never;
      int which = 0;
      const auto consider = [&](Real at, int kind) {
        if (at < first) first = at, which = kind;
      };
      if (to[2] <= 0 && z[2] > 0) consider(locate(f, z, 0, h, scale, [](const V& s) { return -s[2]; }), 1);
      if (to[2] <= 0 && z[2] <= 0) consider(0, 1);
      if (to[3] >= knot()) consider(locate(f, z, 0, h, scale, [&](const V& s) { return s[3] - knot(); }), 2);
      if (normal(to) < 0) consider(locate(f, z, 0, h, scale, [&](const V& s) { return -normal(s); }), 3);
      if (which) {
        extrapolate(f, z, first, scale, to);
        save(to);
        if (which == 1) {
          came = {-turn * std::sin(to[1]), turn * std::cos(to[1])};
          vx = vy = 0, mode = Mode::stuck;
        }
        if (which == 2) path = knot();
        if (which == 3) mode = Mode::sliding;
        return to[0];
      }
      z = to;
      if (!(z[0] < span_ * (1 - 1e-18L))) {
        save(z);
        return span_;
      }
      h = std::min(2 * h, span_ / 40);
    }
  }

  void land(Real impulse) {
    if (mode == Mode::stuck) return;
    const Real speed = std::hypot(vx, vy);
    find_piece();
    Real after = speed;
    const int n = 2000;  // d|v|/dJ = -mu(|v|), by the classical rule of order 4
    const Real h = impulse / n;
    for (int i = 0; i < n && after > 0; ++i) {
      const auto mu = [&](Real u) { return level_.resist(piece_, path, std::max(u, Real(0))) / g; };
      const Real a = mu(after), b = mu(after - h / 2 * a), c = mu(after - h / 2 * b), d = mu(after - h * c);
      after -= h / 6 * (a + 2 * b + 2 * c + d);
    }
    after = std::max(after, Real(0));
    dissipated += (speed * speed - after * after) / 2;
    vx *= after / speed, vy *= after / speed;
    if (after > 0) return;
    mode = Mode::stuck;
    tell(Kind::arrest);
  }
};

}  // namespace test

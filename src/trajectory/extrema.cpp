#include "trajectory/extrema.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <stdexcept>
#include <string>
#include <utility>

#include "trajectory/bernstein.h"

namespace mocha {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTolerance = 1e-9;  // relative, of squares: half of what is promised
constexpr double kRest = 1e-9;       // share of the largest velocity, below which there is none
constexpr double kRounding = 1e-13;  // of control points, as a share of the largest

template <int D, int C>
using Control = Eigen::Matrix<double, D, C>;

/// The squared norm of a polynomial vector over a span of time.
template <int C>
struct SquaredNorm {
  Control<1, C> square;

  double start() const { return square[0]; }
  double end() const { return square[C - 1]; }
  double bound() const { return square.maxCoeff() + kRounding * square.cwiseAbs().maxCoeff(); }
  std::pair<SquaredNorm, SquaredNorm> halves() const {
    const auto [before, after] = split(square);
    return {{before}, {after}};
  }
};

/// The squared curvature over a span of time: |turning|^2 / |course|^6. The course's largest
/// control point has the norm 1.
template <int T, int D, int N>
struct SquaredCurvature {
  Control<D, N> course;
  Control<T, 2 * N - 2> turning;

  double start() const { return ratio(turning.col(0), course.col(0)); }
  double end() const { return ratio(turning.col(2 * N - 3), course.col(N - 1)); }

  /// The largest ratio of control points of equal degree bounds the ratio of two polynomials: it is
  /// their mean with weights that are positive if the denominator's control points are.
  double bound() const {
    const Control<1, 2 * N - 1> square = squared_norm(course);
    if (!(square.minCoeff() > kRest * kRest)) return kInfinity;
    const auto times = [](const auto& x, const auto& y) { return x[0] * y[0]; };
    Control<1, 6 * N - 5> below = multiply(multiply(square, square, times), square, times);
    Control<1, 6 * N - 5> above = elevate<2 * N>(squared_norm(turning));
    below.array() -= kRounding * below.cwiseAbs().maxCoeff();
    above.array() += kRounding * above.cwiseAbs().maxCoeff();
    if (!(below.minCoeff() > 0.0)) return kInfinity;
    return above.cwiseQuotient(below).maxCoeff();
  }

  std::pair<SquaredCurvature, SquaredCurvature> halves() const {
    const auto [course_before, course_after] = split(course);
    const auto [turning_before, turning_after] = split(turning);
    return {{course_before, turning_before}, {course_after, turning_after}};
  }

 private:
  static double ratio(const Control<T, 1>& turn, const Control<D, 1>& along) {
    const double square = along.squaredNorm();
    if (square <= kRest * kRest) return kInfinity;
    return turn.squaredNorm() / (square * square * square);
  }
};

/// The largest value of any function that is known at the ends of a span, bounded over it, and can
/// be halved.
template <typename Function>
class Maximum {
 public:
  void add(const Function& function, double start_s, double duration_s) {
    add({function, function.bound(), start_s, duration_s});
  }

  /// The root of the largest square.
  Extremum root() {
    while (spans_.top().bound > best_ * (1.0 + kTolerance)) {
      const Span span = spans_.top();
      spans_.pop();
      const auto [before, after] = span.function.halves();
      const double half_s = 0.5 * span.duration_s;
      add({before, before.bound(), span.start_s, half_s});
      add({after, after.bound(), span.start_s + half_s, half_s});
    }
    return {std::sqrt(std::max(best_, spans_.top().bound)), best_time_s_};
  }

 private:
  struct Span {
    Function function;
    double bound;
    double start_s;
    double duration_s;
    bool operator<(const Span& other) const { return bound < other.bound; }
  };

  void add(const Span& span) {
    consider(span.function.start(), span.start_s);
    consider(span.function.end(), span.start_s + span.duration_s);
    spans_.push(span);
  }

  void consider(double value, double time_s) {
    if (value <= best_) return;
    best_ = value;
    best_time_s_ = time_s;
  }

  std::priority_queue<Span> spans_;
  double best_ = -1.0;
  double best_time_s_ = 0.0;
};

template <int D, int S>
void require_curve(const PiecewisePolynomial<D, S>& curve, const char* caller) {
  const auto require = [caller](bool condition, const char* what) {
    if (!condition) throw std::invalid_argument(std::string(caller) + ": the curve " + what);
  };
  require(curve.pieces() > 0, "has no pieces");
  for (int i = 0; i < curve.pieces(); ++i) {
    require(curve.piece(i).allFinite(), "has a coefficient that is not finite");
  }
}

/// Control points of the derivative by normalised time. They do not depend on the position, which
/// would cost digits far from the origin.
template <int Order, int D, int S>
Control<D, 2 * S - Order> derivative_of(const PiecewisePolynomial<D, S>& curve, int piece) {
  Control<D, 2 * S - Order> monomial = curve.piece(piece).template rightCols<2 * S - Order>();
  for (int k = Order; k < 2 * S; ++k) {
    for (int j = 0; j < Order; ++j) monomial.col(k - Order) *= k - j;
  }
  return to_bernstein(monomial);
}

template <int Order, int D, int S>
Extremum max_norm(const PiecewisePolynomial<D, S>& curve) {
  Maximum<SquaredNorm<2 * (2 * S - Order) - 1>> maximum;
  for (int i = 0; i < curve.pieces(); ++i) {
    const double tau = curve.piece_duration(i);
    Control<D, 2 * S - Order> control = derivative_of<Order>(curve, i);
    for (int j = 0; j < Order; ++j) control /= tau;
    maximum.add({squared_norm(control)}, curve.piece_start(i), tau);
  }
  return maximum.root();
}

template <int D, int C>
double largest(const Control<D, C>& control) {
  return control.colwise().norm().maxCoeff();
}

template <int D, int C>
void mirror(Control<D, C>& control) {
  control = control.rowwise().reverse().eval();
}

/// Divides a velocity by u^k, where k is the order of its zero at u = 0. Returns k.
template <int D, int C>
int divide_rest_out(Control<D, C>& velocity) {
  int zeros = 0;
  while (zeros + 1 < C && velocity.col(0).norm() < kRest * largest(velocity)) {
    velocity = divided_at_start(velocity);
    ++zeros;
  }
  return zeros;
}

/// Divides the turning of a course of size 1 by u^zeros, if that goes.
template <int D, int C>
bool divide(Control<D, C>& turning, int zeros) {
  for (; zeros > 0; --zeros) {
    if (turning.col(0).norm() > kRest) return false;
    turning = divided_at_start(turning);
  }
  return true;
}

}  // namespace

template <int D, int S>
Extremum max_speed(const PiecewisePolynomial<D, S>& curve) {
  require_curve(curve, "max_speed");
  return max_norm<1>(curve);
}

template <int D, int S>
Extremum max_acceleration(const PiecewisePolynomial<D, S>& curve) {
  require_curve(curve, "max_acceleration");
  return max_norm<2>(curve);
}

/// With v = u^k (1 - u)^l c at rests, the curvature is |c x c'| / (|c|^3 u^k (1 - u)^l), whatever
/// the scale of u.
template <int D, int S>
Extremum max_curvature(const PiecewisePolynomial<D, S>& curve) {
  require_curve(curve, "max_curvature");
  Maximum<SquaredCurvature<D == 2 ? 1 : 3, D, 2 * S - 1>> maximum;
  const int last = curve.pieces() - 1;
  for (int i = 0; i <= last; ++i) {
    Control<D, 2 * S - 1> course = derivative_of<1>(curve, i);
    const int zeros_at_start = i == 0 ? divide_rest_out(course) : 0;
    mirror(course);
    const int zeros_at_end = i == last ? divide_rest_out(course) : 0;
    mirror(course);
    const double scale = largest(course);
    if (scale == 0.0) return {kInfinity, curve.piece_start(i)};
    course /= scale;
    auto turning = cross(course, derivative(course));
    if (!divide(turning, zeros_at_start)) return {kInfinity, 0.0};
    mirror(turning);
    if (!divide(turning, zeros_at_end)) return {kInfinity, curve.duration()};
    mirror(turning);
    maximum.add({course, turning / scale}, curve.piece_start(i), curve.piece_duration(i));
  }
  return maximum.root();
}

template Extremum max_speed(const PiecewisePolynomial<2, 2>&);
template Extremum max_speed(const PiecewisePolynomial<2, 3>&);
template Extremum max_speed(const PiecewisePolynomial<2, 4>&);
template Extremum max_speed(const PiecewisePolynomial<3, 2>&);
template Extremum max_speed(const PiecewisePolynomial<3, 3>&);
template Extremum max_speed(const PiecewisePolynomial<3, 4>&);
template Extremum max_acceleration(const PiecewisePolynomial<2, 2>&);
template Extremum max_acceleration(const PiecewisePolynomial<2, 3>&);
template Extremum max_acceleration(const PiecewisePolynomial<2, 4>&);
template Extremum max_acceleration(const PiecewisePolynomial<3, 2>&);
template Extremum max_acceleration(const PiecewisePolynomial<3, 3>&);
template Extremum max_acceleration(const PiecewisePolynomial<3, 4>&);
template Extremum max_curvature(const PiecewisePolynomial<2, 2>&);
template Extremum max_curvature(const PiecewisePolynomial<2, 3>&);
template Extremum max_curvature(const PiecewisePolynomial<2, 4>&);
template Extremum max_curvature(const PiecewisePolynomial<3, 2>&);
template Extremum max_curvature(const PiecewisePolynomial<3, 3>&);
template Extremum max_curvature(const PiecewisePolynomial<3, 4>&);

}  // namespace mocha

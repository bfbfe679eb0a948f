#include "fit_client/fit/panels/polyline.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/QR>

namespace fitroom::panels {
namespace {

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// Says whether the segments ab and cd have a point in common. Touching counts.
bool SegmentsMeet(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                  const Eigen::Vector2d& d) {
  if (std::max(a.x(), b.x()) < std::min(c.x(), d.x()) || std::max(c.x(), d.x()) < std::min(a.x(), b.x()) ||
      std::max(a.y(), b.y()) < std::min(c.y(), d.y()) || std::max(c.y(), d.y()) < std::min(a.y(), b.y())) {
    return false;
  }
  const double abc = Cross(b - a, c - a), abd = Cross(b - a, d - a);
  const double cda = Cross(d - c, a - c), cdb = Cross(d - c, b - c);
  return !((abc > 0 && abd > 0) || (abc < 0 && abd < 0) || (cda > 0 && cdb > 0) || (cda < 0 && cdb < 0));
}

// The points of a chain, carried on beyond both ends by point reflection there.
Eigen::Vector2d ReflectedAt(const Polyline& chain, int index) {
  const int last = static_cast<int>(chain.size()) - 1;
  if (index < 0) return 2.0 * chain.front() - chain[static_cast<size_t>(std::min(-index, last))];
  if (index > last) return 2.0 * chain.back() - chain[static_cast<size_t>(std::max(2 * last - index, 0))];
  return chain[static_cast<size_t>(index)];
}

// Bernstein polynomials of the degree at t, by de Casteljau's recurrence.
Eigen::VectorXd Bernstein(int degree, double t) {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(degree + 1);
  values[0] = 1.0;
  for (int n = 1; n <= degree; ++n) {
    for (int k = n; k > 0; --k) values[k] = (1.0 - t) * values[k] + t * values[k - 1];
    values[0] *= 1.0 - t;
  }
  return values;
}

}  // namespace

std::vector<double> CumulativeLengths(std::span<const Eigen::Vector2d> chain) {
  std::vector<double> lengths(chain.size(), 0.0);
  for (size_t i = 1; i < chain.size(); ++i) lengths[i] = lengths[i - 1] + (chain[i] - chain[i - 1]).norm();
  return lengths;
}

double ChainLength(std::span<const Eigen::Vector2d> chain) {
  double length = 0.0;
  for (size_t i = 1; i < chain.size(); ++i) length += (chain[i] - chain[i - 1]).norm();
  return length;
}

Eigen::Vector2d InterpolateChain(std::span<const Eigen::Vector2d> chain, std::span<const double> parameters,
                                 double value) {
  if (value <= parameters.front()) return chain.front();
  if (value >= parameters.back()) return chain.back();
  const auto upper = std::upper_bound(parameters.begin(), parameters.end(), value);
  const size_t next = static_cast<size_t>(upper - parameters.begin());
  const double step = parameters[next] - parameters[next - 1];
  const double fraction = step > 0.0 ? (value - parameters[next - 1]) / step : 0.0;
  return (1.0 - fraction) * chain[next - 1] + fraction * chain[next];
}

Polyline ResampleChain(std::span<const Eigen::Vector2d> chain, int count) {
  const std::vector<double> lengths = CumulativeLengths(chain);
  Polyline samples;
  samples.reserve(static_cast<size_t>(count) + 1);
  for (int i = 0; i < count; ++i) samples.push_back(InterpolateChain(chain, lengths, lengths.back() * i / count));
  samples.push_back(chain.back());
  return samples;
}

Polyline SmoothSamples(const Polyline& samples, double sigma_in_steps) {
  const int last = static_cast<int>(samples.size()) - 1;
  if (last < 2 || sigma_in_steps <= 0.0) return samples;
  // A Gaussian wider than a third of the chain would see mostly its own reflections.
  const double sigma = std::min(sigma_in_steps, last / 3.0);
  const int reach = static_cast<int>(std::ceil(3.0 * sigma));
  std::vector<double> kernel(static_cast<size_t>(reach) + 1);
  double total = 0.0;
  for (int k = 0; k <= reach; ++k) {
    kernel[static_cast<size_t>(k)] = std::exp(-0.5 * k * k / (sigma * sigma));
    total += (k == 0 ? 1.0 : 2.0) * kernel[static_cast<size_t>(k)];
  }
  Polyline smooth = samples;
  for (int i = 1; i < last; ++i) {
    Eigen::Vector2d sum = kernel[0] * samples[static_cast<size_t>(i)];
    for (int k = 1; k <= reach; ++k) {
      sum += kernel[static_cast<size_t>(k)] * (ReflectedAt(samples, i - k) + ReflectedAt(samples, i + k));
    }
    smooth[static_cast<size_t>(i)] = sum / total;
  }
  return smooth;
}

Polyline FitBezier(std::span<const Eigen::Vector2d> points, std::span<const double> parameters, int degree, int held) {
  constexpr double kHeldWeight = 30.0;
  const int count = static_cast<int>(points.size());
  const int used_degree = std::max(1, std::min(degree, count - 1));
  const int free_count = used_degree - 1;
  Eigen::MatrixXd basis(count, used_degree + 1);
  for (int i = 0; i < count; ++i) basis.row(i) = Bernstein(used_degree, parameters[static_cast<size_t>(i)]).transpose();
  Eigen::MatrixXd controls(used_degree + 1, 2);
  controls.row(0) = points.front().transpose();
  controls.row(used_degree) = points.back().transpose();
  if (free_count > 0) {
    Eigen::MatrixXd rest(count, 2);
    for (int i = 0; i < count; ++i) {
      rest.row(i) = points[static_cast<size_t>(i)].transpose() - basis(i, 0) * controls.row(0) -
                    basis(i, used_degree) * controls.row(used_degree);
    }
    Eigen::MatrixXd inner = basis.middleCols(1, free_count);
    if (held >= 0) {
      inner.row(held) *= kHeldWeight;
      rest.row(held) *= kHeldWeight;
    }
    controls.middleRows(1, free_count) = inner.colPivHouseholderQr().solve(rest);
  }
  Polyline curve(points.size());
  for (int i = 0; i < count; ++i) curve[static_cast<size_t>(i)] = (basis.row(i) * controls).transpose();
  curve.front() = points.front();
  curve.back() = points.back();
  return curve;
}

double SignedArea(std::span<const Eigen::Vector2d> polygon) {
  double twice = 0.0;
  for (size_t i = 0; i < polygon.size(); ++i) twice += Cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return 0.5 * twice;
}

bool PolygonContains(std::span<const Eigen::Vector2d> polygon, const Eigen::Vector2d& point) {
  bool inside = false;
  for (size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Eigen::Vector2d& a = polygon[i];
    const Eigen::Vector2d& b = polygon[j];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    if (point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

bool IsSimplePolygon(std::span<const Eigen::Vector2d> polygon) {
  const size_t count = polygon.size();
  if (count < 3) return false;
  for (size_t i = 0; i < count; ++i) {
    for (size_t j = i + 2; j < count; ++j) {
      if (i == 0 && j == count - 1) continue;
      if (SegmentsMeet(polygon[i], polygon[i + 1], polygon[j], polygon[(j + 1) % count])) return false;
    }
  }
  return true;
}

double DistanceToSegment(const Eigen::Vector2d& point, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double squared = along.squaredNorm();
  const double t = squared > 0.0 ? std::clamp((point - a).dot(along) / squared, 0.0, 1.0) : 0.0;
  return (point - a - t * along).norm();
}

double DistanceToChain(const Eigen::Vector2d& point, std::span<const Eigen::Vector2d> chain) {
  double distance = std::numeric_limits<double>::infinity();
  for (size_t i = 1; i < chain.size(); ++i) {
    distance = std::min(distance, DistanceToSegment(point, chain[i - 1], chain[i]));
  }
  return distance;
}

}  // namespace fitroom::panels

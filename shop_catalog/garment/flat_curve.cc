#include "shop_catalog/garment/flat_curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/base/check.h"

namespace fitroom::shop_catalog {
namespace {

using Eigen::Vector2d;

constexpr double kLineStep = 0.6;  // Of straight lines (unit: centimetre).

}  // namespace

Vector2d MirrorX(const Vector2d& place) { return {-place.x(), place.y()}; }

FlatCurve Mirror(const FlatCurve& curve) {
  FlatCurve mirrored = curve;
  for (Vector2d& point : mirrored) point.x() = -point.x();
  return mirrored;
}

FlatCurve Reversed(const FlatCurve& curve) { return {curve.rbegin(), curve.rend()}; }

FlatCurve MirrorReversed(const FlatCurve& curve) { return Mirror(Reversed(curve)); }

void Join(FlatCurve& curve, const FlatCurve& next) {
  FR_CHECK(!next.empty());
  curve.insert(curve.end(), next.begin() + 1, next.end());
}

void AppendLine(FlatCurve& curve, const Vector2d& end) {
  const Vector2d start = curve.back();
  const int steps = std::max(1, static_cast<int>(std::ceil((end - start).norm() / kLineStep)));
  for (int i = 1; i <= steps; ++i) curve.push_back(start + static_cast<double>(i) / steps * (end - start));
}

void AppendCurve(FlatCurve& curve, const Vector2d& first_handle, const Vector2d& second_handle, const Vector2d& end) {
  constexpr int kSteps = 32;
  const Vector2d start = curve.back();
  for (int i = 1; i <= kSteps; ++i) {
    const double t = static_cast<double>(i) / kSteps, s = 1.0 - t;
    curve.push_back(s * s * s * start + 3 * s * s * t * first_handle + 3 * s * t * t * second_handle + t * t * t * end);
  }
}

void AppendArc(FlatCurve& curve, const Vector2d& end, double bulge) {
  const Vector2d start = curve.back();
  const Vector2d along = end - start;
  const Vector2d left = Vector2d(along.y(), -along.x()).normalized() * (bulge * 4.0 / 3.0);
  AppendCurve(curve, start + along / 3.0 + left, start + along * (2.0 / 3.0) + left, end);
}

FlatCurve Profile(const std::vector<Vector2d>& places) {
  FR_CHECK(places.size() >= 2);
  const size_t n = places.size();
  std::vector<double> slope(n - 1), tangent(n);
  for (size_t i = 0; i + 1 < n; ++i) {
    FR_CHECK(places[i + 1].y() > places[i].y());
    slope[i] = (places[i + 1].x() - places[i].x()) / (places[i + 1].y() - places[i].y());
  }
  tangent.front() = slope.front();
  tangent.back() = slope.back();
  for (size_t i = 1; i + 1 < n; ++i) {
    const double a = slope[i - 1], b = slope[i];
    tangent[i] = a * b <= 0.0 ? 0.0 : 2.0 * a * b / (a + b);  // Harmonic mean.
  }
  FlatCurve curve = {places.front()};
  for (size_t i = 0; i + 1 < n; ++i) {
    const double height = places[i + 1].y() - places[i].y();
    const int steps = std::max(4, static_cast<int>(std::ceil(height / kLineStep)));
    for (int k = 1; k <= steps; ++k) {
      const double t = static_cast<double>(k) / steps;
      const double h00 = (1 + 2 * t) * (1 - t) * (1 - t), h10 = t * (1 - t) * (1 - t);
      const double h01 = t * t * (3 - 2 * t), h11 = t * t * (t - 1);
      curve.emplace_back(
          h00 * places[i].x() + h10 * height * tangent[i] + h01 * places[i + 1].x() + h11 * height * tangent[i + 1],
          places[i].y() + t * height);
    }
  }
  return curve;
}

FlatCurve Offset(const FlatCurve& curve, double distance) {
  FlatCurve moved;
  for (size_t i = 0; i < curve.size(); ++i) {
    const Vector2d along = (curve[std::min(i + 1, curve.size() - 1)] - curve[i > 0 ? i - 1 : 0]).normalized();
    moved.push_back(curve[i] + distance * Vector2d(-along.y(), along.x()));
  }
  return moved;
}

FlatCurve Between(const FlatCurve& a, const FlatCurve& b) {
  FlatCurve shape = a;
  shape.insert(shape.end(), b.rbegin(), b.rend());
  return shape;
}

FlatCurve Circle(const Vector2d& centre, double radius) {
  FlatCurve circle;
  for (int i = 0; i < 96; ++i) {
    circle.push_back(
        centre + radius * Vector2d(std::cos(i * 2 * std::numbers::pi / 96), std::sin(i * 2 * std::numbers::pi / 96)));
  }
  return circle;
}

FlatCurve Polygonal(const std::vector<Vector2d>& corners) {
  FlatCurve shape;
  for (size_t i = 0; i < corners.size(); ++i) {
    const Vector2d& next = corners[(i + 1) % corners.size()];
    for (int k = 0; k < 12; ++k) shape.push_back(corners[i] + k / 12.0 * (next - corners[i]));
  }
  return shape;
}

FlatCurve Rectangle(double x, double y, double width, double height) {
  return Polygonal({{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}});
}

Vector2d AtHeight(const FlatCurve& curve, double height) {
  FR_CHECK(!curve.empty());
  for (size_t i = 1; i < curve.size(); ++i) {
    const double a = curve[i - 1].y() - height, b = curve[i].y() - height;
    if ((a <= 0) != (b <= 0)) return curve[i - 1] + a / (a - b) * (curve[i] - curve[i - 1]);
  }
  return *std::min_element(curve.begin(), curve.end(), [height](const Vector2d& a, const Vector2d& b) {
    return std::abs(a.y() - height) < std::abs(b.y() - height);
  });
}

double CurveLength(const FlatCurve& curve) {
  double length = 0.0;
  for (size_t i = 1; i < curve.size(); ++i) length += (curve[i] - curve[i - 1]).norm();
  return length;
}

Vector2d AtPart(const FlatCurve& curve, double part) {
  double left = std::clamp(part, 0.0, 1.0) * CurveLength(curve);
  for (size_t i = 1; i < curve.size(); ++i) {
    const double step = (curve[i] - curve[i - 1]).norm();
    if (left <= step && step > 0.0) return curve[i - 1] + left / step * (curve[i] - curve[i - 1]);
    left -= step;
  }
  return curve.back();
}

FlatCurve Section(const FlatCurve& curve, double top, double bottom) {
  FlatCurve section;
  for (const Vector2d& place : curve) {
    if (place.y() >= top && place.y() <= bottom) section.push_back(place);
  }
  return section;
}

}  // namespace fitroom::shop_catalog

#include "fit_client/fit/measure/way_round_body.h"

#include <cmath>

#include "fit_client/fit/measure/taut_length.h"

namespace fitroom {
namespace {

constexpr int kLayerSlabs = 128;
constexpr double kLeastBulge = 0.02;  // From the way between the ends to the half's centre (unit: metre).
constexpr double kSteepest = 0.5;     // Sine of the plane's slope.

}  // namespace

std::optional<SectionPlane> PlaneOf(const LineHalf& half, bool is_front) {
  const Eigen::Vector3d way = half.ends[1] - half.ends[0];
  if (std::hypot(way.x(), way.z()) < 1e-6) return std::nullopt;
  SectionPlane plane;
  plane.origin = half.ends[0];
  plane.u = way.normalized();
  const Eigen::Vector3d away = half.centre - 0.5 * (half.ends[0] + half.ends[1]);
  const Eigen::Vector3d bulge = away - away.dot(plane.u) * plane.u;
  // Level, with y up: outwards is +z in front, where the way runs to +x, and -z behind.
  const Eigen::Vector3d outwards =
      (is_front ? 1.0 : -1.0) * Eigen::Vector3d(-plane.u.z(), 0.0, plane.u.x()).normalized();
  const bool is_level = bulge.dot(outwards) < kLeastBulge || std::abs(bulge.y()) > kSteepest * bulge.norm();
  plane.v = is_level ? outwards : bulge.normalized();
  if (is_level) {
    plane.u = Eigen::Vector3d(plane.u.x(), 0.0, plane.u.z()).normalized();
    plane.origin.y() = half.centre.y();
  }
  return plane;
}

WayRoundBody::WayRoundBody(const Body& body, const std::vector<const TriangleMesh*>& layers) : tape_(body) {
  for (const TriangleMesh* layer : layers) layers_.emplace_back(*layer, kLayerSlabs);
}

std::vector<Eigen::Vector2d> WayRoundBody::OutlineAt(double height) const {
  std::vector<Eigen::Vector2d> points = tape_.TrunkOutlineAt(height);
  for (const HeightIndex& layer : layers_) {
    const std::vector<Eigen::Vector2d> of_layer = tape_.TrunkOutlineAt(height, layer);
    points.insert(points.end(), of_layer.begin(), of_layer.end());
  }
  return points;
}

double WayRoundBody::TautLengthOf(const LineHalf& half, bool is_front, double offset) const {
  const std::optional<SectionPlane> plane = PlaneOf(half, is_front);
  if (!plane) return 0.0;
  std::vector<Eigen::Vector2d> points = tape_.TrunkOutlineIn(*plane);
  for (const HeightIndex& layer : layers_) {
    const std::vector<Eigen::Vector2d> of_layer = tape_.TrunkOutlineIn(*plane, layer);
    points.insert(points.end(), of_layer.begin(), of_layer.end());
  }
  const Eigen::Vector3d way = half.ends[1] - half.ends[0];
  return TautLength(points, {0.0, 0.0}, {way.dot(plane->u), way.dot(plane->v)}, offset);
}

}  // namespace fitroom

#include "fit_client/fit/paper/belt.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "common/body/plane_section.h"
#include "common/body/polygon.h"

namespace fitroom::paper {
namespace {

// Where the ray from the middle towards the front leaves the convex outline, in the plane's (across, front).
//
//        front (v)
//      .---*---.     * centre front
//     /    |    \.
//     \    m    /    u: over the left where the corners run clockwise seen from above
//      '-------'
struct CentreFront {
  size_t edge = 0;  // From corner `edge` to the next one.
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
};

CentreFront FindCentreFront(const std::vector<Eigen::Vector2d>& hull, double middle) {
  CentreFront front;
  double foremost = -std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector2d& p = hull[i];
    const Eigen::Vector2d& q = hull[(i + 1) % hull.size()];
    if (std::min(p.x(), q.x()) > middle || std::max(p.x(), q.x()) < middle || p.x() == q.x()) continue;
    const Eigen::Vector2d place = p + (q - p) * ((middle - p.x()) / (q.x() - p.x()));
    if (place.y() > foremost) {
      foremost = place.y();
      front = {i, place};
    }
  }
  return front;
}

}  // namespace

Eigen::Vector3d Belt::At(double distance) const {
  double left = std::fmod(distance, length);
  if (left < 0.0) left += length;
  for (size_t i = 0; i < tape.size(); ++i) {
    const Eigen::Vector3d way = tape[(i + 1) % tape.size()] - tape[i];
    const double step = way.norm();
    if (left <= step && step > 0.0) return tape[i] + way * (left / step);
    left -= step;
  }
  return tape.front();
}

Result<Belt> LayBelt(const TriangleMesh& body, double height, const PaperFrame& frame) {
  SectionPlane plane;
  plane.origin = height * frame.Up();
  // The body's left is +across where it faces the front: left x up = front is kept by both frames.
  plane.u = Eigen::Vector3d::Unit(frame.across);
  plane.v = frame.Front();
  std::vector<int> triangles(body.triangles.size());
  std::iota(triangles.begin(), triangles.end(), 0);
  const std::vector<SectionLoop> loops = CutByPlane(body, triangles, plane, {});
  std::vector<Eigen::Vector2d> hull;
  if (!loops.empty()) hull = ConvexHull(loops.front().points);
  if (hull.size() < 3) {
    return FailedPrecondition("NO_BODY_AT_BELT",
                              "there is no body at the height of the garment's top edge, so that no "
                              "belt can be laid; start the garment lower");
  }
  const double middle = ComputeMoments(hull).centroid.x();
  const CentreFront front = FindCentreFront(hull, middle);
  Belt belt;
  belt.height = height;
  belt.length = ClosedLength(hull);
  belt.tape.push_back(plane.ToSpace(front.place));
  // Corners run from u to v, front to right; over the left they are met backwards.
  for (size_t i = 0; i < hull.size(); ++i) {
    const size_t corner = (front.edge + hull.size() - i) % hull.size();
    belt.tape.push_back(plane.ToSpace(hull[corner]));
  }
  return belt;
}

std::vector<Eigen::Vector3d> PlaceOnBelt(const Belt& belt, std::span<const double> rest_distances, double rest_length) {
  std::vector<Eigen::Vector3d> places;
  for (const double distance : rest_distances) places.push_back(belt.At(distance / rest_length * belt.length));
  return places;
}

}  // namespace fitroom::paper

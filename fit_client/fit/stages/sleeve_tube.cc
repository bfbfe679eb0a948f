#include "fit_client/fit/stages/sleeve_tube.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "common/body/plane_section.h"
#include "fit_client/fit/stages/tape_curve.h"

namespace fitroom {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kBegins = 0.04;      // The tube's share grows from so far below the underarm (unit: metre)
constexpr double kReached = 0.14;     // until there.
constexpr double kOverHand = 0.015;   // A sleeve's end starts at most so far beyond the wrist (unit: metre).
constexpr double kMostPushed = 0.5;   // A sleeve is pushed together to no less than this share of its length.
constexpr double kStation = 0.01;     // From section to section (unit: metre).
constexpr double kBendReach = 0.05;   // The axis' direction is taken over so much to both sides (unit: metre).
constexpr double kArmReach = 0.08;    // What is farther from the axis is not the arm's (unit: metre).
constexpr double kHandLength = 0.20;  // So far beyond the wrist the axis goes on (unit: metre).

double DistanceToSegment(const Vector3d& point, const Vector3d& a, const Vector3d& b) {
  const Vector3d along = b - a;
  const double t = std::clamp((point - a).dot(along) / std::max(along.squaredNorm(), 1e-12), 0.0, 1.0);
  return (a + t * along - point).norm();
}

// The arm as a bent line from the shoulder to the finger tips, walked by arc length.
class ArmLine {
 public:
  explicit ArmLine(const LimbAxis& arm)
      : points_{arm.root, arm.joint, arm.end, arm.end + kHandLength * (arm.end - arm.joint).normalized()} {}

  double elbow() const { return (points_[1] - points_[0]).norm(); }
  double wrist() const { return elbow() + (points_[2] - points_[1]).norm(); }
  Vector3d At(double way) const {
    size_t k = 0;
    while (k + 2 < points_.size() && way > Length(k)) way -= Length(k++);
    return points_[k] + way / std::max(Length(k), 1e-9) * (points_[k + 1] - points_[k]);
  }
  Vector3d Direction(double way) const { return (At(way + kBendReach) - At(way - kBendReach)).normalized(); }
  // The way to the point of the line that is nearest to a place, between the shoulder and the wrist.
  double NearestTo(const Vector3d& place) const {
    double nearest = 0.0;
    double least = std::numeric_limits<double>::infinity();
    for (double way = 0.0; way <= wrist(); way += 0.25 * kStation) {
      const double distance = (At(way) - place).squaredNorm();
      if (distance >= least) continue;
      least = distance;
      nearest = way;
    }
    return nearest;
  }

 private:
  double Length(size_t k) const { return (points_[k + 1] - points_[k]).norm(); }
  std::array<Vector3d, 4> points_;
};

// Where a particle lies on its sleeve.
struct SleevePlace {
  int particle = 0;
  double from_end = 0.0;  // From the line through the sleeve's end (unit: metre).
  double across = 0.0;    // 0 on the top seam, 1 on the underside's.
  double width = 0.0;     // Of the flat sleeve here (unit: metre).
};

class SleeveTube {
 public:
  SleeveTube(const ClothMesh& cloth, const SleeveSeams& seams, int side, const ArmLine& arm,
             const TriangleMesh& dressed, double clearance)
      : cloth_(cloth), seams_(seams), side_(side), arm_(arm), dressed_(dressed), clearance_(clearance) {}

  void Lay(std::vector<Vector3d>& places) {
    FindPlaces();
    begin_ = FromEnd(seams_.under[0].front()) - kBegins;
    const std::optional<double> way = WayOf(begin_, places);
    if (!way || *way + begin_ < arm_.elbow()) return;
    begin_way_ = *way;
    scale_ = std::clamp((arm_.wrist() + kOverHand - begin_way_) / begin_, kMostPushed, 1.0);
    MeasureWidths();
    if (!CutStations()) return;
    for (const SleevePlace& at : sleeve_) {
      const double part = std::clamp((begin_ - at.from_end) / (kReached - kBegins), 0.0, 1.0);
      if (part <= 0.0) continue;
      Vector3d& place = places[static_cast<size_t>(at.particle)];
      place = (1.0 - part) * place + part * InTube(at);
    }
  }

 private:
  struct Station {
    SectionPlane plane;
    TapeCurve tape;
  };

  const Vector3d& Rest(int particle) const { return cloth_.rest_positions[static_cast<size_t>(particle)]; }

  double FromEnd(int particle) const {
    const size_t panel = static_cast<size_t>(cloth_.panel_of_particle[static_cast<size_t>(particle)]);
    const Vector3d& top = Rest(seams_.top[panel].back());
    const Vector3d& bottom = Rest(seams_.under[panel].back());
    const Vector3d along = (bottom - top).normalized();
    const Vector3d way = Rest(particle) - top;
    return (way - way.dot(along) * along).norm();
  }

  double FromSeam(int particle, const std::vector<int>& seam) const {
    double least = std::numeric_limits<double>::infinity();
    for (size_t k = 1; k < seam.size(); ++k) {
      least = std::min(least, DistanceToSegment(Rest(particle), Rest(seam[k - 1]), Rest(seam[k])));
    }
    return least;
  }

  void FindPlaces() {
    const std::vector<double>& weights = side_ > 0 ? cloth_.left_sleeve_weights : cloth_.right_sleeve_weights;
    for (size_t i = 0; i < weights.size(); ++i) {
      if (weights[i] < 0.5) continue;
      const size_t panel = static_cast<size_t>(cloth_.panel_of_particle[i]);
      const int particle = static_cast<int>(i);
      const double top = FromSeam(particle, seams_.top[panel]);
      const double under = FromSeam(particle, seams_.under[panel]);
      sleeve_.push_back({particle, FromEnd(particle), top / std::max(top + under, 1e-9), top + under});
    }
  }

  // The mean way along the arm of the particles that lie `from_end` before the sleeve's end.
  std::optional<double> WayOf(double from_end, const std::vector<Vector3d>& places) const {
    Vector3d sum = Vector3d::Zero();
    int count = 0;
    for (const SleevePlace& at : sleeve_) {
      if (std::abs(at.from_end - from_end) > 0.5 * kStation) continue;
      sum += places[static_cast<size_t>(at.particle)];
      ++count;
    }
    if (count == 0 || from_end <= 0.0) return std::nullopt;
    return arm_.NearestTo(sum / count);
  }

  // Mean flat width by distance from the sleeve's end, centimetre by centimetre.
  void MeasureWidths() {
    const size_t size = static_cast<size_t>(begin_ / kStation) + 2;
    widths_.assign(size, 0.0);
    std::vector<int> counts(size, 0);
    for (const SleevePlace& at : sleeve_) {
      const size_t k = static_cast<size_t>(at.from_end / kStation);
      if (k >= size) continue;
      widths_[k] += at.width;
      ++counts[k];
    }
    for (size_t k = 0; k < size; ++k) {
      if (counts[k] > 0) widths_[k] /= counts[k];
      if (counts[k] == 0 && k > 0) widths_[k] = widths_[k - 1];
    }
  }

  // Triangles near the line, so that not all of the body is cut at every station.
  std::vector<int> TrianglesNearArm() const {
    Eigen::AlignedBox3d box;
    for (double way = begin_way_; way <= arm_.wrist() + kHandLength; way += kStation) box.extend(arm_.At(way));
    box.min().array() -= kArmReach;
    box.max().array() += kArmReach;
    std::vector<int> near;
    for (size_t t = 0; t < dressed_.triangles.size(); ++t) {
      Eigen::AlignedBox3d bounds;
      for (int k = 0; k < 3; ++k) bounds.extend(dressed_.vertices[static_cast<size_t>(dressed_.triangles[t][k])]);
      if (bounds.intersects(box)) near.push_back(static_cast<int>(t));
    }
    return near;
  }

  // What of a section belongs to the arm: outlines round the axis; a part of one where the arm touches the trunk.
  static std::vector<Vector2d> OutlineOfArm(const std::vector<SectionLoop>& loops) {
    std::vector<Vector2d> points;
    for (const SectionLoop& loop : loops) {
      if (loop.centroid.norm() > kArmReach) continue;
      points.insert(points.end(), loop.points.begin(), loop.points.end());
    }
    if (!points.empty()) return points;
    for (const SectionLoop& loop : loops) {
      for (const Vector2d& point : loop.points) {
        if (point.norm() < kArmReach) points.push_back(point);
      }
    }
    return points;
  }

  bool CutStations() {
    const std::vector<int> triangles = TrianglesNearArm();
    for (double from_begin = 0.0; from_begin <= begin_ + kStation; from_begin += kStation) {
      const double way = begin_way_ + scale_ * from_begin;
      Station station;
      const Vector3d along = arm_.Direction(way);
      station.plane.origin = arm_.At(way);
      // Outwards in the frontal plane, as the top seam runs; then towards the front.
      const Vector3d outwards(-side_ * along.y(), side_ * along.x(), 0.0);
      station.plane.u = (outwards - outwards.dot(along) * along).normalized();
      station.plane.v = along.cross(station.plane.u).normalized();
      if (station.plane.v.z() < 0.0) station.plane.v = -station.plane.v;
      const std::vector<Vector2d> points = OutlineOfArm(CutByPlane(dressed_, triangles, station.plane, {}));
      const size_t level = static_cast<size_t>(std::max(0.0, begin_ - from_begin) / kStation);
      station.tape = TapeCurve::AsWideAs(2.0 * widths_[std::min(level, widths_.size() - 1)], points, clearance_);
      if (station.tape.is_empty()) {
        if (stations_.empty()) return false;
        station = stations_.back();
        station.plane.origin = arm_.At(way);
      } else {
        station.tape.StartTowards(station.tape.middle(), {1.0, 0.0});
      }
      stations_.push_back(std::move(station));
    }
    return stations_.size() >= 2;
  }

  Vector3d InTube(const SleevePlace& at) const {
    const double place =
        std::clamp((begin_ - at.from_end) / kStation, 0.0, static_cast<double>(stations_.size() - 1) - 1e-6);
    const size_t k = static_cast<size_t>(place);
    const double part = place - static_cast<double>(k);
    return (1.0 - part) * AtStation(stations_[k], at) + part * AtStation(stations_[k + 1], at);
  }

  Vector3d AtStation(const Station& station, const SleevePlace& at) const {
    const double way = 0.5 * at.across * station.tape.length();
    const bool is_front = cloth_.panel_of_particle[static_cast<size_t>(at.particle)] == 0;
    return station.plane.ToSpace(station.tape.At(is_front ? -way : way));
  }

  const ClothMesh& cloth_;
  const SleeveSeams& seams_;
  const int side_;
  const ArmLine& arm_;
  const TriangleMesh& dressed_;
  const double clearance_;
  std::vector<SleevePlace> sleeve_;
  std::vector<double> widths_;  // Level k: k to k + 1 stations from the sleeve's end (unit: metre).
  std::vector<Station> stations_;
  double begin_ = 0.0;      // Distance from the sleeve's end at which the tube begins (unit: metre).
  double begin_way_ = 0.0;  // There, along the arm (unit: metre).
  double scale_ = 1.0;      // Of the sleeve's length on the arm.
};

}  // namespace

void LaySleeveRoundArm(const ClothMesh& cloth, const SleeveSeams& seams, int side, const LimbAxis& arm,
                       const TriangleMesh& dressed, double clearance, std::vector<Vector3d>& places) {
  for (const size_t panel : {0, 1}) {
    if (seams.top[panel].size() < 2 || seams.under[panel].size() < 2) return;
  }
  const ArmLine line(arm);
  if (line.elbow() < kBendReach || line.wrist() - line.elbow() < kBendReach) return;
  SleeveTube(cloth, seams, side, line, dressed, clearance).Lay(places);
}

}  // namespace fitroom

#include "fit_client/fit/stages/press_under.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "common/garment/garment.h"
#include "fit_client/fit/stages/push_out.h"

namespace fitroom {
namespace {

using Eigen::Vector3d;

constexpr double kReach = 0.05;    // Cloth that is farther away is not over a particle (unit: metre).
constexpr double kFacing = 0.3;    // Cosine of the angle between two cloths' normals up to which one is over the other.
constexpr double kUnder = 0.0015;  // Pressed cloth lies so far under the other (unit: metre),
constexpr double kOffBody = 0.001;     // and so far off the body (unit: metre).
constexpr double kAcrossReach = 0.02;  // Cloth farther to the side than this ends before the particle (unit: metre).
constexpr double kBeyondEdge = 0.004;  // The same beyond a hem or an armhole (unit: metre).
constexpr double kLargestStretch = 1.1;
constexpr int kRounds = 6;

std::vector<Vector3d> NormalsOf(const WornCloth& worn) {
  std::vector<Vector3d> normals(worn.places.size(), Vector3d::Zero());
  for (const Eigen::Vector3i& triangle : worn.cloth.triangles) {
    const auto at = [&](int k) { return worn.places[static_cast<size_t>(triangle[k])]; };
    const Vector3d normal = (at(1) - at(0)).cross(at(2) - at(0));
    for (int k = 0; k < 3; ++k) normals[static_cast<size_t>(triangle[k])] += normal;
  }
  for (const SeamPair& pair : worn.cloth.seams) {
    Vector3d& a = normals[static_cast<size_t>(pair.a)];
    Vector3d& b = normals[static_cast<size_t>(pair.b)];
    a = b = a + b;
  }
  for (Vector3d& normal : normals) normal.normalize();
  return normals;
}

// Particles at hems, neck and armholes: on an edge of one triangle and sewn to nothing.
std::vector<bool> OpenEdges(const ClothMesh& cloth) {
  std::map<std::pair<int, int>, int> triangle_counts;
  for (const Eigen::Vector3i& triangle : cloth.triangles) {
    for (int k = 0; k < 3; ++k) ++triangle_counts[std::minmax(triangle[k], triangle[(k + 1) % 3])];
  }
  std::vector<bool> is_open(cloth.rest_positions.size(), false);
  for (const auto& [edge, count] : triangle_counts) {
    if (count == 1) is_open[static_cast<size_t>(edge.first)] = is_open[static_cast<size_t>(edge.second)] = true;
  }
  for (const SeamPair& pair : cloth.seams) {
    is_open[static_cast<size_t>(pair.a)] = is_open[static_cast<size_t>(pair.b)] = false;
  }
  return is_open;
}

// The particles of the outer cloth, by cells.
class OuterCloth {
 public:
  explicit OuterCloth(const WornCloth& worn)
      : places_(worn.places), normals_(NormalsOf(worn)), is_open_edge_(OpenEdges(worn.cloth)) {
    for (size_t i = 0; i < places_.size(); ++i) cells_[CellOf(places_[i])].push_back(i);
  }

  // How far a place lies outside of the cloth over it, negative under it, and that cloth's normal; nothing where no
  // cloth that faces along `normal` is near.
  std::optional<std::pair<double, Vector3d>> HeightOver(const Vector3d& place, const Vector3d& normal) const {
    size_t nearest = places_.size();
    double least = kReach * kReach;
    const Cell middle = CellOf(place);
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dz = -1; dz <= 1; ++dz) {
          const auto cell = cells_.find({middle[0] + dx, middle[1] + dy, middle[2] + dz});
          if (cell == cells_.end()) continue;
          for (const size_t i : cell->second) {
            const double distance = (places_[i] - place).squaredNorm();
            if (distance >= least || normals_[i].dot(normal) < kFacing) continue;
            least = distance;
            nearest = i;
          }
        }
      }
    }
    if (nearest == places_.size()) return std::nullopt;
    const double height = (place - places_[nearest]).dot(normals_[nearest]);
    const double across = is_open_edge_[nearest] ? kBeyondEdge : kAcrossReach;
    if (least - height * height > across * across) return std::nullopt;
    return std::pair(height, normals_[nearest]);
  }

 private:
  using Cell = std::array<int, 3>;
  static Cell CellOf(const Vector3d& place) {
    const auto index = [](double value) { return static_cast<int>(std::floor(value / kReach)); };
    return {index(place.x()), index(place.y()), index(place.z())};
  }
  const std::vector<Vector3d>& places_;
  std::vector<Vector3d> normals_;
  std::vector<bool> is_open_edge_;
  std::map<Cell, std::vector<size_t>> cells_;
};

// Moves the corners of edges and triangles whose middles lie in the body.
void LiftMiddles(const ClothMesh& cloth, const SignedDistanceField& field, std::vector<Vector3d>& places) {
  const auto lift = [&](const auto& corners) {
    Vector3d middle = Vector3d::Zero();
    for (const int corner : corners) middle += places[static_cast<size_t>(corner)];
    middle /= static_cast<double>(corners.size());
    if (field.Distance(middle) > 0.5 * field.pitch()) return;
    const double distance = field.ExactDistance(middle);
    const Vector3d gradient = field.Query(middle).gradient;
    if (distance >= 0.5 * kOffBody || gradient.norm() < 0.1) return;
    for (const int corner : corners) {
      places[static_cast<size_t>(corner)] += (kOffBody - distance) * gradient.normalized();
    }
  };
  for (const Eigen::Vector3i& triangle : cloth.triangles) {
    for (int k = 0; k < 3; ++k) lift(std::array<int, 2>{triangle[k], triangle[(k + 1) % 3]});
    lift(std::array<int, 3>{triangle[0], triangle[1], triangle[2]});
  }
}

// Draws together what pressing has parted: edges that are longer than they were worn by more than kLargestStretch.
class StretchLimit {
 public:
  StretchLimit(const ClothMesh& cloth, const std::vector<Vector3d>& worn) {
    std::vector<int> sewn_to(worn.size());
    for (size_t i = 0; i < sewn_to.size(); ++i) sewn_to[i] = static_cast<int>(i);
    for (const SeamPair& pair : cloth.seams) {
      sewn_to[static_cast<size_t>(pair.b)] = sewn_to[static_cast<size_t>(pair.a)];
    }
    std::map<std::pair<int, int>, double> lengths;
    for (const Eigen::Vector3i& triangle : cloth.triangles) {
      for (int k = 0; k < 3; ++k) {
        const size_t a = static_cast<size_t>(triangle[k]);
        const size_t b = static_cast<size_t>(triangle[(k + 1) % 3]);
        const double rest = (cloth.rest_positions[a] - cloth.rest_positions[b]).norm();
        const double limit = kLargestStretch * std::max(rest, (worn[a] - worn[b]).norm());
        lengths.emplace(std::minmax(sewn_to[a], sewn_to[b]), limit);
      }
    }
    limits_.assign(lengths.begin(), lengths.end());
    sewn_to_ = std::move(sewn_to);
  }

  void Draw(std::vector<Vector3d>& places) const {
    constexpr int kSweeps = 40;
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      for (const auto& [edge, limit] : limits_) {
        Vector3d& a = places[static_cast<size_t>(edge.first)];
        Vector3d& b = places[static_cast<size_t>(edge.second)];
        const Vector3d way = b - a;
        const double length = way.norm();
        if (length <= limit) continue;
        const Vector3d half = 0.5 * (length - limit) / length * way;
        a += half;
        b -= half;
      }
    }
    for (size_t i = 0; i < places.size(); ++i) places[i] = places[static_cast<size_t>(sewn_to_[i])];
  }

 private:
  std::vector<std::pair<std::pair<int, int>, double>> limits_;
  std::vector<int> sewn_to_;  // The particle that stands for both sides of a seam.
};

}  // namespace

bool YieldsToWhatIsOver(GarmentKind kind) { return !IsBottom(kind); }

Result<std::vector<Vector3d>> PressUnder(const WornCloth& worn, const WornCloth& over, const DressedBody& wearer,
                                         double field_pitch, Executor& executor) {
  FR_CHECK(worn.places.size() == worn.cloth.rest_positions.size());
  FR_CHECK(over.places.size() == over.cloth.rest_positions.size());
  Eigen::AlignedBox3d reach;
  for (const Vector3d& place : worn.places) reach.extend(place);
  reach.min().array() -= kReach;
  reach.max().array() += kReach;
  FR_ASSIGN_OR_RETURN(const SignedDistanceField field,
                      BuildDressedField(wearer.collider, wearer.layers, reach, field_pitch, executor));
  const OuterCloth outer(over);
  std::vector<Vector3d> places = worn.places;
  const StretchLimit stretch(worn.cloth, worn.places);
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<Vector3d> normals = NormalsOf({worn.cloth, places});
    for (size_t i = 0; i < places.size(); ++i) {
      const auto above = outer.HeightOver(places[i], normals[i]);
      if (above && above->first > -kUnder) places[i] -= (above->first + kUnder) * above->second;
    }
    stretch.Draw(places);
    for (Vector3d& place : places) {
      if (field.Distance(place) < kOffBody) place = PlaceAtDistance(field, place, kOffBody);
    }
    LiftMiddles(worn.cloth, field, places);
    for (const SeamPair& pair : worn.cloth.seams) {
      places[static_cast<size_t>(pair.b)] = places[static_cast<size_t>(pair.a)];
    }
  }
  return places;
}

}  // namespace fitroom

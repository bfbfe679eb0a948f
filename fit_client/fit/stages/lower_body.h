#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/base/status.h"
#include "common/body/body.h"
#include "common/geometry/triangle_mesh.h"
#include "fit_client/fit/stages/worn_layers.h"

namespace fitroom {

// The part of a dressed body that bottoms are worn on, level by level: what is seen of trunk and legs in horizontal
// sections, arms left out. Body frame, metres; points are (x, z).
class LowerBody {
 public:
  struct Level {
    std::vector<Eigen::Vector2d> trunk;               // Everything but the arms: trunk, or both legs.
    std::array<std::vector<Eigen::Vector2d>, 2> leg;  // Below the groin: left, right. Empty above.
    double front = 0.0;                               // Of the midline: z of the body's surface, above the groin.
    double back = 0.0;
    bool has_midline = false;
  };

  // Cuts the closed body and what is worn on it already (closed meshes) every centimetre. FAILED_PRECONDITION
  // (LANDMARK_MISSING, NOT_A_BODY) where the scan shows no crotch, waist or hip.
  static Result<LowerBody> Cut(const Body& body, const TriangleMesh& collider, std::span<const WornGarment> layers);

  // The level nearest to a height.
  const Level& At(double height) const;
  const Eigen::Vector3d& groin() const { return groin_; }
  // Where a bottom is worn by its waist: the body's, or lower where that lies right under the bust.
  double waist_height() const { return waist_height_; }
  double hip_height() const { return hip_height_; }
  double highest() const { return kStep * static_cast<double>(levels_.size() - 1); }
  // Perimeter of the trunk's convex hull at a height (unit: metre).
  double TrunkGirth(double height) const;

  static constexpr double kStep = 0.01;  // (unit: metre)

 private:
  std::vector<Level> levels_;  // Level k lies at k steps.
  Eigen::Vector3d groin_ = Eigen::Vector3d::Zero();
  double waist_height_ = 0.0;
  double hip_height_ = 0.0;
};

}  // namespace fitroom

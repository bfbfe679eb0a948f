#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include <Eigen/Core>

#include "common/geometry/triangle_mesh.h"

namespace fitroom {

// The surface points that dressing needs, found on the raw scan. Left and right are the body's own (+X is its left).
// Definitions follow ISO 8559-1; kArmpit is the lowest point where the upper arm leaves the torso (the apex of the
// hollow), kAcromion the outermost point of the shoulder's edge, kSideNeck where the neck meets the shoulder slope.
enum class BodyLandmark {
  kCrown,
  kFrontNeck,
  kBackNeckC7,
  kSideNeckLeft,
  kSideNeckRight,
  kAcromionLeft,
  kAcromionRight,
  kArmpitLeft,
  kArmpitRight,
  kElbowLeft,
  kElbowRight,
  kWristLeft,
  kWristRight,
  kBustPointLeft,
  kBustPointRight,
  kNavel,
  kWaistFront,
  kWaistBack,
  kHipSideLeft,
  kHipSideRight,
  kButtockMidBack,
  kCrotch,
  kKneeLeft,
  kKneeRight,
  kAnkleLeft,
  kAnkleRight,
};
inline constexpr int kBodyLandmarkCount = static_cast<int>(BodyLandmark::kAnkleRight) + 1;

// Returns the landmark's name in files and on the wire: "front_neck", "acromion_L", …
std::string_view LandmarkName(BodyLandmark landmark);
// Returns the landmark of that name, if there is one.
std::optional<BodyLandmark> LandmarkFromName(std::string_view name);

// A landmark's place and how far it is to be trusted.
struct LandmarkEstimate {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // In the body's canonical frame (unit: metre).
  double confidence = 0.0;                             // 0: not found, position meaningless; 1: certain.
};

// All landmarks of one body, in the canonical frame.
struct BodyLandmarks {
  std::array<LandmarkEstimate, kBodyLandmarkCount> estimates;

  const LandmarkEstimate& operator[](BodyLandmark landmark) const { return estimates[static_cast<size_t>(landmark)]; }
  LandmarkEstimate& operator[](BodyLandmark landmark) { return estimates[static_cast<size_t>(landmark)]; }
};

// A straight limb: from its root (shoulder or hip joint) to its end (wrist or ankle), inside the body.
struct LimbAxis {
  Eigen::Vector3d root = Eigen::Vector3d::Zero();   // (unit: metre)
  Eigen::Vector3d joint = Eigen::Vector3d::Zero();  // Elbow or knee (unit: metre).
  Eigen::Vector3d end = Eigen::Vector3d::Zero();    // (unit: metre)
};

// What a tape would measure, with the height at which it lay. A girth is the perimeter of the section's convex hull.
struct GirthMeasurement {
  double girth = 0.0;   // (unit: metre)
  double height = 0.0;  // Above the floor (unit: metre).
};

struct BodyMeasurements {
  double stature = 0.0;  // (unit: metre)
  GirthMeasurement bust;
  GirthMeasurement waist;
  GirthMeasurement hip;
  GirthMeasurement neck;
};

// A body ready to be dressed: canonical frame (right-handed, Y up, floor at Y = 0, facing +Z, +X its left, metres).
// The mesh is the scan as measured: holes and noise are still in it.
struct Body {
  TriangleMesh mesh;
  BodyLandmarks landmarks;
  LimbAxis arm_left, arm_right, leg_left, leg_right;
  BodyMeasurements measurements;
};

}  // namespace fitroom

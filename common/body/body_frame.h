#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "common/base/status.h"
#include "common/geometry/triangle_mesh.h"

namespace fitroom {

// One of the six directions along a file's coordinate axes.
struct SignedAxis {
  int axis = 0;  // 0: x, 1: y, 2: z.
  int sign = 1;  // +1 or -1.

  Eigen::Vector3d direction() const { return sign * Eigen::Vector3d::Unit(axis); }
  friend bool operator==(const SignedAxis&, const SignedAxis&) = default;
};

// Returns "+x", "-z", …
std::string AxisName(SignedAxis axis);
// Reads "z", "+z", "-z" (either case); INVALID_ARGUMENT BAD_AXIS otherwise.
Result<SignedAxis> ParseAxis(std::string_view text);

// A unit of length that scan files are written in.
struct LengthUnit {
  std::string_view name;  // "m", "dm", "cm", "mm", "in", "ft".
  double metres = 1.0;    // One unit (unit: metre).
};

// Reads a unit by its name ("inch" and "foot" are taken too); INVALID_ARGUMENT BAD_UNIT otherwise.
Result<LengthUnit> ParseUnit(std::string_view text);

// What an operator knows better than the shape tells. Axes are the file's own.
struct FrameOverrides {
  std::optional<SignedAxis> up;
  std::optional<SignedAxis> facing;
  std::optional<LengthUnit> unit;
};

// What was decided about a file's frame, for people and for the wire.
struct FrameReport {
  std::string up;                    // The file axis nearest to the body's up, for example "+z".
  std::string facing;                // The file axis nearest to where the body looks, for example "-y".
  std::string unit;                  // For example "cm".
  double tilt_deg = 0.0;             // Between `up` and the direction that was used; 0 where the axis itself was.
  double yaw_deg = 0.0;              // The same for `facing`.
  std::vector<std::string> reasons;  // One sentence each: what was decided, and why.
};

// A rotation, a scale and a shift: x -> scale * rotation * x + translation.
struct Similarity {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  double scale = 1.0;
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator*(const Eigen::Vector3d& p) const { return scale * (rotation * p) + translation; }
  Similarity Inverse() const;
};

// Stature that a body may have (unit: metre).
inline constexpr double kMinStature = 0.9;
inline constexpr double kMaxStature = 2.3;

struct DetectedFrame {
  Similarity canonical_from_file;  // Floor at Y = 0; x = z = 0 is the middle of the trunk (see README).
  FrameReport report;
};

// Finds out of the shape alone which way a standing body is up, where it faces, and in which unit it is measured,
// unless overridden. Fails with
//   NOT_A_BODY              the shape has no two legs below a trunk below one head, whichever axis is taken as up
//   SEVERAL_BODIES          more than one body stands in the file
//   STATURE_OUT_OF_RANGE    no unit, or the given one, makes the stature 0.9 to 2.3 m
//   AXES_NOT_PERPENDICULAR  the overrides for up and facing are parallel
// A mirrored file cannot be told from a right one: bodies are symmetric.
Result<DetectedFrame> DetectFrame(const TriangleMesh& mesh, const FrameOverrides& overrides);

}  // namespace fitroom

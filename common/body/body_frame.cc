#include "common/body/body_frame.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "common/body/stance.h"

namespace fitroom {
namespace {

constexpr std::array<LengthUnit, 6> kUnits = {{
    {"m", 1.0},
    {"cm", 0.01},
    {"mm", 0.001},
    {"in", 0.0254},
    {"dm", 0.1},
    {"ft", 0.3048},
}};

// A body stands as upright, and as square to the scanner, as people do: nearer than this the file's own axis is meant.
constexpr double kSnapAngle = 20.0 * std::numbers::pi / 180.0;

std::string Format(const char* format, double a, double b = 0.0) {
  std::array<char, 200> text;
  std::snprintf(text.data(), text.size(), format, a, b);
  return text.data();
}

SignedAxis NearestAxis(const Eigen::Vector3d& direction) {
  Eigen::Index axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  return {static_cast<int>(axis), direction[axis] < 0.0 ? -1 : 1};
}

double AngleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// The direction of the largest spread of the surface.
Eigen::Vector3d LongestDirection(const TriangleMesh& mesh) {
  const Eigen::Vector3d middle = ComputeBounds(mesh).center();
  double whole = 0.0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices[static_cast<size_t>(t[0])] - middle;
    const Eigen::Vector3d b = mesh.vertices[static_cast<size_t>(t[1])] - middle;
    const Eigen::Vector3d c = mesh.vertices[static_cast<size_t>(t[2])] - middle;
    const double area = (b - a).cross(c - a).norm();
    const Eigen::Vector3d centre = (a + b + c) / 3.0;
    whole += area;
    mean += area * centre;
    second += area * centre * centre.transpose();
  }
  mean /= whole;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(second / whole - mean * mean.transpose());
  return solver.eigenvectors().col(2);
}

// The directions worth trying as up, best first; the sign is found by the stance.
std::vector<Eigen::Vector3d> UpCandidates(const TriangleMesh& mesh) {
  const Eigen::Vector3d longest = LongestDirection(mesh);
  const SignedAxis nearest = NearestAxis(longest);
  std::vector<Eigen::Vector3d> candidates;
  const bool oblique =
      AngleBetween(nearest.direction(), longest.dot(nearest.direction()) < 0.0 ? Eigen::Vector3d(-longest) : longest) >
      kSnapAngle;
  if (oblique) candidates.push_back(longest);
  std::array<int, 3> axes = {0, 1, 2};
  std::sort(axes.begin(), axes.end(), [&](int a, int b) { return std::abs(longest[a]) > std::abs(longest[b]); });
  for (const int axis : axes) candidates.push_back(Eigen::Vector3d::Unit(axis));
  return candidates;
}

// Takes the first direction along which the shape stands like a body.
Result<Stance> FindStance(const TriangleMesh& mesh, const FrameOverrides& overrides) {
  if (overrides.up) return FindStanceAlong(mesh, overrides.up->direction(), /*sign_is_known=*/true);
  std::optional<Status> best_error;
  for (const Eigen::Vector3d& up : UpCandidates(mesh)) {
    Result<Stance> stance = FindStanceAlong(mesh, up, /*sign_is_known=*/false);
    if (stance.ok()) return stance;
    const bool several = stance.status().reason() == "SEVERAL_BODIES";
    if (!best_error || (several && best_error->reason() != "SEVERAL_BODIES")) best_error = stance.status();
  }
  return *best_error;
}

Result<LengthUnit> ChooseUnit(double stature_in_file, const FrameOverrides& overrides, FrameReport& report) {
  const auto fits = [stature_in_file](const LengthUnit& unit) {
    const double stature = stature_in_file * unit.metres;
    return stature >= kMinStature && stature <= kMaxStature;
  };
  if (overrides.unit) {
    if (!fits(*overrides.unit)) {
      return InvalidArgument("STATURE_OUT_OF_RANGE",
                             Format("the unit was given as ", 0.0) + std::string(overrides.unit->name) +
                                 Format(", which makes the stature %.4g m; a body has 0.9 to 2.3 m: give another unit",
                                        stature_in_file * overrides.unit->metres));
    }
    report.reasons.push_back("unit " + std::string(overrides.unit->name) + ": given by the operator");
    return *overrides.unit;
  }
  for (const LengthUnit& unit : kUnits) {
    if (!fits(unit)) continue;
    report.reasons.push_back(
        "unit " + std::string(unit.name) +
        Format(": the height of %.4g units is a stature of %.3f m", stature_in_file, stature_in_file * unit.metres));
    return unit;
  }
  return InvalidArgument("STATURE_OUT_OF_RANGE",
                         Format("the body is %.4g units tall, which is 0.9 to 2.3 m in none of m, dm, cm, mm, in, ft; "
                                "scale the file, or check that the scan shows the whole body",
                                stature_in_file));
}

// The direction the body faces, perpendicular to `up`.
Result<Eigen::Vector3d> ChooseFacing(const Stance& stance, const FrameOverrides& overrides, FrameReport& report) {
  if (overrides.facing) {
    const Eigen::Vector3d given = overrides.facing->direction();
    const Eigen::Vector3d level = given - given.dot(stance.up) * stance.up;
    if (level.norm() < 0.5) {
      return InvalidArgument("AXES_NOT_PERPENDICULAR", "the body cannot face " + AxisName(*overrides.facing) +
                                                           ", along its own height; give another --facing or --up");
    }
    report.facing = AxisName(*overrides.facing);
    report.reasons.push_back("facing " + report.facing + ": given by the operator");
    return Eigen::Vector3d(level.normalized());
  }
  const SignedAxis nearest = NearestAxis(stance.forward);
  report.facing = AxisName(nearest);
  Eigen::Vector3d facing = stance.forward;
  const double turn = AngleBetween(nearest.direction(), stance.forward);
  const Eigen::Vector3d level = nearest.direction() - nearest.direction().dot(stance.up) * stance.up;
  if (turn <= kSnapAngle) {
    facing = level.normalized();
  } else {
    report.yaw_deg = turn * 180.0 / std::numbers::pi;
  }
  report.reasons.push_back("facing " + report.facing + ": " + stance.facing_reason);
  if (report.yaw_deg != 0.0)
    report.reasons.push_back(Format("the body is turned by %.0f degrees from it", report.yaw_deg));
  return facing;
}

}  // namespace

std::string AxisName(SignedAxis axis) {
  return std::string(axis.sign < 0 ? "-" : "+") + static_cast<char>('x' + axis.axis);
}

Result<SignedAxis> ParseAxis(std::string_view text) {
  std::string_view rest = text;
  SignedAxis axis;
  if (!rest.empty() && (rest[0] == '+' || rest[0] == '-')) {
    axis.sign = rest[0] == '-' ? -1 : 1;
    rest.remove_prefix(1);
  }
  const int letter = rest.size() == 1 ? std::tolower(static_cast<unsigned char>(rest[0])) : 0;
  if (letter < 'x' || letter > 'z') {
    return InvalidArgument("BAD_AXIS", "an axis is one of x, y, z, -x, -y, -z, not '" + std::string(text) + "'");
  }
  axis.axis = letter - 'x';
  return axis;
}

Result<LengthUnit> ParseUnit(std::string_view text) {
  if (text == "inch") text = "in";
  if (text == "foot") text = "ft";
  for (const LengthUnit& unit : kUnits) {
    if (unit.name == text) return unit;
  }
  return InvalidArgument("BAD_UNIT", "a unit is one of m, dm, cm, mm, in, ft, not '" + std::string(text) + "'");
}

Similarity Similarity::Inverse() const {
  Similarity inverse;
  inverse.rotation = rotation.transpose();
  inverse.scale = 1.0 / scale;
  inverse.translation = -inverse.scale * (inverse.rotation * translation);
  return inverse;
}

Result<DetectedFrame> DetectFrame(const TriangleMesh& mesh, const FrameOverrides& overrides) {
  DetectedFrame frame;
  FR_ASSIGN_OR_RETURN(const Stance stance, FindStance(mesh, overrides));
  const SignedAxis up = NearestAxis(stance.up);
  frame.report.up = AxisName(up);
  const double tilt = AngleBetween(up.direction(), stance.up);
  frame.report.tilt_deg = tilt < 1e-6 ? 0.0 : tilt * 180.0 / std::numbers::pi;
  frame.report.reasons.push_back("up " + frame.report.up + ": " +
                                 (overrides.up ? "given by the operator" : stance.up_reason));
  if (frame.report.tilt_deg != 0.0) {
    frame.report.reasons.push_back(
        Format("the body's length is tilted by %.0f degrees from it", frame.report.tilt_deg));
  }
  FR_ASSIGN_OR_RETURN(const Eigen::Vector3d facing, ChooseFacing(stance, overrides, frame.report));
  FR_ASSIGN_OR_RETURN(const LengthUnit unit, ChooseUnit(stance.stature, overrides, frame.report));
  frame.report.unit = std::string(unit.name);

  Similarity& transform = frame.canonical_from_file;
  transform.rotation.row(0) = stance.up.cross(facing).transpose();
  transform.rotation.row(1) = stance.up.transpose();
  transform.rotation.row(2) = facing.transpose();
  transform.scale = unit.metres;
  transform.translation = -unit.metres * (transform.rotation * stance.floor_centre);
  return frame;
}

}  // namespace fitroom

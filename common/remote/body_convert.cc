#include "common/remote/body_convert.h"

#include <array>
#include <cmath>
#include <utility>

#include "common/base/resource_name.h"

namespace fitroom::remote {
namespace {

constexpr size_t kMaxFileNameSize = 255;  // (unit: byte)
constexpr std::array<std::string_view, 6> kUnits = {"m", "dm", "cm", "mm", "in", "ft"};
// In the order of body::v1::Axis from 1 on.
constexpr std::array<std::string_view, 6> kAxes = {"+x", "-x", "+y", "-y", "+z", "-z"};

using LimbField = std::pair<std::string_view, LimbAxis ScanRecord::*>;
constexpr std::array<LimbField, 4> kLimbs = {{{"arm_L", &ScanRecord::arm_left},
                                              {"arm_R", &ScanRecord::arm_right},
                                              {"leg_L", &ScanRecord::leg_left},
                                              {"leg_R", &ScanRecord::leg_right}}};

Status FieldInvalid(std::string_view field, std::string_view rule) {
  return InvalidArgument("FIELD_INVALID", std::string(field) + ": " + std::string(rule));
}

body::v1::Axis AxisToProto(std::string_view name) {
  for (size_t i = 0; i < kAxes.size(); ++i) {
    if (kAxes[i] == name) return static_cast<body::v1::Axis>(i + 1);
  }
  return body::v1::AXIS_UNSPECIFIED;
}

// Returns the axis' name, empty for AXIS_UNSPECIFIED.
Result<std::string> AxisFromProto(std::string_view field, body::v1::Axis axis) {
  const int number = static_cast<int>(axis);
  if (number == 0) return std::string();
  if (number < 0 || number > std::ssize(kAxes)) return FieldInvalid(field, "not an axis that this program knows");
  return std::string(kAxes[static_cast<size_t>(number - 1)]);
}

Result<std::string> UnitFromProto(const std::string& unit) {
  if (unit.empty()) return unit;
  for (const std::string_view known : kUnits) {
    if (unit == known) return unit;
  }
  return FieldInvalid("unit", "expected m, dm, cm, mm, in or ft");
}

Result<std::string> FileNameFromProto(const std::string& text) {
  const std::string name = text.substr(text.find_last_of("/\\") + 1);
  if (name.empty() || name.size() > kMaxFileNameSize) return FieldInvalid("file_name", "expected 1 to 255 bytes");
  for (const char c : name) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      return FieldInvalid("file_name", "holds a control character");
  }
  return name;
}

Result<Hash256> HashFromProto(std::string_view field, const std::string& bytes) {
  const std::optional<Hash256> hash = Hash256::FromBytes(bytes);
  if (!hash) return FieldInvalid(field, "expected 32 bytes");
  return *hash;
}

void PointToProto(const Eigen::Vector3d& point, body::v1::Point& message) {
  message.set_x_m(point.x());
  message.set_y_m(point.y());
  message.set_z_m(point.z());
}

Eigen::Vector3d PointFromProto(const body::v1::Point& message) { return {message.x_m(), message.y_m(), message.z_m()}; }

void GirthToProto(const GirthMeasurement& girth, body::v1::Girth& message) {
  message.set_girth_m(girth.girth);
  message.set_height_m(girth.height);
}

GirthMeasurement GirthFromProto(const body::v1::Girth& message) { return {message.girth_m(), message.height_m()}; }

bool IsFinite(const ScanRecord& scan) {
  double sum = scan.measurements.stature;
  for (const LandmarkEstimate& estimate : scan.landmarks.estimates)
    sum += estimate.position.sum() + estimate.confidence;
  for (const auto& [name, field] : kLimbs) {
    sum += (scan.*field).root.sum() + (scan.*field).joint.sum() + (scan.*field).end.sum();
  }
  for (const GirthMeasurement& girth :
       {scan.measurements.bust, scan.measurements.waist, scan.measurements.hip, scan.measurements.neck}) {
    sum += girth.girth + girth.height;
  }
  return std::isfinite(sum);
}

void FrameToProto(const FrameReport& frame, body::v1::FrameReport& message) {
  message.set_up(AxisToProto(frame.up));
  message.set_facing(AxisToProto(frame.facing));
  message.set_unit(frame.unit);
  message.set_tilt_deg(frame.tilt_deg);
  message.set_yaw_deg(frame.yaw_deg);
  for (const std::string& reason : frame.reasons) message.add_reasons(reason);
}

Result<FrameReport> FrameFromProto(const body::v1::FrameReport& message) {
  FrameReport frame;
  FR_ASSIGN_OR_RETURN(frame.up, AxisFromProto("frame.up", message.up()));
  FR_ASSIGN_OR_RETURN(frame.facing, AxisFromProto("frame.facing", message.facing()));
  frame.unit = message.unit();
  frame.tilt_deg = message.tilt_deg();
  frame.yaw_deg = message.yaw_deg();
  frame.reasons.assign(message.reasons().begin(), message.reasons().end());
  return frame;
}

}  // namespace

void ToProto(const ScanRecord& scan, body::v1::Scan& message) {
  message.set_name(ToString(scan.name));
  message.set_file_name(scan.file_name);
  message.set_original_size_bytes(scan.original_size);
  message.set_original_blake2b_256(std::string(scan.original_hash.view()));
  message.set_packed_mesh_size_bytes(scan.packed_mesh_size);
  message.set_packed_mesh_blake2b_256(std::string(scan.packed_mesh_hash.view()));
  message.mutable_register_time()->set_seconds(scan.register_time_unix_s);
  message.set_vertex_count(scan.vertex_count);
  message.set_triangle_count(scan.triangle_count);
  FrameToProto(scan.frame, *message.mutable_frame());
  for (int i = 0; i < kBodyLandmarkCount; ++i) {
    const LandmarkEstimate& estimate = scan.landmarks[static_cast<BodyLandmark>(i)];
    if (estimate.confidence <= 0) continue;
    body::v1::Landmark* landmark = message.add_landmarks();
    landmark->set_landmark(std::string(LandmarkName(static_cast<BodyLandmark>(i))));
    PointToProto(estimate.position, *landmark->mutable_position());
    landmark->set_confidence(estimate.confidence);
  }
  for (const auto& [name, field] : kLimbs) {
    body::v1::LimbAxis* limb = message.add_limb_axes();
    limb->set_limb(std::string(name));
    PointToProto((scan.*field).root, *limb->mutable_root());
    PointToProto((scan.*field).joint, *limb->mutable_joint());
    PointToProto((scan.*field).end, *limb->mutable_end());
  }
  body::v1::Measurements* measurements = message.mutable_measurements();
  measurements->set_stature_m(scan.measurements.stature);
  GirthToProto(scan.measurements.bust, *measurements->mutable_bust());
  GirthToProto(scan.measurements.waist, *measurements->mutable_waist());
  GirthToProto(scan.measurements.hip, *measurements->mutable_hip());
  GirthToProto(scan.measurements.neck, *measurements->mutable_neck());
}

Result<ScanRecord> ScanRecordFromProto(const body::v1::Scan& message) {
  ScanRecord scan;
  FR_ASSIGN_OR_RETURN(scan.name, ParseScanName(message.name()));
  FR_ASSIGN_OR_RETURN(scan.file_name, FileNameFromProto(message.file_name()));
  scan.original_size = message.original_size_bytes();
  FR_ASSIGN_OR_RETURN(scan.original_hash, HashFromProto("original_blake2b_256", message.original_blake2b_256()));
  scan.packed_mesh_size = message.packed_mesh_size_bytes();
  FR_ASSIGN_OR_RETURN(scan.packed_mesh_hash,
                      HashFromProto("packed_mesh_blake2b_256", message.packed_mesh_blake2b_256()));
  scan.register_time_unix_s = message.register_time().seconds();
  scan.vertex_count = message.vertex_count();
  scan.triangle_count = message.triangle_count();
  FR_ASSIGN_OR_RETURN(scan.frame, FrameFromProto(message.frame()));
  for (const body::v1::Landmark& landmark : message.landmarks()) {
    // A landmark of a later version is no error.
    const std::optional<BodyLandmark> known = LandmarkFromName(landmark.landmark());
    if (known) scan.landmarks[*known] = {PointFromProto(landmark.position()), landmark.confidence()};
  }
  for (const body::v1::LimbAxis& limb : message.limb_axes()) {
    for (const auto& [name, field] : kLimbs) {
      if (limb.limb() != name) continue;
      scan.*field = {PointFromProto(limb.root()), PointFromProto(limb.joint()), PointFromProto(limb.end())};
    }
  }
  const body::v1::Measurements& measurements = message.measurements();
  scan.measurements = {measurements.stature_m(), GirthFromProto(measurements.bust()),
                       GirthFromProto(measurements.waist()), GirthFromProto(measurements.hip()),
                       GirthFromProto(measurements.neck())};
  if (!IsFinite(scan)) return FieldInvalid("scan", "holds a number that is not finite");
  return scan;
}

void ToProto(const ScanUploadStatement& statement, body::v1::StartScanUploadRequest& message) {
  message.set_name(ToString(statement.name));
  message.set_file_name(statement.file_name);
  message.set_size_bytes(statement.size);
  message.set_blake2b_256(std::string(statement.hash.view()));
  message.set_up(AxisToProto(statement.up));
  message.set_facing(AxisToProto(statement.facing));
  message.set_unit(statement.unit);
}

Result<ScanUploadStatement> StatementFromProto(const body::v1::StartScanUploadRequest& message) {
  ScanUploadStatement statement;
  FR_ASSIGN_OR_RETURN(statement.name, ParseScanName(message.name()));
  FR_ASSIGN_OR_RETURN(statement.file_name, FileNameFromProto(message.file_name()));
  if (message.size_bytes() < 1 || message.size_bytes() > kMaxScanFileSize) {
    return FieldInvalid("size_bytes",
                        "a scan has 1 to 268435456 bytes (256 MiB); compress it with zstd if it is larger");
  }
  statement.size = message.size_bytes();
  FR_ASSIGN_OR_RETURN(statement.hash, HashFromProto("blake2b_256", message.blake2b_256()));
  FR_ASSIGN_OR_RETURN(statement.up, AxisFromProto("up", message.up()));
  FR_ASSIGN_OR_RETURN(statement.facing, AxisFromProto("facing", message.facing()));
  FR_ASSIGN_OR_RETURN(statement.unit, UnitFromProto(message.unit()));
  return statement;
}

std::string UploadName(const ScanUpload& upload) {
  return "bodies/" + upload.statement.name.body + "/uploads/" + upload.id;
}

Result<UploadRef> UploadRefFromName(std::string_view name) {
  constexpr std::string_view kBodies = "bodies/";
  constexpr std::string_view kUploads = "/uploads/";
  const size_t middle = name.find(kUploads);
  if (name.starts_with(kBodies) && middle != std::string_view::npos) {
    const std::string_view body = name.substr(kBodies.size(), middle - kBodies.size());
    const std::string_view id = name.substr(middle + kUploads.size());
    if (IsResourceId(body) && IsResourceId(id)) return UploadRef{std::string(body), std::string(id)};
  }
  return InvalidArgument("UPLOAD_NAME_INVALID", "an upload's name is bodies/BODY/uploads/UPLOAD");
}

void ToProto(const ScanUpload& upload, body::v1::ScanUpload& message) {
  message.set_name(UploadName(upload));
  message.set_scan(ToString(upload.statement.name));
  message.set_committed_size_bytes(upload.committed_size);
  message.set_size_bytes(upload.statement.size);
}

Result<ScanUpload> UploadFromProto(const body::v1::ScanUpload& message) {
  ScanUpload upload;
  FR_ASSIGN_OR_RETURN(UploadRef name, UploadRefFromName(message.name()));
  FR_ASSIGN_OR_RETURN(upload.statement.name, ParseScanName(message.scan()));
  if (name.body != upload.statement.name.body) return FieldInvalid("name", "names another body than the scan");
  upload.id = std::move(name.id);
  upload.statement.size = message.size_bytes();
  upload.committed_size = message.committed_size_bytes();
  if (upload.committed_size < 0 || upload.committed_size > upload.statement.size) {
    return FieldInvalid("committed_size_bytes", "outside of the file");
  }
  return upload;
}

body::v1::ScanContent ToProto(ScanContent content) {
  return content == ScanContent::kOriginal ? body::v1::SCAN_CONTENT_ORIGINAL : body::v1::SCAN_CONTENT_PACKED_MESH;
}

Result<ScanContent> ContentFromProto(body::v1::ScanContent content) {
  switch (content) {
    case body::v1::SCAN_CONTENT_ORIGINAL:
      return ScanContent::kOriginal;
    case body::v1::SCAN_CONTENT_PACKED_MESH:
      return ScanContent::kPackedMesh;
    default:
      return FieldInvalid("content", "expected SCAN_CONTENT_ORIGINAL or SCAN_CONTENT_PACKED_MESH");
  }
}

}  // namespace fitroom::remote

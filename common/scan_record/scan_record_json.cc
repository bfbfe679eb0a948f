#include "common/scan_record/scan_record_json.h"

#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

namespace fitroom {
namespace {

using Json = nlohmann::ordered_json;

constexpr char kFormat[] = "fitroom.scan";
constexpr int kVersion = 1;

template <typename Field>
using Named = std::pair<const char*, Field>;
constexpr std::array<Named<LimbAxis ScanRecord::*>, 4> kLimbs = {{{"arm_L", &ScanRecord::arm_left},
                                                                  {"arm_R", &ScanRecord::arm_right},
                                                                  {"leg_L", &ScanRecord::leg_left},
                                                                  {"leg_R", &ScanRecord::leg_right}}};
constexpr std::array<Named<GirthMeasurement BodyMeasurements::*>, 4> kGirths = {{{"bust", &BodyMeasurements::bust},
                                                                                 {"waist", &BodyMeasurements::waist},
                                                                                 {"hip", &BodyMeasurements::hip},
                                                                                 {"neck", &BodyMeasurements::neck}}};

Json PointToJson(const Eigen::Vector3d& point) { return Json::array({point.x(), point.y(), point.z()}); }

double FiniteFromJson(const Json& json) {
  const double value = json.get<double>();
  if (!std::isfinite(value)) throw std::invalid_argument("a number is not finite");
  return value;
}

Eigen::Vector3d PointFromJson(const Json& json) {
  if (json.size() != 3) throw std::invalid_argument("a point has three coordinates");
  return {FiniteFromJson(json.at(0)), FiniteFromJson(json.at(1)), FiniteFromJson(json.at(2))};
}

Hash256 HashFromJson(const Json& json) {
  const std::optional<Hash256> hash = Hash256::FromHex(json.get<std::string>());
  if (!hash) throw std::invalid_argument("a hash has 64 hexadecimal digits");
  return *hash;
}

Json FrameToJson(const FrameReport& frame) {
  return {{"up", frame.up},           {"facing", frame.facing},  {"unit", frame.unit}, {"tilt_deg", frame.tilt_deg},
          {"yaw_deg", frame.yaw_deg}, {"reasons", frame.reasons}};
}

FrameReport FrameFromJson(const Json& json) {
  FrameReport frame;
  frame.up = json.at("up").get<std::string>();
  frame.facing = json.at("facing").get<std::string>();
  frame.unit = json.at("unit").get<std::string>();
  frame.tilt_deg = FiniteFromJson(json.at("tilt_deg"));
  frame.yaw_deg = FiniteFromJson(json.at("yaw_deg"));
  frame.reasons = json.at("reasons").get<std::vector<std::string>>();
  return frame;
}

ScanRecord RecordFromJson(const Json& json) {
  if (json.at("format") != kFormat || json.at("version") != kVersion) {
    throw std::invalid_argument("not a fitroom.scan of version 1");
  }
  ScanRecord scan;
  const Result<ScanName> name = ParseScanName(json.at("name").get<std::string>());
  if (!name.ok()) throw std::invalid_argument(name.status().message());
  scan.name = *name;
  scan.file_name = json.at("file_name").get<std::string>();
  scan.original_size = json.at("original_size_bytes").get<int64_t>();
  scan.original_hash = HashFromJson(json.at("original_blake2b_256"));
  scan.packed_mesh_size = json.at("packed_mesh_size_bytes").get<int64_t>();
  scan.packed_mesh_hash = HashFromJson(json.at("packed_mesh_blake2b_256"));
  scan.register_time_unix_s = json.at("register_time_unix_s").get<int64_t>();
  scan.vertex_count = json.at("vertex_count").get<int64_t>();
  scan.triangle_count = json.at("triangle_count").get<int64_t>();
  scan.frame = FrameFromJson(json.at("frame"));
  for (const auto& [landmark, estimate] : json.at("landmarks").items()) {
    const std::optional<BodyLandmark> known = LandmarkFromName(landmark);
    if (!known) continue;
    scan.landmarks[*known] = {PointFromJson(estimate.at("canonical_m")), FiniteFromJson(estimate.at("confidence"))};
  }
  for (const auto& [limb, field] : kLimbs) {
    const Json& axis = json.at("limb_axes").at(limb);
    scan.*
        field = {PointFromJson(axis.at("root_m")), PointFromJson(axis.at("joint_m")), PointFromJson(axis.at("end_m"))};
  }
  scan.measurements.stature = FiniteFromJson(json.at("stature_m"));
  for (const auto& [girth, field] : kGirths) {
    const Json& measured = json.at("girths").at(girth);
    scan.measurements.*field = {FiniteFromJson(measured.at("girth_m")), FiniteFromJson(measured.at("height_m"))};
  }
  return scan;
}

}  // namespace

std::string ScanRecordToJson(const ScanRecord& scan) {
  Json json = {{"format", kFormat},
               {"version", kVersion},
               {"name", ToString(scan.name)},
               {"file_name", scan.file_name},
               {"original_size_bytes", scan.original_size},
               {"original_blake2b_256", scan.original_hash.ToHex()},
               {"packed_mesh_size_bytes", scan.packed_mesh_size},
               {"packed_mesh_blake2b_256", scan.packed_mesh_hash.ToHex()},
               {"register_time_unix_s", scan.register_time_unix_s},
               {"vertex_count", scan.vertex_count},
               {"triangle_count", scan.triangle_count},
               {"frame", FrameToJson(scan.frame)},
               {"landmarks", Json::object()},
               {"limb_axes", Json::object()},
               {"stature_m", scan.measurements.stature},
               {"girths", Json::object()},
               {"girths_cm", Json::object()}};
  for (int i = 0; i < kBodyLandmarkCount; ++i) {
    const auto landmark = static_cast<BodyLandmark>(i);
    const LandmarkEstimate& estimate = scan.landmarks[landmark];
    if (estimate.confidence <= 0) continue;
    json["landmarks"][std::string(LandmarkName(landmark))] = {{"canonical_m", PointToJson(estimate.position)},
                                                              {"confidence", estimate.confidence}};
  }
  for (const auto& [limb, field] : kLimbs) {
    const LimbAxis& axis = scan.*field;
    json["limb_axes"][limb] = {
        {"root_m", PointToJson(axis.root)}, {"joint_m", PointToJson(axis.joint)}, {"end_m", PointToJson(axis.end)}};
  }
  for (const auto& [girth, field] : kGirths) {
    const GirthMeasurement& measured = scan.measurements.*field;
    json["girths"][girth] = {{"girth_m", measured.girth}, {"height_m", measured.height}};
    json["girths_cm"][girth] = std::round(measured.girth * 1e4) / 1e2;
  }
  return json.dump(2, ' ', /*ensure_ascii=*/false, Json::error_handler_t::replace) + "\n";
}

Result<ScanRecord> ScanRecordFromJson(std::string_view text) {
  try {
    return RecordFromJson(Json::parse(text));
  } catch (const std::exception& error) {
    return InvalidArgument("SCAN_JSON", std::string("not the JSON of a scan: ") + error.what());
  }
}

}  // namespace fitroom

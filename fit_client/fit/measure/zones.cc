#include "fit_client/fit/measure/zones.h"

#include <array>

namespace fitroom {
namespace {

constexpr std::array<std::string_view, kFitZoneCount> kNames = {"bust",      "waist", "hip",  "shoulder",
                                                                "upper_arm", "thigh", "knee", "hem"};

}  // namespace

std::string_view FitZoneName(FitZone zone) { return kNames[static_cast<size_t>(zone)]; }

std::string_view FitZoneWords(FitZone zone) { return zone == FitZone::kUpperArm ? "upper arm" : FitZoneName(zone); }

std::optional<FitZone> FitZoneFromName(std::string_view name) {
  for (size_t i = 0; i < kNames.size(); ++i) {
    if (kNames[i] == name) return static_cast<FitZone>(i);
  }
  return std::nullopt;
}

const std::vector<FitZone>& ZonesOf(GarmentKind kind) {
  using enum FitZone;
  static const std::vector<FitZone> kTop = {kShoulder, kBust, kUpperArm, kWaist, kHip, kHem};
  static const std::vector<FitZone> kDress = {kShoulder, kBust, kWaist, kHip, kHem};
  static const std::vector<FitZone> kSkirt = {kWaist, kHip, kHem};
  static const std::vector<FitZone> kPants = {kWaist, kHip, kThigh, kKnee, kHem};
  static const std::vector<FitZone> kShorts = {kWaist, kHip, kThigh, kHem};
  switch (kind) {
    case GarmentKind::kTShirt:
    case GarmentKind::kLongSleeve:
    case GarmentKind::kSleevedOnePiece:
      return kTop;
    case GarmentKind::kOnePiece:
      return kDress;
    case GarmentKind::kSkirt:
      return kSkirt;
    case GarmentKind::kPants:
      return kPants;
    case GarmentKind::kShorts:
      return kShorts;
  }
  return kTop;
}

FitZone PrimaryZone(GarmentKind kind) { return IsBottom(kind) ? FitZone::kHip : FitZone::kBust; }

}  // namespace fitroom

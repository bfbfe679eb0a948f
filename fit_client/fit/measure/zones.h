#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "common/garment/garment.h"

namespace fitroom {

// The places of a body at which a garment fits or does not.
enum class FitZone { kBust, kWaist, kHip, kShoulder, kUpperArm, kThigh, kKnee, kHem };
inline constexpr int kFitZoneCount = 8;

// "bust", "waist", "hip", "shoulder", "upper_arm", "thigh", "knee", "hem".
std::string_view FitZoneName(FitZone zone);
// As a shopper says it: "upper arm".
std::string_view FitZoneWords(FitZone zone);
std::optional<FitZone> FitZoneFromName(std::string_view name);

// Returns the zones that a garment of this kind has, from the top down.
const std::vector<FitZone>& ZonesOf(GarmentKind kind);

// Returns the zone that names the size (ISO 8559-2: primary dimension): bust of tops and one-pieces, hip of bottoms,
// which here are women's.
FitZone PrimaryZone(GarmentKind kind);

}  // namespace fitroom

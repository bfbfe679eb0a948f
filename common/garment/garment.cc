#include "common/garment/garment.h"

#include <algorithm>
#include <array>

namespace fitroom {
namespace {

constexpr std::array<std::string_view, kGarmentKindCount> kKindNames = {
    "tshirt", "long_sleeve", "one_piece", "skirt", "pants", "shorts", "one_piece_sleeved"};
constexpr std::array<std::string_view, 4> kProvenanceNames = {"measured", "stated", "ruled", "unknown"};

const std::vector<std::string> kTopMeasures = {"shoulder_width", "chest_width",   "waist_width",    "hip_width",
                                               "hem_width",      "sleeve_length", "sleeve_opening", "neck_width",
                                               "front_length",   "back_length"};
const std::vector<std::string> kDressMeasures = {"shoulder_width", "chest_width", "waist_width",  "hip_width",
                                                 "hem_width",      "neck_width",  "front_length", "back_length"};
const std::vector<std::string> kSkirtMeasures = {"waist_width", "hip_width", "hem_width", "length"};
const std::vector<std::string> kTrouserMeasures = {"waist_width", "hip_width", "thigh_width", "knee_width", "hem_width",
                                                   "front_rise",  "back_rise", "inseam",      "length"};

}  // namespace

std::string_view GarmentKindName(GarmentKind kind) { return kKindNames[static_cast<size_t>(kind)]; }

std::optional<GarmentKind> GarmentKindFromName(std::string_view name) {
  for (size_t i = 0; i < kKindNames.size(); ++i) {
    if (kKindNames[i] == name) return static_cast<GarmentKind>(i);
  }
  return std::nullopt;
}

std::string_view GarmentSideName(GarmentSide side) {
  constexpr std::array<std::string_view, kGarmentSideCount> kNames = {"front", "back", "side_folded"};
  return kNames[static_cast<size_t>(side)];
}

std::string_view ProvenanceName(Provenance provenance) { return kProvenanceNames[static_cast<size_t>(provenance)]; }

std::optional<Provenance> ProvenanceFromName(std::string_view name) {
  for (size_t i = 0; i < kProvenanceNames.size(); ++i) {
    if (kProvenanceNames[i] == name) return static_cast<Provenance>(i);
  }
  return std::nullopt;
}

const std::vector<std::string>& MeasureNames(GarmentKind kind) {
  switch (kind) {
    case GarmentKind::kOnePiece:
      return kDressMeasures;
    case GarmentKind::kSkirt:
      return kSkirtMeasures;
    case GarmentKind::kPants:
    case GarmentKind::kShorts:
      return kTrouserMeasures;
    default:
      return kTopMeasures;
  }
}

const GarmentSize* FindSize(const SizeChart& chart, std::string_view name) {
  for (const GarmentSize& size : chart.sizes) {
    if (size.name == name) return &size;
  }
  return nullptr;
}

const GarmentMeasure* FindMeasure(const std::vector<GarmentMeasure>& measures, std::string_view name) {
  for (const GarmentMeasure& measure : measures) {
    if (measure.name == name) return &measure;
  }
  return nullptr;
}

const OutlinePoint* FindPoint(const GarmentView& view, std::string_view name) {
  for (const OutlinePoint& point : view.points) {
    if (point.name == name) return &point;
  }
  return nullptr;
}

}  // namespace fitroom

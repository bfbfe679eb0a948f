#include "common/body/body.h"

namespace fitroom {
namespace {

constexpr std::array<std::string_view, kBodyLandmarkCount> kLandmarkNames = {
    "crown",           "front_neck",      "back_neck_c7",     "side_neck_L", "side_neck_R", "acromion_L",
    "acromion_R",      "armpit_L",        "armpit_R",         "elbow_L",     "elbow_R",     "wrist_L",
    "wrist_R",         "bust_point_L",    "bust_point_R",     "navel",       "waist_front", "waist_back",
    "hip_side_L",      "hip_side_R",      "buttock_mid_back", "crotch",      "knee_L",      "knee_R",
    "ankle_lateral_L", "ankle_lateral_R",
};

}  // namespace

std::string_view LandmarkName(BodyLandmark landmark) { return kLandmarkNames[static_cast<size_t>(landmark)]; }

std::optional<BodyLandmark> LandmarkFromName(std::string_view name) {
  for (size_t i = 0; i < kLandmarkNames.size(); ++i) {
    if (kLandmarkNames[i] == name) return static_cast<BodyLandmark>(i);
  }
  return std::nullopt;
}

}  // namespace fitroom

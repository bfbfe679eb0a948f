#include "common/garment/garment.h"

#include <array>

namespace fitroom {
namespace {

constexpr std::array<std::string_view, 6> kKindNames = {"tshirt", "long_sleeve", "one_piece",
                                                        "skirt",  "pants",       "shorts"};

// Clockwise on a front photograph, from the neck end at the wearer's right (the image's left) over the wearer's left
// shoulder … the order is by name, not by place:
//
//        P1 _neck_drop_ P2            P1 neck end on the wearer's right, P2 on the left
//     e5 /             \ e1           e1/e5 shoulder at the neck
//   e6 /                 \ e2         e2/e6 mid-shoulder
// e7 /                     \ e3       e3/e7 shoulder tip
//   /  ua_R           ua_L  \         e4/e8 sleeve end, top
//  e8_/ |               | \_e4
//       waist_R   waist_L
//       hip_R       hip_L
//       hem_R _hem_ hem_L
const std::vector<std::string> kTopNames = {"P1",
                                            "P2",
                                            "e1",
                                            "e2",
                                            "e3",
                                            "e4",
                                            "e5",
                                            "e6",
                                            "e7",
                                            "e8",
                                            "sleeve_bottom_L",
                                            "sleeve_bottom_R",
                                            "underarm_L",
                                            "underarm_R",
                                            "waist_L",
                                            "waist_R",
                                            "hip_L",
                                            "hip_R",
                                            "hem_L",
                                            "hem_R",
                                            "hem_centre",
                                            "neck_drop"};

const std::vector<std::string> kNone = {};

}  // namespace

std::string_view GarmentKindName(GarmentKind kind) { return kKindNames[static_cast<size_t>(kind)]; }

std::optional<GarmentKind> GarmentKindFromName(std::string_view name) {
  for (size_t i = 0; i < kKindNames.size(); ++i) {
    if (kKindNames[i] == name) return static_cast<GarmentKind>(i);
  }
  return std::nullopt;
}

const std::vector<std::string>& OutlinePointNames(GarmentKind kind) {
  switch (kind) {
    case GarmentKind::kTShirt:
    case GarmentKind::kLongSleeve:
      return kTopNames;
    default:
      return kNone;
  }
}

const OutlinePoint* FindPoint(const GarmentView& view, std::string_view name) {
  for (const OutlinePoint& point : view.points) {
    if (point.name == name) return &point;
  }
  return nullptr;
}

}  // namespace fitroom

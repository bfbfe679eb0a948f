#include "common/garment/garment.h"

#include <algorithm>
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

// The way round a front photograph, clockwise on the screen from the neck end on the image's left.
const std::vector<std::string> kTopOrder = {
    "P1",         "neck_drop",       "P2",    "e1",    "e2",         "e3",    "e4",    "sleeve_bottom_L",
    "underarm_L", "waist_L",         "hip_L", "hem_L", "hem_centre", "hem_R", "hip_R", "waist_R",
    "underarm_R", "sleeve_bottom_R", "e8",    "e7",    "e6",         "e5"};

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

std::vector<std::string> OutlineOrder(GarmentKind kind, GarmentSide side) {
  if (OutlinePointNames(kind).empty()) return {};
  std::vector<std::string> order = kTopOrder;
  if (side == GarmentSide::kBack) std::reverse(order.begin(), order.end());
  return order;
}

std::string TwinPointName(std::string_view name) {
  std::string twin(name);
  if (name == "P1") return "P2";
  if (name == "P2") return "P1";
  if (name.size() == 2 && name[0] == 'e') {
    twin[1] = static_cast<char>(name[1] <= '4' ? name[1] + 4 : name[1] - 4);
  } else if (name.ends_with("_L")) {
    twin.back() = 'R';
  } else if (name.ends_with("_R")) {
    twin.back() = 'L';
  }
  return twin;
}

const OutlinePoint* FindPoint(const GarmentView& view, std::string_view name) {
  for (const OutlinePoint& point : view.points) {
    if (point.name == name) return &point;
  }
  return nullptr;
}

}  // namespace fitroom

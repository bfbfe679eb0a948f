#include <algorithm>

#include "common/garment/garment.h"

namespace fitroom {
namespace {

using Names = std::vector<std::string>;

// Every kind has 22 points. `names` is the order of lists, `way` the way round a front photograph, clockwise on the
// screen, where the wearer's left is on the right.
struct KindPoints {
  Names names;
  Names way;
};

//        P1 _neck_drop_ P2            P1 neck end on the wearer's right, P2 on the left
//     e5 /             \ e1           e1/e5 shoulder at the neck
//   e6 /                 \ e2         e2/e6 mid-shoulder
// e7 /                     \ e3       e3/e7 shoulder tip
//   /  ua_R           ua_L  \         e4/e8 sleeve end, top
//  e8_/ |               | \_e4
//       waist_R   waist_L
//       hip_R       hip_L
//       hem_R _hem_ hem_L
const KindPoints kTop = {
    {"P1",
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
     "neck_drop"},
    {"P1",         "neck_drop",       "P2",    "e1",    "e2",         "e3",    "e4",    "sleeve_bottom_L",
     "underarm_L", "waist_L",         "hip_L", "hem_L", "hem_centre", "hem_R", "hip_R", "waist_R",
     "underarm_R", "sleeve_bottom_R", "e8",    "e7",    "e6",         "e5"}};

// e1/e5 shoulder at the neck, e2/e6 shoulder tip; skirt_L/R half way from hip to hem.
const KindPoints kDress = {{"P1",
                            "P2",
                            "e1",
                            "e2",
                            "e5",
                            "e6",
                            "armhole_L",
                            "armhole_R",
                            "underarm_L",
                            "underarm_R",
                            "waist_L",
                            "waist_R",
                            "hip_L",
                            "hip_R",
                            "skirt_L",
                            "skirt_R",
                            "hem_L",
                            "hem_R",
                            "hem_quarter_L",
                            "hem_quarter_R",
                            "hem_centre",
                            "neck_drop"},
                           {"P1",         "neck_drop",     "P2",    "e1",      "e2",    "armhole_L",
                            "underarm_L", "waist_L",       "hip_L", "skirt_L", "hem_L", "hem_quarter_L",
                            "hem_centre", "hem_quarter_R", "hem_R", "skirt_R", "hip_R", "waist_R",
                            "underarm_R", "armhole_R",     "e6",    "e5"}};

const KindPoints kSleevedDress = {{"P1",
                                   "P2",
                                   "e1",
                                   "e2",
                                   "e5",
                                   "e6",
                                   "sleeve_top_L",
                                   "sleeve_top_R",
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
                                   "hem_quarter_L",
                                   "hem_quarter_R",
                                   "hem_centre",
                                   "neck_drop"},
                                  {"P1",
                                   "neck_drop",
                                   "P2",
                                   "e1",
                                   "e2",
                                   "sleeve_top_L",
                                   "sleeve_bottom_L",
                                   "underarm_L",
                                   "waist_L",
                                   "hip_L",
                                   "hem_L",
                                   "hem_quarter_L",
                                   "hem_centre",
                                   "hem_quarter_R",
                                   "hem_R",
                                   "hip_R",
                                   "waist_R",
                                   "underarm_R",
                                   "sleeve_bottom_R",
                                   "sleeve_top_R",
                                   "e6",
                                   "e5"}};

//      e3 _waist_centre_ e1           e1/e3 waist corners, left and right
//  hip_R |               | hip_L
//        |    crotch     |            crotch_level_L/R on the outseam at the crotch's height
//        |      /\       |            thigh_* a quarter, knee_* half way from crotch to hem
//        |_e4_|  |_e2____|            e2/e4 outer, hem_inner_L/R inner corners of the leg's hem
const KindPoints kTrousers = {
    {"e1",
     "e3",
     "waist_centre",
     "hip_L",
     "hip_R",
     "crotch_level_L",
     "crotch_level_R",
     "crotch",
     "thigh_outer_L",
     "thigh_outer_R",
     "thigh_inner_L",
     "thigh_inner_R",
     "knee_outer_L",
     "knee_outer_R",
     "knee_inner_L",
     "knee_inner_R",
     "e2",
     "e4",
     "hem_inner_L",
     "hem_inner_R",
     "hem_mid_L",
     "hem_mid_R"},
    {"e3",           "waist_centre", "e1",          "hip_L",        "crotch_level_L", "thigh_outer_L", "knee_outer_L",
     "e2",           "hem_mid_L",    "hem_inner_L", "knee_inner_L", "thigh_inner_L",  "crotch",        "thigh_inner_R",
     "knee_inner_R", "hem_inner_R",  "hem_mid_R",   "e4",           "knee_outer_R",   "thigh_outer_R", "crotch_level_R",
     "hip_R"}};

// e1/e3 waist corners, e2/e4 hem corners; side_1 … side_5 evenly from hip to hem.
const KindPoints kSkirtPoints = {
    {"e1",       "e3",       "waist_centre", "waist_quarter_L", "waist_quarter_R", "hip_L",     "hip_R",    "side_1_L",
     "side_1_R", "side_2_L", "side_2_R",     "side_3_L",        "side_3_R",        "side_4_L",  "side_4_R", "side_5_L",
     "side_5_R", "e2",       "e4",           "hem_quarter_L",   "hem_quarter_R",   "hem_centre"},
    {"e3",
     "waist_quarter_R",
     "waist_centre",
     "waist_quarter_L",
     "e1",
     "hip_L",
     "side_1_L",
     "side_2_L",
     "side_3_L",
     "side_4_L",
     "side_5_L",
     "e2",
     "hem_quarter_L",
     "hem_centre",
     "hem_quarter_R",
     "e4",
     "side_5_R",
     "side_4_R",
     "side_3_R",
     "side_2_R",
     "side_1_R",
     "hip_R"}};

// One leg laid over the other, the crotch standing out on the image's left, the outseam on its right; the way round,
// clockwise. "crotch" is the tip of the fork, "waist_centre" the upper end of its curve.
const Names kSideFolded = {"waist_centre", "waist_side", "knee_outer", "hem_outer",
                           "hem_inner",    "knee_inner", "crotch"};

const KindPoints& PointsOf(GarmentKind kind) {
  switch (kind) {
    case GarmentKind::kTShirt:
    case GarmentKind::kLongSleeve:
      return kTop;
    case GarmentKind::kOnePiece:
      return kDress;
    case GarmentKind::kSleevedOnePiece:
      return kSleevedDress;
    case GarmentKind::kPants:
    case GarmentKind::kShorts:
      return kTrousers;
    case GarmentKind::kSkirt:
      return kSkirtPoints;
  }
  return kTop;
}

}  // namespace

const std::vector<std::string>& OutlinePointNames(GarmentKind kind) { return PointsOf(kind).names; }

std::vector<std::string> OutlineOrder(GarmentKind kind, GarmentSide side) {
  if (side == GarmentSide::kSideFolded) return kSideFolded;
  Names order = PointsOf(kind).way;
  if (side == GarmentSide::kBack) std::reverse(order.begin(), order.end());
  return order;
}

const std::vector<std::string>& SideFoldedPointNames() { return kSideFolded; }

std::string TwinPointName(GarmentKind kind, std::string_view name) {
  std::string twin(name);
  if (name == "P1") return "P2";
  if (name == "P2") return "P1";
  if (name.size() == 2 && name[0] == 'e') {
    const char span = IsBottom(kind) ? 2 : 4;
    twin[1] = static_cast<char>(IsLeftPoint(kind, name) ? name[1] + span : name[1] - span);
  } else if (name.ends_with("_L")) {
    twin.back() = 'R';
  } else if (name.ends_with("_R")) {
    twin.back() = 'L';
  }
  return twin;
}

bool IsLeftPoint(GarmentKind kind, std::string_view name) {
  if (name.size() == 2 && name[0] == 'e') return name[1] <= (IsBottom(kind) ? '2' : '4');
  return name == "P2" || name.ends_with("_L");
}

}  // namespace fitroom

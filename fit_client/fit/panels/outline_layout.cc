#include "fit_client/fit/panels/outline_layout.h"

#include "common/base/check.h"

namespace fitroom::panels {
namespace {

using Sections = std::vector<SectionLayout>;
constexpr SectionKind kSeam = SectionKind::kSeam;
constexpr SectionKind kOpening = SectionKind::kOpening;

// All drawings are seen from the front, the wearer's left on the rightXX
//
//            P1 ___neck___ P2
//   shoulder_R /          \ shoulder_L        The degrees are the lowest that follow real T-shirts to about 3 mm:
//           e8             e4                 the shoulder bends at its tip, the sleeve end is nearly straightXX
// sleeve_end_R \ |      | / sleeve_end_L
//  underside_R  ua      ua  underside_L
//       side_R  |        |  side_L
//              hem_R __ hem_L
const Sections kTop = {
    {"neck", kOpening, {"P2", "neck_drop", "P1"}, 0, 8, -1, true},
    {"shoulder_R", kSeam, {"P1", "e5", "e6", "e7", "e8"}, 9, 8, 3, false},
    {"sleeve_end_R", kOpening, {"e8", "sleeve_bottom_R"}, 8, 2, -1, false},
    {"underside_R", kSeam, {"sleeve_bottom_R", "underarm_R"}, 7, 3, -1, false},
    {"side_R", kSeam, {"underarm_R", "waist_R", "hip_R", "hem_R"}, 6, 5, -1, false},
    {"hem", kOpening, {"hem_R", "hem_centre", "hem_L"}, 5, 4, -1, true},
    {"side_L", kSeam, {"hem_L", "hip_L", "waist_L", "underarm_L"}, 4, 5, -1, false},
    {"underside_L", kSeam, {"underarm_L", "sleeve_bottom_L"}, 3, 3, -1, false},
    {"sleeve_end_L", kOpening, {"sleeve_bottom_L", "e4"}, 2, 2, -1, false},
    {"shoulder_L", kSeam, {"e4", "e3", "e2", "e1", "P2"}, 1, 8, 1, false},
};

// The same with a skirt below the hipXX
const Sections kSleevedDress = {
    {"neck", kOpening, {"P2", "neck_drop", "P1"}, 0, 8, -1, true},
    {"shoulder_R", kSeam, {"P1", "e5", "e6", "sleeve_top_R"}, 9, 8, 2, false},
    {"sleeve_end_R", kOpening, {"sleeve_top_R", "sleeve_bottom_R"}, 8, 2, -1, false},
    {"underside_R", kSeam, {"sleeve_bottom_R", "underarm_R"}, 7, 3, -1, false},
    {"side_R", kSeam, {"underarm_R", "waist_R", "hip_R", "hem_R"}, 6, 9, 1, false},
    {"hem", kOpening, {"hem_R", "hem_quarter_R", "hem_centre", "hem_quarter_L", "hem_L"}, 5, 6, -1, true},
    {"side_L", kSeam, {"hem_L", "hip_L", "waist_L", "underarm_L"}, 4, 9, 2, false},
    {"underside_L", kSeam, {"underarm_L", "sleeve_bottom_L"}, 3, 3, -1, false},
    {"sleeve_end_L", kOpening, {"sleeve_bottom_L", "sleeve_top_L"}, 2, 2, -1, false},
    {"shoulder_L", kSeam, {"sleeve_top_L", "e2", "e1", "P2"}, 1, 8, 1, false},
};

//        P1 _neck_ P2
//   shoulder_R|    |shoulder_L       Front armholes are cut deeper than back ones: each panel keeps its ownXX
//     e6 -  e5      e1 - e2
//  armhole_R )        ( armhole_L
//     side_R  |      |  side_L
//            /__hem____\  (hem)
const Sections kDress = {
    {"neck", kOpening, {"P2", "neck_drop", "P1"}, 0, 8, -1, true},
    {"shoulder_R", kSeam, {"P1", "e5", "e6"}, 7, 3, -1, false},
    {"armhole_R", kOpening, {"e6", "armhole_R", "underarm_R"}, 6, 5, -1, true},
    {"side_R", kSeam, {"underarm_R", "waist_R", "hip_R", "skirt_R", "hem_R"}, 5, 9, 1, false},
    {"hem", kOpening, {"hem_R", "hem_quarter_R", "hem_centre", "hem_quarter_L", "hem_L"}, 4, 6, -1, true},
    {"side_L", kSeam, {"hem_L", "skirt_L", "hip_L", "waist_L", "underarm_L"}, 3, 9, 3, false},
    {"armhole_L", kOpening, {"underarm_L", "armhole_L", "e2"}, 2, 5, -1, true},
    {"shoulder_L", kSeam, {"e2", "e1", "P2"}, 1, 3, -1, false},
};

//      e3 _waist_ e1
//  side_R |      | side_L
//      e4 /_hem__\ e2
const Sections kSkirt = {
    {"waist", kOpening, {"e1", "waist_quarter_L", "waist_centre", "waist_quarter_R", "e3"}, 0, 4, -1, true},
    {"side_R",
     kSeam,
     {"e3", "hip_R", "side_1_R", "side_2_R", "side_3_R", "side_4_R", "side_5_R", "e4"},
     3,
     7,
     -1,
     false},
    {"hem", kOpening, {"e4", "hem_quarter_R", "hem_centre", "hem_quarter_L", "e2"}, 2, 6, -1, true},
    {"side_L",
     kSeam,
     {"e2", "side_5_L", "side_4_L", "side_3_L", "side_2_L", "side_1_L", "hip_L", "e1"},
     1,
     7,
     -1,
     false},
};

//         e3 ___waist___ e1
// outseam_R |           | outseam_L     The outseam is widest at the hip: the curve is held there, or it cuts the
//           |           |               hip's girth by a centimetre.
//           |  crotch   |
//           |    /\     |
//           |   |  |    | inseam_R, inseam_L
//        e4 |___|  |____| e2
//       leg_hem_R  leg_hem_L
const Sections kTrousers = {
    {"waist", kOpening, {"e1", "waist_centre", "e3"}, 0, 4, -1, true},
    {"outseam_R", kSeam, {"e3", "hip_R", "crotch_level_R", "thigh_outer_R", "knee_outer_R", "e4"}, 6, 8, 1, false},
    {"leg_hem_R", kOpening, {"e4", "hem_mid_R", "hem_inner_R"}, 5, 3, -1, false},
    {"inseam_R", kSeam, {"hem_inner_R", "knee_inner_R", "thigh_inner_R", "crotch"}, 4, 6, -1, false},
    {"inseam_L", kSeam, {"crotch", "thigh_inner_L", "knee_inner_L", "hem_inner_L"}, 3, 6, -1, false},
    {"leg_hem_L", kOpening, {"hem_inner_L", "hem_mid_L", "e2"}, 2, 3, -1, false},
    {"outseam_L", kSeam, {"e2", "knee_outer_L", "thigh_outer_L", "crotch_level_L", "hip_L", "e1"}, 1, 8, 4, false},
};

}  // namespace

const std::vector<SectionLayout>& OutlineLayout(GarmentKind kind) {
  switch (kind) {
    case GarmentKind::kTShirt:
    case GarmentKind::kLongSleeve:
      return kTop;
    case GarmentKind::kOnePiece:
      return kDress;
    case GarmentKind::kSleevedOnePiece:
      return kSleevedDress;
    case GarmentKind::kSkirt:
      return kSkirt;
    case GarmentKind::kPants:
    case GarmentKind::kShorts:
      return kTrousers;
  }
  return kTop;
}

std::string ShoulderTipName(GarmentKind kind, bool left) {
  FR_CHECK(!IsBottom(kind));
  const bool top = kind == GarmentKind::kTShirt || kind == GarmentKind::kLongSleeve;
  if (left) return top ? "e3" : "e2";
  return top ? "e7" : "e6";
}

}  // namespace fitroom::panels

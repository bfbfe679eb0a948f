#include "fit_client/fit/panels/outline_layout.h"

namespace fitroom::panels {
namespace {

// Seen from the front, the wearer's left on the right:
//
//            P1 ___neck___ P2
//   shoulder_R /          \ shoulder_L        The degrees are the lowest that follow real T-shirts to about 3 mm:
//           e8             e4                 the shoulder bends at its tip, the sleeve end is nearly straight.
// sleeve_end_R \ |      | / sleeve_end_L
//  underside_R  ua      ua  underside_L
//       side_R  |        |  side_L
//              hem_R __ hem_L
const std::vector<SectionLayout> kTop = {
    {"neck", SectionKind::kOpening, {"P2", "neck_drop", "P1"}, 0, 8, -1, true},
    {"shoulder_R", SectionKind::kSeam, {"P1", "e5", "e6", "e7", "e8"}, 9, 8, 3, false},
    {"sleeve_end_R", SectionKind::kOpening, {"e8", "sleeve_bottom_R"}, 8, 2, -1, false},
    {"underside_R", SectionKind::kSeam, {"sleeve_bottom_R", "underarm_R"}, 7, 3, -1, false},
    {"side_R", SectionKind::kSeam, {"underarm_R", "waist_R", "hip_R", "hem_R"}, 6, 5, -1, false},
    {"hem", SectionKind::kOpening, {"hem_R", "hem_centre", "hem_L"}, 5, 4, -1, true},
    {"side_L", SectionKind::kSeam, {"hem_L", "hip_L", "waist_L", "underarm_L"}, 4, 5, -1, false},
    {"underside_L", SectionKind::kSeam, {"underarm_L", "sleeve_bottom_L"}, 3, 3, -1, false},
    {"sleeve_end_L", SectionKind::kOpening, {"sleeve_bottom_L", "e4"}, 2, 2, -1, false},
    {"shoulder_L", SectionKind::kSeam, {"e4", "e3", "e2", "e1", "P2"}, 1, 8, 1, false},
};

const std::vector<SectionLayout> kNone = {};

}  // namespace

const std::vector<SectionLayout>& OutlineLayout(GarmentKind kind) {
  return kind == GarmentKind::kTShirt || kind == GarmentKind::kLongSleeve ? kTop : kNone;
}

}  // namespace fitroom::panels

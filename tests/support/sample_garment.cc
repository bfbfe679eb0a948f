#include "tests/support/sample_garment.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace fitroom::testing {
namespace {

struct Place {
  const char* name;  // Of a point on the image's right half as seen on the front, or empty for a plain corner.
  double x;          // From the middle (unit: pixel).
  double y;          // From the top (unit: pixel).
};

// The right half of the outline, from the neck to the hem.
constexpr Place kHalf[] = {
    {"", 40, 90},
    {"P2", 80, 60},
    {"e1", 95, 63},
    {"e2", 150, 78},
    {"e3", 210, 95},
    {"e4", 360, 190},
    {"sleeve_bottom_L", 320, 290},
    {"underarm_L", 240, 240},
    {"waist_L", 235, 430},
    {"hip_L", 235, 600},
    {"hem_L", 240, 740},
};

GarmentView MakeEmptyView(GarmentSide side, int height) {
  GarmentView view;
  view.side = side;
  const std::string base(GarmentSideName(side));
  view.photo_file = base + ".png";
  view.mask_file = base + "_mask.png";
  view.texture_file = base + "_texture.png";
  view.image_width = 800;
  view.image_height = height;
  view.metre_per_pixel = 0.001;
  return view;
}

GarmentView MakeView(GarmentSide side, double neck_drop_y) {
  GarmentView view = MakeEmptyView(side, 800);
  const double outward = side == GarmentSide::kFront ? 1.0 : -1.0;  // The wearer's left on the image.
  std::map<std::string, Eigen::Vector2d> places;
  view.outline.push_back({400, neck_drop_y});
  places["neck_drop"] = view.outline.back();
  for (const Place& place : kHalf) {
    if (place.name[0] == '\0' && side == GarmentSide::kBack) continue;
    view.outline.push_back({400 + place.x, place.y});
    if (place.name[0] == '\0') continue;
    places[place.name] = {400 + outward * place.x, place.y};
    places[TwinPointName(GarmentKind::kTShirt, place.name)] = {400 - outward * place.x, place.y};
  }
  view.outline.push_back({400, 740});
  places["hem_centre"] = view.outline.back();
  for (size_t i = std::size(kHalf); i > 0; --i) {
    const Place& place = kHalf[i - 1];
    if (place.name[0] == '\0' && side == GarmentSide::kBack) continue;
    view.outline.push_back({400 - place.x, place.y});
  }
  for (const std::string& name : OutlinePointNames(GarmentKind::kTShirt)) {
    view.points.push_back({name, places.at(name), 1.0});
  }
  return view;
}

// The right half of a pair of trousers, from the waist down the outside and up the inside to the crotch.
constexpr Place kTrouserHalf[] = {
    {"e1", 190, 60},
    {"hip_L", 240, 240},
    {"crotch_level_L", 250, 330},
    {"thigh_outer_L", 240, 500},
    {"knee_outer_L", 200, 690},
    {"e2", 170, 1060},
    {"hem_mid_L", 110, 1060},
    {"hem_inner_L", 50, 1060},
    {"knee_inner_L", 40, 690},
    {"thigh_inner_L", 20, 500},
};
// One leg over the other, clockwise.
constexpr Place kFoldedTrousers[] = {
    {"waist_centre", 300, 60}, {"waist_side", 560, 60},  {"knee_outer", 560, 690}, {"hem_outer", 540, 1060},
    {"hem_inner", 360, 1060},  {"knee_inner", 330, 690}, {"crotch", 180, 330},     {"", 240, 200},
};

GarmentView MakeTrouserView(GarmentSide side) {
  GarmentView view = MakeEmptyView(side, 1200);
  const double outward = side == GarmentSide::kFront ? 1.0 : -1.0;
  std::map<std::string, Eigen::Vector2d> places = {{"waist_centre", {400, 60}}, {"crotch", {400, 330}}};
  view.outline.push_back({400, 60});
  for (const Place& place : kTrouserHalf) {
    view.outline.push_back({400 + place.x, place.y});
    places[place.name] = {400 + outward * place.x, place.y};
    places[TwinPointName(GarmentKind::kPants, place.name)] = {400 - outward * place.x, place.y};
  }
  view.outline.push_back({400, 330});
  for (size_t i = std::size(kTrouserHalf); i > 0; --i) {
    view.outline.push_back({400 - kTrouserHalf[i - 1].x, kTrouserHalf[i - 1].y});
  }
  for (const std::string& name : OutlinePointNames(GarmentKind::kPants)) {
    view.points.push_back({name, places.at(name), 1.0});
  }
  return view;
}

GarmentView MakeFoldedView() {
  GarmentView view = MakeEmptyView(GarmentSide::kSideFolded, 1200);
  for (const Place& place : kFoldedTrousers) {
    view.outline.push_back({place.x, place.y});
    if (place.name[0] != '\0') view.points.push_back({place.name, view.outline.back(), 1.0});
  }
  return view;
}

GarmentSize MakeTrouserSize(const std::string& name, double waist_width, double hip_width, double waist, double hip) {
  constexpr Provenance kStated = Provenance::kStated;
  return {name,
          {{"waist_width", waist_width, kStated}, {"hip_width", hip_width, kStated}},
          {{"waist", waist, kStated}, {"hip", hip, kStated}}};
}

}  // namespace

Garment MakeSampleTrousers() {
  Garment garment;
  garment.id = "sample-trousers";
  garment.title = "Sample trousers";
  garment.kind = GarmentKind::kPants;
  garment.length = 1.0;
  garment.front = MakeTrouserView(GarmentSide::kFront);
  garment.back = MakeTrouserView(GarmentSide::kBack);
  garment.side_folded = MakeFoldedView();
  garment.fabric = "denim";
  garment.measures = {{"waist_width", 0.38},
                      {"hip_width", 0.48},
                      {"front_rise", 0.245, Provenance::kStated},
                      {"back_rise", 0.352, Provenance::kRuled},
                      {"thigh_width", 0.0, Provenance::kUnknown}};
  garment.chart = {{MakeTrouserSize("S", 0.36, 0.465, 0.68, 0.91), MakeTrouserSize("M", 0.38, 0.49, 0.72, 0.96),
                    MakeTrouserSize("L", 0.40, 0.515, 0.76, 1.01)},
                   "M"};
  return garment;
}

Garment MakeSampleTShirt() {
  Garment garment;
  garment.id = "sample-tshirt";
  garment.title = "Sample T-shirt";
  garment.kind = GarmentKind::kTShirt;
  garment.length = 0.68;
  garment.front = MakeView(GarmentSide::kFront, 140);
  garment.back = MakeView(GarmentSide::kBack, 80);
  garment.measures = {{"chest_width", 0.48}};
  return garment;
}

}  // namespace fitroom::testing

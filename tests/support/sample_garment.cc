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

GarmentView MakeView(GarmentSide side, double neck_drop_y) {
  GarmentView view;
  view.side = side;
  const std::string base = side == GarmentSide::kFront ? "front" : "back";
  view.photo_file = base + ".png";
  view.mask_file = base + "_mask.png";
  view.texture_file = base + "_texture.png";
  view.image_width = 800;
  view.image_height = 800;
  view.metre_per_pixel = 0.001;
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

}  // namespace

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

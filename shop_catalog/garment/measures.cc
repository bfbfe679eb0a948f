#include "shop_catalog/garment/measures.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "common/base/check.h"
#include "common/garment/polygon.h"

namespace fitroom::shop_catalog {
namespace {

constexpr double kChestBelowUnderarm = 0.025;  // (unit: metre)

Eigen::Vector2d At(const GarmentView& view, const std::string& name) {
  const OutlinePoint* point = FindPoint(view, name);
  FR_CHECK(point != nullptr);
  return point->pixel;
}

double Distance(const GarmentView& view, const char* a, const char* b) {
  return (At(view, a) - At(view, b)).norm() * view.metre_per_pixel;
}

double Length(const GarmentView& view) {
  const Eigen::Vector2d neck = 0.5 * (At(view, "P1") + At(view, "P2"));
  const Eigen::Vector2d hem = 0.5 * (At(view, "hem_L") + At(view, "hem_R"));
  return (hem - neck).norm() * view.metre_per_pixel;
}

}  // namespace

double WidthAt(const GarmentView& view, const Eigen::Vector2d& place) {
  const Eigen::Vector2d neck = 0.5 * (At(view, "P1") + At(view, "P2"));
  const Eigen::Vector2d hem = 0.5 * (At(view, "hem_L") + At(view, "hem_R"));
  const Eigen::Vector2d down = (hem - neck).normalized();
  const Eigen::Vector2d right(down.y(), -down.x());
  // Crossings of the line with the outline; the piece that holds the garment's middle is the body, others are sleeves.
  const double level = (place - neck).dot(down);
  std::vector<double> crossings;
  for (size_t i = 0; i < view.outline.size(); ++i) {
    const Eigen::Vector2d a = view.outline[i] - neck;
    const Eigen::Vector2d b = view.outline[(i + 1) % view.outline.size()] - neck;
    const double level_a = a.dot(down) - level;
    const double level_b = b.dot(down) - level;
    if ((level_a < 0) == (level_b < 0)) continue;
    const double t = level_a / (level_a - level_b);
    crossings.push_back((a + t * (b - a)).dot(right));
  }
  std::sort(crossings.begin(), crossings.end());
  for (size_t i = 0; i + 1 < crossings.size(); i += 2) {
    if (crossings[i] <= 0 && crossings[i + 1] >= 0) return crossings[i + 1] - crossings[i];
  }
  return 0.0;
}

std::vector<GarmentMeasure> MeasureTop(const GarmentView& front, const GarmentView* back) {
  const auto width_at = [&](const Eigen::Vector2d& place) { return WidthAt(front, place) * front.metre_per_pixel; };
  const auto middle = [&](const char* a, const char* b) {
    return Eigen::Vector2d(0.5 * (At(front, a) + At(front, b)));
  };
  const Eigen::Vector2d underarm = middle("underarm_L", "underarm_R");
  const Eigen::Vector2d hem = middle("hem_L", "hem_R");
  const Eigen::Vector2d chest = underarm + kChestBelowUnderarm / front.metre_per_pixel * (hem - underarm).normalized();
  const double sleeve_length = 0.5 * (Distance(front, "e3", "e4") + Distance(front, "e7", "e8"));
  const double sleeve_opening =
      0.5 * (Distance(front, "e4", "sleeve_bottom_L") + Distance(front, "e8", "sleeve_bottom_R"));
  std::vector<GarmentMeasure> measures = {
      {"shoulder_width", Distance(front, "e3", "e7")},
      {"chest_width", width_at(chest)},
      {"waist_width", width_at(middle("waist_L", "waist_R"))},
      {"hip_width", width_at(middle("hip_L", "hip_R"))},
      {"hem_width", Distance(front, "hem_L", "hem_R")},
      {"sleeve_length", sleeve_length},
      {"sleeve_opening", sleeve_opening},
      {"neck_width", Distance(front, "P1", "P2")},
      {"front_length", Length(front)},
  };
  if (back != nullptr) measures.push_back({"back_length", Length(*back)});
  return measures;
}

}  // namespace fitroom::shop_catalog

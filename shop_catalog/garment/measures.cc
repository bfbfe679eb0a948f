#include "shop_catalog/garment/measures.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>

#include "common/base/check.h"
#include "common/garment/polygon.h"
#include "shop_catalog/garment/kind_frame.h"

namespace fitroom::shop_catalog {
namespace {

// One view with its scale.
class Ruler {
 public:
  Ruler(GarmentKind kind, const GarmentView& view) : kind_(kind), view_(view) {}

  Eigen::Vector2d At(std::string_view name) const {
    const OutlinePoint* point = FindPoint(view_, name);
    FR_CHECK(point != nullptr);
    return point->pixel;
  }
  Eigen::Vector2d Middle(std::string_view a, std::string_view b) const { return 0.5 * (At(a) + At(b)); }
  double Distance(std::string_view a, std::string_view b) const {
    return (At(a) - At(b)).norm() * view_.metre_per_pixel;
  }
  // Across the garment at the height of a pair of points.
  double Width(const std::string& base) const { return WidthAtPixel(Middle(base + "_L", base + "_R")); }
  double WidthAtPixel(const Eigen::Vector2d& place) const {
    return WidthAt(kind_, view_, place) * view_.metre_per_pixel;
  }
  double Chest() const {
    const Eigen::Vector2d underarm = Middle("underarm_L", "underarm_R"), hem = Middle("hem_L", "hem_R");
    return WidthAtPixel(underarm + kChestBelowUnderarm / view_.metre_per_pixel * (hem - underarm).normalized());
  }
  double Path(std::initializer_list<std::string_view> names) const {
    double length = 0.0;
    for (const std::string_view* name = names.begin(); name + 1 < names.end(); ++name) {
      length += Distance(name[0], name[1]);
    }
    return length;
  }
  // Square to a leg, which may lie aslant; `suffix` is "_L" or "_R".
  double KneeWidth(const std::string& suffix) const {
    const Eigen::Vector2d top = Middle("crotch", "crotch_level" + suffix);
    const Eigen::Vector2d along = (At("hem_mid" + suffix) - top).normalized();
    const Eigen::Vector2d level = At("knee_outer" + suffix) - At("knee_inner" + suffix);
    return std::abs(level.x() * along.y() - level.y() * along.x()) * view_.metre_per_pixel;
  }
  double Length() const {
    const GarmentFrame frame = FrameOf(kind_, view_.points);
    return (frame.lower - frame.upper).norm() * view_.metre_per_pixel;
  }

 private:
  GarmentKind kind_;
  const GarmentView& view_;
};

std::vector<GarmentMeasure> MeasureSleeves(GarmentKind kind, const Ruler& front) {
  const bool is_dress = IsDress(kind);
  const char* const tip_left = is_dress ? "e2" : "e3";
  const char* const tip_right = is_dress ? "e6" : "e7";
  const char* const top_left = is_dress ? "sleeve_top_L" : "e4";
  const char* const top_right = is_dress ? "sleeve_top_R" : "e8";
  return {{"sleeve_length", 0.5 * (front.Distance(tip_left, top_left) + front.Distance(tip_right, top_right))},
          {"sleeve_opening",
           0.5 * (front.Distance(top_left, "sleeve_bottom_L") + front.Distance(top_right, "sleeve_bottom_R"))}};
}

std::vector<GarmentMeasure> MeasureTorso(GarmentKind kind, const GarmentView& front_view, const GarmentView* back) {
  const Ruler front(kind, front_view);
  const bool is_dress = IsDress(kind);
  std::vector<GarmentMeasure> measures = {
      {"shoulder_width", is_dress ? front.Distance("e2", "e6") : front.Distance("e3", "e7")},
      {"chest_width", front.Chest()},
      {"waist_width", front.Width("waist")},
      {"hip_width", front.Width("hip")},
      {"hem_width", front.Distance("hem_L", "hem_R")}};
  if (HasSleeves(kind)) {
    for (GarmentMeasure& measure : MeasureSleeves(kind, front)) measures.push_back(std::move(measure));
  }
  measures.push_back({"neck_width", front.Distance("P1", "P2")});
  measures.push_back({"front_length", front.Length()});
  if (back != nullptr) measures.push_back({"back_length", Ruler(kind, *back).Length()});
  return measures;
}

std::vector<GarmentMeasure> MeasureSkirt(const GarmentView& view) {
  const Ruler front(GarmentKind::kSkirt, view);
  return {{"waist_width", front.Distance("e1", "e3")},
          {"hip_width", front.Width("hip")},
          {"hem_width", front.Distance("e2", "e4")},
          {"length", front.Length()}};
}

std::vector<GarmentMeasure> MeasureTrousers(GarmentKind kind, const GarmentView& view) {
  const Ruler front(kind, view);
  const double knee = 0.5 * (front.KneeWidth("_L") + front.KneeWidth("_R"));
  const double hem = 0.5 * (front.Distance("e2", "hem_inner_L") + front.Distance("e4", "hem_inner_R"));
  const double inseam = 0.5 * (front.Path({"crotch", "thigh_inner_L", "knee_inner_L", "hem_inner_L"}) +
                               front.Path({"crotch", "thigh_inner_R", "knee_inner_R", "hem_inner_R"}));
  return {{"waist_width", front.Distance("e1", "e3")},
          {"hip_width", front.Width("hip")},
          {"thigh_width", 0.0, Provenance::kUnknown},
          {"knee_width", knee},
          {"hem_width", hem},
          {"front_rise", 0.0, Provenance::kUnknown},
          {"back_rise", 0.0, Provenance::kUnknown},
          {"inseam", inseam},
          {"length", front.Length()}};
}

}  // namespace

double WidthAt(GarmentKind kind, const GarmentView& view, const Eigen::Vector2d& place) {
  const GarmentFrame frame = FrameOf(kind, view.points);
  // Crossings of the line with the outline; the piece that holds the garment's middle is the body, others are sleeves.
  const double level = (place - frame.upper).dot(frame.down);
  std::vector<double> crossings;
  for (size_t i = 0; i < view.outline.size(); ++i) {
    const Eigen::Vector2d a = view.outline[i] - frame.upper;
    const Eigen::Vector2d b = view.outline[(i + 1) % view.outline.size()] - frame.upper;
    const double level_a = a.dot(frame.down) - level;
    const double level_b = b.dot(frame.down) - level;
    if ((level_a < 0) == (level_b < 0)) continue;
    const double t = level_a / (level_a - level_b);
    crossings.push_back((a + t * (b - a)).dot(frame.right));
  }
  std::sort(crossings.begin(), crossings.end());
  for (size_t i = 0; i + 1 < crossings.size(); i += 2) {
    if (crossings[i] <= 0 && crossings[i + 1] >= 0) return crossings[i + 1] - crossings[i];
  }
  return 0.0;
}

std::vector<GarmentMeasure> MeasureGarment(GarmentKind kind, const GarmentView& front, const GarmentView* back) {
  if (kind == GarmentKind::kSkirt) return MeasureSkirt(front);
  if (HasLegs(kind)) return MeasureTrousers(kind, front);
  return MeasureTorso(kind, front, back);
}

}  // namespace fitroom::shop_catalog

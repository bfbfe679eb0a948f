#include "shop_catalog/garment/side_folded.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "common/base/check.h"
#include "common/garment/polygon.h"

namespace fitroom::shop_catalog {
namespace {

using Eigen::Vector2d;

const Vector2d& At(const std::vector<OutlinePoint>& points, std::string_view name) {
  for (const OutlinePoint& point : points) {
    if (point.name == name) return point.pixel;
  }
  FR_CHECK(false);
  return points.front().pixel;
}

CornerTemplate TrouserTemplate() {
  return {"side-folded trousers",
          {{{85, 30}, {0.10, 0.06}, {0.02, 0.03}},
           {{90, 30}, {0.09, 0.08}, {0.98, 0.04}},
           {{90, 30}, {-0.09, 0.08}, {0.98, 0.04}},
           {{90, 40}, {-0.17, 0.07}, {0.27, 0.08}},
           {{90, 35}, {-0.09, 0.06}, {0.02, 0.03}}},
          {{{91, 10}, {0.97, 0.06}, {1.03, 0.05}},
           {{180, 22}, {0.19, 0.06}, {1.03, 0.08}},
           {{-96, 10}, {0.72, 0.09}, {1.03, 0.05}},
           {{-72, 16}, {0.28, 0.08}, {1.12, 0.12}}},
          /*starts_at_top=*/true,
          {1.06, 0.10}};
}

CornerTemplate ShortsTemplate() {
  return {"side-folded shorts",
          {{{85, 30}, {0.26, 0.10}, {0.02, 0.05}},
           {{85, 30}, {0.36, 0.12}, {0.97, 0.06}},
           {{90, 35}, {-0.36, 0.12}, {0.96, 0.08}},
           {{80, 45}, {-0.43, 0.12}, {0.66, 0.14}},
           {{90, 35}, {-0.22, 0.10}, {0.02, 0.05}}},
          {{{88, 12}, {0.96, 0.08}, {1.03, 0.05}},
           {{180, 18}, {0.72, 0.14}, {1.03, 0.06}},
           {{-100, 25}, {0.34, 0.16}, {1.05, 0.10}},
           {{-72, 20}, {0.68, 0.14}, {1.12, 0.12}}},
          /*starts_at_top=*/true,
          {1.06, 0.10}};
}

// The outline from one place to another, clockwise, with both ends.
Polygon Section(const Polygon& outline, const Vector2d& from, const Vector2d& to) {
  const OutlinePlace start = NearestPlace(outline, from), end = NearestPlace(outline, to);
  Polygon section = {start.pixel};
  for (size_t i = (start.edge + 1) % outline.size(); i != (end.edge + 1) % outline.size();
       i = (i + 1) % outline.size()) {
    section.push_back(outline[i]);
  }
  section.push_back(end.pixel);
  return section;
}

double LengthOf(const Polygon& line) {
  double length = 0.0;
  for (size_t i = 1; i < line.size(); ++i) length += (line[i] - line[i - 1]).norm();
  return length;
}

void Set(std::vector<GarmentMeasure>& measures, std::string_view name, double value) {
  for (GarmentMeasure& measure : measures) {
    if (measure.name == name) measure = {measure.name, value, Provenance::kMeasured};
  }
}

}  // namespace

std::optional<CornerMatch> FindSideFoldedCorners(const Polygon& outline, GarmentKind kind) {
  static const CornerTemplate kTrousers = TrouserTemplate(), kShorts = ShortsTemplate();
  return MatchCorners(outline, kind == GarmentKind::kPants ? kTrousers : kShorts);
}

double SideFoldedLengthInPixels(const std::vector<OutlinePoint>& points) {
  const Vector2d upper = 0.5 * (At(points, "waist_centre") + At(points, "waist_side"));
  const Vector2d lower = 0.5 * (At(points, "hem_inner") + At(points, "hem_outer"));
  return (lower - upper).norm();
}

void MeasureSideFolded(const GarmentView& view, std::vector<GarmentMeasure>& measures) {
  const Vector2d &crotch = At(view.points, "crotch"), &centre = At(view.points, "waist_centre");
  const Vector2d down =
      (At(view.points, "hem_inner") + At(view.points, "hem_outer") - centre - At(view.points, "waist_side"))
          .normalized();
  const Vector2d across(down.y(), -down.x());
  // The thigh: across the leg at the crotch's height, to the outseam.
  const Polygon outseam = Section(view.outline, At(view.points, "waist_side"), At(view.points, "hem_outer"));
  const auto nearest = std::min_element(outseam.begin(), outseam.end(), [&](const Vector2d& a, const Vector2d& b) {
    return std::abs((a - crotch).dot(down)) < std::abs((b - crotch).dot(down));
  });
  const double thigh = (*nearest - crotch).dot(across) * view.metre_per_pixel;
  const double curve = LengthOf(Section(view.outline, crotch, centre)) * view.metre_per_pixel;
  Set(measures, "thigh_width", thigh);
  // A curve over a longer extension is longer by about the difference: front and back share it around their mean.
  const GarmentMeasure* hip = FindMeasure(measures, "hip_width");
  const double mean_extension = hip == nullptr ? 0.0 : std::max(0.0, thigh - 0.5 * hip->value);
  const double front_extension = hip == nullptr ? 0.0 : std::min(hip->value / 8.0, mean_extension);
  const double drop = std::max(1e-6, (crotch - centre).dot(down) * view.metre_per_pixel);
  // The lower part of the curve, 30 % of the drop, turns through the extension: a quarter of an ellipse.
  const auto arc = [](double a, double b) {  // Ramanujan's approximation of an ellipse's quarter.
    const double h = (a - b) * (a - b) / ((a + b) * (a + b));
    return std::numbers::pi / 4.0 * (a + b) * (1.0 + 3.0 * h / (10.0 + std::sqrt(4.0 - 3.0 * h)));
  };
  const double shorter = arc(0.3 * drop, mean_extension) - arc(0.3 * drop, front_extension);
  Set(measures, "front_rise", curve - shorter);
  Set(measures, "back_rise", curve + shorter);
}

}  // namespace fitroom::shop_catalog

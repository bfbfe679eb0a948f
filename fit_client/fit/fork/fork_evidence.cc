#include "fit_client/fit/fork/fork_evidence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "common/garment/polygon.h"
#include "fit_client/fit/panels/polyline.h"

namespace fitroom {
namespace {

constexpr std::array<std::string_view, kForkRuleCount> kRuleNames = {"close",   "trouser", "classic",
                                                                     "aldrich", "titan",   "garment_code"};
// The garment's hip is wider than the body's by this (unit: metre): the middle of the band for woven trousers.
constexpr double kHipEase = 0.06;
// A thigh's girth as a share of the hip's, where GarmentCode's rule wants the leg and nobody measured it.
constexpr double kLegShare = 0.60;
// Scale of a photograph against the pattern's length.
constexpr double kMostScaleError = 0.15;

// The outline from one point of the photograph to another, clockwise on the screen (unit: pixel).
panels::Polyline Part(const GarmentView& view, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const double perimeter = Perimeter(view.outline);
  const double start = NearestPlace(view.outline, from).arc_length;
  double length = NearestPlace(view.outline, to).arc_length - start;
  if (length < 0.0) length += perimeter;
  const int count = std::clamp(static_cast<int>(length / 3.0), 8, 2000);
  panels::Polyline part;
  for (int i = 0; i <= count; ++i) part.push_back(PlaceAt(view.outline, start + length * i / count).pixel);
  return part;
}

// The same without the jitter of the mask, which would make it longer: a Gaussian of 1 % of its length.
panels::Polyline SmoothPart(const GarmentView& view, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const panels::Polyline part = Part(view, from, to);
  return panels::SmoothSamples(part, std::max(2.0, 0.01 * static_cast<double>(part.size())));
}

// How far the outseam lies from the fork's tip, across the garment: square to the line between the outseam's ends. 0
// where the tip lies above or below it.
double AcrossFrom(const Eigen::Vector2d& tip, const panels::Polyline& outseam) {
  const Eigen::Vector2d down = (outseam.back() - outseam.front()).normalized();
  const double level = down.dot(tip - outseam.front());
  for (size_t i = 1; i < outseam.size(); ++i) {
    const double a = down.dot(outseam[i - 1] - outseam.front()), b = down.dot(outseam[i] - outseam.front());
    if (a > level || b < level || b <= a) continue;
    const Eigen::Vector2d beside = outseam[i - 1] + (level - a) / (b - a) * (outseam[i] - outseam[i - 1]);
    return (beside - tip).norm();
  }
  return 0.0;
}

}  // namespace

std::string_view ForkRuleName(ForkRule rule) { return kRuleNames[static_cast<size_t>(rule)]; }

std::optional<ForkRule> ForkRuleFromName(std::string_view name) {
  for (size_t i = 0; i < kRuleNames.size(); ++i) {
    if (kRuleNames[i] == name) return static_cast<ForkRule>(i);
  }
  return std::nullopt;
}

ForkEvidence EvidenceFrom(const Garment& garment, const GarmentSize* size) {
  ForkEvidence evidence;
  const auto stated = [&](std::string_view name) -> std::optional<double> {
    const GarmentMeasure* measure = size != nullptr ? FindMeasure(size->measures, name) : nullptr;
    if (measure == nullptr && (size == nullptr || size->name == garment.chart.photographed_size)) {
      measure = FindMeasure(garment.measures, name);
    }
    if (measure == nullptr || measure->provenance != Provenance::kStated) return std::nullopt;
    return measure->value;
  };
  evidence.front_rise = stated("front_rise");
  evidence.back_rise = stated("back_rise");
  evidence.thigh_width = stated("thigh_width");
  if (size == nullptr || size->name == garment.chart.photographed_size) evidence.side_folded = garment.side_folded;
  return evidence;
}

std::vector<std::string> UndecidedByFolding(GarmentKind kind, const ForkEvidence& evidence) {
  std::vector<std::string> undecided;
  if (!HasLegs(kind) || evidence.side_folded) return undecided;
  if (!evidence.thigh_width) undecided.emplace_back("thigh_width");
  if (!evidence.front_rise) undecided.emplace_back("front_rise");
  if (!evidence.back_rise) undecided.emplace_back("back_rise");
  return undecided;
}

namespace fork {

ForkExtensions ExtensionsByRule(ForkRule rule, double garment_hip_girth) {
  const double hip = garment_hip_girth - kHipEase;
  const double front = hip / 16.0;
  switch (rule) {
    case ForkRule::kClose:
      return {front, hip / 16.0};
    case ForkRule::kTrouser:
      return {front, hip / 10.0};
    case ForkRule::kClassic:
      return {front, hip / 8.0};
    case ForkRule::kAldrich:
      return {front + 0.005, 0.25 * (hip / 12.0 + 0.015) + 1.5 * (front + 0.005)};
    case ForkRule::kTitan:
      return {garment_hip_girth / 16.0, garment_hip_girth / 16.0};
    case ForkRule::kGarmentCode:
      return {front, kLegShare * hip - 0.5 * hip + 0.05 - front};
  }
  return {front, front};
}

Result<SideFold> MeasureSideFold(const GarmentView& view, double outseam_length) {
  for (const std::string& name : SideFoldedPointNames()) {
    if (FindPoint(view, name) != nullptr) continue;
    return InvalidArgument("POINT_MISSING", "side_folded: " + name + " is missing; give all points of the photograph");
  }
  if (view.outline.size() < 8) {
    return InvalidArgument("POINT_MISSING", "side_folded: the outline has fewer than 8 points; photograph it again");
  }
  const auto at = [&](const char* name) { return FindPoint(view, name)->pixel; };
  const panels::Polyline outseam = SmoothPart(view, at("waist_side"), at("hem_outer"));
  const double seen = panels::ChainLength(outseam) * view.metre_per_pixel;
  if (!(std::abs(seen / outseam_length - 1.0) < kMostScaleError)) {
    return InvalidArgument("SIDE_FOLD_CONTRADICTS_LENGTH",
                           "the side-folded photograph shows an outseam of " + std::to_string(seen * 100.0) +
                               " cm, the others one of " + std::to_string(outseam_length * 100.0) +
                               " cm; check its scale and the points waist_side and hem_outer");
  }
  const panels::Polyline curve = SmoothPart(view, at("crotch"), at("waist_centre"));
  const Eigen::Vector2d tip = NearestPlace(view.outline, at("crotch")).pixel;
  const double across = AcrossFrom(tip, outseam);
  if (!(across > 0.0)) {
    return InvalidArgument("POINT_MISSING",
                           "side_folded: the outseam does not pass the crotch's height; check the points crotch, "
                           "waist_side and hem_outer");
  }
  return SideFold{2.0 * across * view.metre_per_pixel, panels::ChainLength(curve) * view.metre_per_pixel};
}

}  // namespace fork
}  // namespace fitroom

#include "fit_client/fit/measure/ease_bands.h"

#include <algorithm>
#include <array>
#include <limits>

namespace fitroom {
namespace {

constexpr double kAnyWidth = std::numeric_limits<double>::infinity();

// Upper limits of the classes of a knit, part of the body's girth, from compression to relaxed; above: oversized.
struct KnitClasses {
  std::array<double, 5> limits;
};
constexpr std::array<std::string_view, 6> kKnitNames = {"compression", "very fitted", "fitted",
                                                        "loose",       "relaxed",     "oversized"};
constexpr KnitClasses kKnitBust = {{-0.10, 0.0, 0.05, 0.10, 0.20}};
constexpr KnitClasses kKnitWaist = {{-0.10, 0.0, 0.10, 0.20, 0.40}};
constexpr KnitClasses kKnitHip = {{0.0, 0.05, 0.10, 0.15, 0.25}};

std::optional<KnitClasses> KnitClassesOf(FitZone zone) {
  switch (zone) {
    case FitZone::kBust:
      return kKnitBust;
    case FitZone::kWaist:
      return kKnitWaist;
    case FitZone::kHip:
      return kKnitHip;
    default:
      return std::nullopt;
  }
}

std::optional<EaseBand> KnitBand(GarmentKind kind, const Fabric& fabric, FitZone zone, double body_girth) {
  // Stretched to half of what it can, a knit is tight whatever its class is called.
  const double tight = 1.0 / (1.0 + fabric.tight_strain()) - 1.0;
  EaseBand band;
  if (zone == FitZone::kUpperArm || (zone == FitZone::kThigh && HasLegs(kind))) {
    band = {std::max(tight, -0.10) * body_girth, 0.05 * body_girth, kAnyWidth};
    return band;
  }
  const std::optional<KnitClasses> classes = KnitClassesOf(zone);
  if (!classes) return std::nullopt;
  band.least = std::max(tight, classes->limits[0]) * body_girth;
  band.target = 0.5 * (classes->limits[2] + classes->limits[3]) * body_girth;  // The middle of "loose".
  band.most = classes->limits[4] * body_girth;
  // A knitted bottom is held by its waist; below it falls as it likes.
  if (IsBottom(kind)) {
    band.target = zone == FitZone::kWaist ? 0.0 : 0.05 * body_girth;
    band.most = zone == FitZone::kWaist ? 0.08 * body_girth : kAnyWidth;
  } else if (zone != FitZone::kBust) {
    band.most = kAnyWidth;  // The cut below the bust is a matter of taste.
  }
  return band;
}

std::optional<EaseBand> WovenBand(GarmentKind kind, FitZone zone) {
  const bool is_bottom = IsBottom(kind);
  switch (zone) {
    case FitZone::kBust:
      return EaseBand{0.038, 0.0875, 0.125};
    case FitZone::kWaist:
      return is_bottom ? EaseBand{0.013, 0.019, 0.05} : EaseBand{0.019, 0.06, kAnyWidth};
    case FitZone::kHip:
      return EaseBand{0.051, is_bottom ? 0.06 : 0.07, HasLegs(kind) ? 0.16 : kAnyWidth};
    case FitZone::kThigh:
      if (!HasLegs(kind)) return std::nullopt;
      return EaseBand{0.025, 0.05, kAnyWidth};
    case FitZone::kUpperArm:
      return EaseBand{0.025, 0.05, kAnyWidth};
    default:
      return std::nullopt;
  }
}

}  // namespace

std::optional<EaseBand> EaseBandOf(GarmentKind kind, const Fabric& fabric, FitZone zone, double body_girth) {
  return fabric.is_knit ? KnitBand(kind, fabric, zone, body_girth) : WovenBand(kind, zone);
}

std::string_view EaseClassName(const Fabric& fabric, FitZone zone, double ease, double body_girth) {
  if (!(body_girth > 0.0)) return "";
  if (fabric.is_knit) {
    const std::optional<KnitClasses> classes = KnitClassesOf(zone);
    if (!classes) return "";
    size_t index = 0;
    while (index < classes->limits.size() && ease / body_girth >= classes->limits[index]) ++index;
    return kKnitNames[index];
  }
  if (zone != FitZone::kBust) return "";
  if (ease <= 0.075) return "close";
  if (ease <= 0.10) return "fitted";
  if (ease <= 0.125) return "semi-fitted";
  return ease <= 0.20 ? "loose" : "very loose";
}

}  // namespace fitroom

#pragma once

#include <optional>
#include <string_view>

#include "common/garment/garment.h"
#include "fit_client/fit/measure/zones.h"
#include "fit_client/fit/solver/fabric.h"

namespace fitroom {

// How much room a zone needs and how much is much (unit: metre). README.md holds the sources.
struct EaseBand {
  double least = 0.0;   // Below: tight.
  double target = 0.0;  // What most cutters give a garment of this kind.
  double most = 0.0;    // Above: loose; infinite where width is a matter of taste.
};

// Returns the band of a zone for a body of this girth; nothing where the zone decides nothing.
std::optional<EaseBand> EaseBandOf(GarmentKind kind, const Fabric& fabric, FitZone zone, double body_girth);

// Returns what the trade calls this ease: of a knit "oversized", "relaxed", "loose", "fitted", "very fitted" or
// "compression"; of a woven's bust "close", "fitted", "semi-fitted", "loose" or "very loose"; "" elsewhere.
std::string_view EaseClassName(const Fabric& fabric, FitZone zone, double ease, double body_girth);

}  // namespace fitroom

#pragma once

#include <span>
#include <string>
#include <vector>

#include "common/garment/garment.h"
#include "fit_client/fit/measure/zone_fit.h"
#include "fit_client/fit/solver/fabric.h"

namespace fitroom {

// What is known of a fit's ease at best: garment 10 mm, scan 9 mm (ISO 20685-1, large girths), photograph 5 mm, as the
// root of the sum of squares (unit: metre).
inline constexpr double kFitUncertainty = 0.01435;

enum class FitVerdict { kGood, kTight, kLoose, kDoesNotFit, kUndecided };
// "good", "tight", "loose", "does_not_fit", "undecided".
std::string_view FitVerdictName(FitVerdict verdict);
// "good", "tight", "loose", "does not fit", "cannot be told".
std::string_view FitVerdictWords(FitVerdict verdict);

// The body that a size is cut for, at one zone (from the chart).
struct IntendedGirth {
  FitZone zone = FitZone::kBust;
  double girth = 0.0;      // (unit: metre)
  double half_step = 0.0;  // Half of the way to the next larger size (unit: metre).
};

// What dressing found out that no tape says. All zero: nothing, or the size was not dressed.
struct DressingFacts {
  // By how much a seam does not close: the girth that is missing of the body's with what it wears, the garment
  // stretched to its fabric's limit; the seam gapes by as much (unit: metre).
  double open_gap = 0.0;
  FitZone open_zone = FitZone::kHip;
  std::string open_seam;     // "left side seam"; empty where it is not known.
  double open_length = 0.0;  // Of open seam (unit: metre).
  double rise_short = 0.0;   // By how much a bottom's rise ends before the waist (unit: metre).
  bool is_belted = false;    // A bottom's waist was gathered by a belt.
};

// Everything a verdict rests on. Views are of the call only.
struct VerdictInput {
  std::string size;  // As the chart names it; may be empty.
  GarmentKind kind = GarmentKind::kTShirt;
  Fabric fabric;
  std::vector<ZoneFit> zones;
  std::vector<IntendedGirth> intended;
  DressingFacts facts;
  // Further dimensions that decide and are not known: "front rise". Zones of provenance kUnknown need not be named.
  std::vector<std::string> unknown;
};

// One zone's say.
struct ZoneVerdict {
  FitZone zone = FitZone::kBust;
  FitVerdict verdict = FitVerdict::kGood;
  double amount = 0.0;    // By how much it misses; 0 where it is good (unit: metre).
  bool is_close = false;  // A limit is nearer than the uncertainty.
  std::string reason;     // "2 cm less than the 5 cm a woven needs"; empty where it is good.
};

// How one size fits, and why.
struct SizeVerdict {
  std::string size;
  FitVerdict verdict = FitVerdict::kUndecided;
  bool has_deciding_zone = false;
  FitZone deciding_zone = FitZone::kBust;
  std::string reason;     // One sentence for a shopper, without a full stop.
  bool is_close = false;  // The measures are not sure enough to exclude the neighbouring verdict.
  double uncertainty = kFitUncertainty;
  std::vector<std::string> unknown;  // What would have to be known.
  double shortfall = 0.0;            // Of what is tight, at the zone that lacks most (unit: metre).
  // How much larger (+) or smaller (-) the body is at the primary zone than the body that the size is cut for: the
  // chart's, or the one that the flat girth leaves the usual ease.
  bool has_primary = false;
  double primary_offset = 0.0;  // (unit: metre)
  std::vector<ZoneVerdict> zones;
};

// Judges one size. Does-not-fit stands against anything unknown; otherwise a verdict is refused (kUndecided) while a
// dimension that decides is unknown. A garment larger at every zone is never judged tighter.
SizeVerdict JudgeSize(const VerdictInput& input);

// Returns the girths that size `index` of a chart is cut for.
std::vector<IntendedGirth> IntendedGirths(const SizeChart& chart, size_t index);

// A size that is tight by more than this is passed over for the next larger one: half a step of four centimetres that
// a body may be larger than its size's, and a little for the measures (unit: metre).
inline constexpr double kPassedOverShortfall = 0.03;

// Which size to take.
struct SizeRecommendation {
  bool found = false;   // False: no size fits; `text` says what comes nearest.
  std::string size;     // The best, or the nearest where none fits.
  std::string between;  // The other of two sizes that are closer to each other than the uncertainty; else empty.
  std::string text;     // "M", "between M and L", "no size fits: …".
};

// Chooses from the verdicts of a chart, smallest size first: the size whose intended body is nearest at the primary
// zone; from there upwards while a size does not fit or lacks about a size (kPassedOverShortfall) somewhere.
SizeRecommendation Recommend(std::span<const SizeVerdict> verdicts);

}  // namespace fitroom

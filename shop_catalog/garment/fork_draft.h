#pragma once

#include <optional>
#include <string_view>

#include "shop_catalog/garment/flat_curve.h"

namespace fitroom::shop_catalog {

// Rules by which trousers are drafted where the crotch joins the legs. All draw the front extension at about a
// sixteenth of the hip girth; they differ in the back.
enum class ForkRule {
  kClose,    // Back like the front: jeans.
  kTrouser,  // Back a tenth of the hip girth.
  kClassic,  // Aldrich, "Metric Pattern Cutting": front hip/16 + 0.5 cm, back 1.5 fronts and (hip/12 + 1.5)/4.
};
std::optional<ForkRule> ForkRuleFromName(std::string_view name);  // "close", "trouser" or "classic".

// What folding hides of trousers that lie flat (unit: centimetre).
struct ForkDraft {
  double front_extension = 0.0;  // From the fork line, where front and back would meet in a tube, to the inseam.
  double back_extension = 0.0;
  double front_rise = 0.0;   // Along the crotch seam, from the waist's edge to the inseam.
  double back_rise = 0.0;    // The same behind; front and back have their waist at one height.
  double thigh_width = 0.0;  // Half the leg's girth at the crotch's height.
};

// Drafts the fork of trousers of this flat hip width (half a girth) and crotch depth, waist to crotch (unit: cm).
ForkDraft DraftFork(double hip_width, double crotch_depth, ForkRule rule);

// Returns a crotch curve from the waist's edge (0, 0) down to the inseam (-extension, depth): straight down, then a
// cubic that ends level. The cubic begins at 45 % of the way from the crotch's height up to the hip line.
FlatCurve CrotchCurve(double depth, double extension);

}  // namespace fitroom::shop_catalog

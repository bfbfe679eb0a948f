#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/status.h"
#include "common/garment/garment.h"
#include "fit_client/fit/panels/pattern.h"

namespace fitroom {

// How far front and back reach beyond the centre line at the crotch, after the hip's girth. Rules of the body's hip are
// given the garment's less 6 cm, the wearing ease of woven trousers.
enum class ForkRule {
  kClose,        // Jeans: front hip/16, back hip/16.
  kTrouser,      // Front hip/16, back hip/10.
  kClassic,      // Front hip/16, back hip/8.
  kAldrich,      // Front hip/16 + 0.5 cm, back (hip/12 + 1.5 cm)/4 + 1.5 front (Aldrich, classic trouser block).
  kTitan,        // A quarter of the front's and of the back's quarter arc of the garment (FreeSewing, Titan).
  kGarmentCode,  // Front hip/16, back leg girth - hip/2 + 5 cm - front (GarmentCode).
};
inline constexpr int kForkRuleCount = 6;
std::string_view ForkRuleName(ForkRule rule);  // "close", "trouser", "classic", "aldrich", "titan", "garment_code".
std::optional<ForkRule> ForkRuleFromName(std::string_view name);

// What is known of the part of trousers that folding hides. All in metres.
struct ForkEvidence {
  // Along the centre seams from the waist's edge to the point where the four pieces meet.
  std::optional<double> front_rise;
  std::optional<double> back_rise;
  std::optional<double> thigh_width;  // Flat: half the leg's girth at the crotch.
  // The numbers above were scaled from another size: what is built of them counts as ruled, not as stated.
  bool rises_estimated = false;
  bool thigh_estimated = false;
  std::optional<GarmentView> side_folded;
  // What is neither stated nor seen is ruled by this; absent: it is not ruled. Then thigh_width or side_folded, or both
  // rises, must be there.
  std::optional<ForkRule> rule;
};

// Returns what a garment says of its fork: what was stated (in `size`, if given, else of the garment itself; one that a
// photograph showed is no evidence), and the side-folded photograph.
ForkEvidence EvidenceFrom(const Garment& garment, const GarmentSize* size = nullptr);

// Returns which size dimensions of a bottom with legs the evidence leaves undecided: of "thigh_width", "front_rise",
// "back_rise"; empty for kinds without legs.
std::vector<std::string> UndecidedByFolding(GarmentKind kind, const ForkEvidence& evidence);

// Trousers with the fork that folding hid: front and back are cut in the middle and reach beyond it.
//
//   wc ___ e1      Seams: outseams and inseams, front to back; centre front and centre back, left to right.
//     |   |        All four pieces meet in one point, the fork ("crotch"). Front and back inseam have one length.
//     (   |
//   __/   |        The left front piece: its fork reaches over the centre line to the wearer's right.
//   \     |
//    |____|
struct ForkedPattern {
  GarmentPattern photographed;  // As it was: two pieces.
  // Front left, front right, back left, back right; frame and direction as PanelPattern. Sections of a left piece:
  // "waist_L", "centre_L", "inseam_L", "leg_hem_L", "outseam_L"; of a right one "waist_R", "outseam_R", "leg_hem_R",
  // "inseam_R", "centre_R".
  std::vector<PanelPattern> pieces;
  // hip_width, thigh_width (at the crotch), front_rise, back_rise, crotch_length, front_extension, back_extension.
  std::vector<GarmentMeasure> measures;
  // Thigh and hip contradict each other: an extension was held between hip/20 and hip/6.
  bool extension_clamped = false;
  // How much the waist's middle was raised to meet a rise (unit: metre).
  double front_waist_raise = 0.0;
  double back_waist_raise = 0.0;
};

inline constexpr int kForkPieceCount = 4;

// Returns the evidence for another size of trousers whose photographed size was rebuilt: what is stated of that size,
// and for the rest the photographed fork's, scaled: the thigh with the hip, the rises with the crotch's visible depth
// and the extensions.
ForkEvidence EvidenceForSize(const ForkedPattern& photographed, const GarmentPattern& graded, ForkEvidence stated);

// Rebuilds the fork. Extensions: with a known thigh T, front = hip/16 + 0.5 cm (or the rule's) and back = T - widths -
// front; with known rises, the back's is solved to its rise; else by the rule. Each centre seam runs straight down and
// then along a cubic that starts 47.5 % of the hip's depth above the crotch and arrives level; its fullness, then the
// height of the waist's middle, meet the rise within 1 mm. Inseams run from the fork to the photographed leg, trousers'
// at the knee, shorts' at the hem; the back's fork lies lower so that both have one length.
// Fails with FAILED_PRECONDITION FORK_UNKNOWN (nothing decides it: the two-piece pattern remains; the message names the
// remedies), INVALID_ARGUMENT: KIND_WITHOUT_FORK, FORK_MEASURE_ABSURD, RISE_CONTRADICTS_PHOTOGRAPH, POINT_MISSING,
// SIDE_FOLD_CONTRADICTS_LENGTH (of the side-folded photograph), FORK_NOT_A_GARMENT (a piece would cross itself).
Result<ForkedPattern> BuildFork(const GarmentPattern& pattern, const ForkEvidence& evidence);

}  // namespace fitroom

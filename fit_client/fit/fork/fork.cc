#include "fit_client/fit/fork/fork.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "fit_client/fit/fork/fork_curves.h"
#include "fit_client/fit/fork/fork_evidence.h"
#include "fit_client/fit/fork/fork_half.h"
#include "fit_client/fit/fork/fork_pieces.h"
#include "fit_client/fit/panels/measure.h"
#include "fit_client/fit/panels/polyline.h"

namespace fitroom {
namespace {

using fork::CentreShape;
using fork::ForkExtensions;
using fork::HalfPanel;
using fork::InseamShape;

// What nobody has (unit: metre).
constexpr double kLeastRise = 0.10, kMostRise = 0.60;
// An extension lies between these shares of the hip's girth.
constexpr double kLeastExtension = 1.0 / 20.0, kMostExtension = 1.0 / 6.0;
// A thigh beyond these shares of what the photograph shows of it belongs to another garment.
constexpr double kLeastThigh = 0.8, kMostThigh = 2.0;
constexpr double kRiseTolerance = 0.001;  // (unit: metre)
constexpr int kThighRounds = 4;

Status Invalid(std::string reason, std::string message) {
  return InvalidArgument(std::move(reason), std::move(message));
}

std::string Centimetres(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f cm", metres * 100.0);
  return text;
}

// A value and how it is known; nothing where it is not.
struct Known {
  std::optional<double> value;
  Provenance provenance = Provenance::kUnknown;
};

struct Panels {
  HalfPanel front_left, front_right, back_left, back_right;
};

// What is known before solving. Lengths in metres.
struct ForkProblem {
  double hip_girth = 0.0;
  double leg_width = 0.0;  // From the outseam to the centre line at the crotch, mean of left and right.
  bool at_hem = false;
  Known thigh_girth, front_rise, back_rise, crotch_length;
  std::optional<ForkRule> rule;
};

struct ForkSolution {
  ForkExtensions extensions;
  bool clamped = false;
  InseamShape inseam;
  CentreShape front, back;
};

double LegWidth(const HalfPanel& half) {
  const Eigen::Vector2d& crotch = half.inseam.points.front();
  return fork::AcrossAt(half.outseam.points, crotch.y()) - crotch.x();
}

Status CheckEvidence(const ForkEvidence& evidence) {
  for (const auto& [name, rise] : {std::pair("front_rise", evidence.front_rise), {"back_rise", evidence.back_rise}}) {
    if (!rise || (*rise >= kLeastRise && *rise <= kMostRise)) continue;
    return Invalid("FORK_MEASURE_ABSURD", std::string(name) +
                                              " must lie between 10 and 60 cm, along the seam from the "
                                              "waist's edge to the fork; correct it");
  }
  return {};
}

// Gathers what the evidence says of these trousers.
Result<ForkProblem> StateProblem(const GarmentPattern& pattern, const Panels& halves, const ForkEvidence& evidence) {
  FR_RETURN_IF_ERROR(CheckEvidence(evidence));
  ForkProblem problem;
  problem.hip_girth = 2.0 * MeasureValue(MeasurePattern(pattern), "hip_width");
  problem.leg_width = 0.5 * (LegWidth(halves.front_left) + LegWidth(halves.front_right));
  problem.at_hem = pattern.kind == GarmentKind::kShorts;
  problem.rule = evidence.rule;
  const auto known = [](bool estimated) { return estimated ? Provenance::kRuled : Provenance::kStated; };
  if (evidence.front_rise) problem.front_rise = {evidence.front_rise, known(evidence.rises_estimated)};
  if (evidence.back_rise) problem.back_rise = {evidence.back_rise, known(evidence.rises_estimated)};
  if (evidence.thigh_width) problem.thigh_girth = {2.0 * *evidence.thigh_width, known(evidence.thigh_estimated)};
  if (evidence.side_folded) {
    const double outseam = 0.5 * (panels::ChainLength(halves.front_left.outseam.points) +
                                  panels::ChainLength(halves.front_right.outseam.points));
    FR_ASSIGN_OR_RETURN(const fork::SideFold fold, fork::MeasureSideFold(*evidence.side_folded, outseam));
    problem.thigh_girth = {fold.thigh_girth, Provenance::kMeasured};
    // Both curves lie on each other; of both waists the back's, cut higher, is seen. One that looks lower only lies so.
    const double step =
        std::max(0.0, halves.back_left.waist.points.back().y() - halves.front_left.waist.points.back().y());
    problem.crotch_length = {2.0 * fold.curve_length - step, Provenance::kMeasured};
  }
  const double leg = 2.0 * problem.leg_width;
  if (problem.thigh_girth.value &&
      !(*problem.thigh_girth.value >= kLeastThigh * leg && *problem.thigh_girth.value <= kMostThigh * leg)) {
    return Invalid("FORK_MEASURE_ABSURD", "a thigh of " + Centimetres(*problem.thigh_girth.value) +
                                              " around does not go with a leg that is photographed " +
                                              Centimetres(problem.leg_width) +
                                              " wide; give the flat width of one leg at the crotch");
  }
  const bool rises_known = problem.front_rise.value && problem.back_rise.value;
  if (!problem.thigh_girth.value && !rises_known && !problem.rule) {
    return FailedPrecondition("FORK_UNKNOWN",
                              "photographs of folded trousers hide thigh_width, front_rise and back_rise; state them, "
                              "add a side-folded photograph, or choose a drafting rule for an estimate");
  }
  return problem;
}

double Natural(const HalfPanel& half, double extension, double drop) {
  CentreShape shape;
  shape.extension = extension;
  shape.drop = drop;
  return panels::ChainLength(fork::CentreSeam(fork::FrameOf(half), shape));
}

// The back's extension at which its curve has the stated rise without being bent for it; longer with the extension.
double ExtensionForRise(const HalfPanel& half, double rise, double low, double high) {
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (Natural(half, middle, 0.0) < rise ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

void SolveExtensions(const ForkProblem& problem, const Panels& halves, ForkSolution& solution) {
  const double low = kLeastExtension * problem.hip_girth, high = kMostExtension * problem.hip_girth;
  ForkExtensions& e = solution.extensions;
  e = fork::ExtensionsByRule(problem.rule.value_or(ForkRule::kAldrich), problem.hip_girth);
  if (problem.thigh_girth.value) {
    const double total = *problem.thigh_girth.value - 2.0 * problem.leg_width;
    e.back = std::clamp(total - e.front, low, high);
    e.front = std::clamp(total - e.back, low, high);
    solution.clamped = std::abs(e.front + e.back - total) > 1e-9;
  } else if (!problem.rule) {
    e.back = ExtensionForRise(halves.back_left, *problem.back_rise.value, low, high);
  }
}

// Returns the shape for a rise, or the natural one where none is known.
Result<CentreShape> SolveCentre(const HalfPanel& half, double extension, double drop, const std::optional<double>& rise,
                                const char* name) {
  CentreShape shape;
  shape.extension = extension;
  shape.drop = drop;
  if (!rise) return shape;
  const fork::CentreFrame frame = fork::FrameOf(half);
  const std::optional<CentreShape> solved = fork::ShapeForRise(frame, shape, *rise);
  if (solved && std::abs(panels::ChainLength(fork::CentreSeam(frame, *solved)) - *rise) <= kRiseTolerance) {
    return *solved;
  }
  return Invalid("RISE_CONTRADICTS_PHOTOGRAPH",
                 std::string(name) + " of " + Centimetres(*rise) + " does not go with the photographs, which leave " +
                     Centimetres(Natural(half, extension, drop)) +
                     "; measure it along the seam from the waist's edge to where the inseams meet");
}

Result<ForkSolution> Solve(const ForkProblem& problem, const Panels& halves) {
  ForkSolution solution;
  SolveExtensions(problem, halves, solution);
  const ForkExtensions wanted = solution.extensions;
  // The back's tip lies lower, where the leg is a little wider or narrower than at the crotch.
  for (int round = 0; round < kThighRounds; ++round) {
    const std::optional<InseamShape> inseam =
        fork::BalanceInseams(halves.front_left, solution.extensions.front, solution.extensions.back, problem.at_hem);
    if (!inseam) {
      return Invalid("FORK_NOT_A_GARMENT", "front and back inseam cannot have one length with extensions of " +
                                               Centimetres(solution.extensions.front) + " and " +
                                               Centimetres(solution.extensions.back) +
                                               "; check thigh_width and the rises");
    }
    solution.inseam = *inseam;
    if (!problem.thigh_girth.value || solution.clamped) break;
    const Eigen::Vector2d& crotch = halves.back_left.inseam.points.front();
    const double lower = fork::AcrossAt(halves.back_left.outseam.points, crotch.y() - inseam->back_drop) - crotch.x();
    solution.extensions.back = wanted.back - (lower - LegWidth(halves.back_left));
  }
  const ForkExtensions& e = solution.extensions;
  const double drop = solution.inseam.back_drop;
  std::optional<double> front_rise = problem.front_rise.value, back_rise = problem.back_rise.value;
  if (problem.crotch_length.value) {
    const double total = *problem.crotch_length.value;
    const double front = Natural(halves.front_left, e.front, 0.0), back = Natural(halves.back_left, e.back, drop);
    if (!front_rise) front_rise = back_rise ? total - *back_rise : front + 0.5 * (total - front - back);
    if (!back_rise) back_rise = total - *front_rise;
  }
  FR_ASSIGN_OR_RETURN(solution.front, SolveCentre(halves.front_left, e.front, 0.0, front_rise, "front_rise"));
  FR_ASSIGN_OR_RETURN(solution.back, SolveCentre(halves.back_left, e.back, drop, back_rise, "back_rise"));
  return solution;
}

void CutPieces(const ForkProblem& problem, const ForkSolution& solution, const Panels& halves, ForkedPattern& forked) {
  const ForkExtensions& e = solution.extensions;
  const double mean = 0.5 * (e.front + e.back);
  const auto cut = [&](const PanelPattern& panel, const HalfPanel& half, bool left, bool front) {
    const fork::Inseam inseam =
        fork::InseamFor(half, front ? e.front : e.back, mean, front ? 0.0 : solution.inseam.back_drop,
                        solution.inseam.share, problem.at_hem);
    forked.pieces.push_back(fork::CutPiece(panel, half, left, {front ? solution.front : solution.back, inseam}));
  };
  cut(forked.photographed.front, halves.front_left, true, true);
  cut(forked.photographed.front, halves.front_right, false, true);
  cut(forked.photographed.back, halves.back_left, true, false);
  cut(forked.photographed.back, halves.back_right, false, false);
}

void TakeMeasures(const ForkProblem& problem, const ForkSolution& solution, const Panels& halves,
                  ForkedPattern& forked) {
  const auto or_ruled = [](const Known& known) { return known.value ? known.provenance : Provenance::kRuled; };
  const auto length = [&](int piece) {
    return panels::ChainLength(FindSection(forked.pieces[static_cast<size_t>(piece)], "centre_L")->points);
  };
  const ForkExtensions& e = solution.extensions;
  const Eigen::Vector2d& crotch = halves.back_left.inseam.points.front();
  const double back_leg =
      fork::AcrossAt(halves.back_left.outseam.points, crotch.y() - solution.inseam.back_drop) - crotch.x();
  const double thigh_girth = LegWidth(halves.front_left) + back_leg + e.front + e.back;
  const double front = length(0), back = length(2);
  const Provenance thigh = solution.clamped ? Provenance::kRuled : or_ruled(problem.thigh_girth);
  const bool rises_known = problem.front_rise.value && problem.back_rise.value;
  const bool by_rises = !problem.thigh_girth.value && !problem.rule;
  forked.measures = {
      {"hip_width", 0.5 * problem.hip_girth, Provenance::kMeasured},
      {"thigh_width", 0.5 * thigh_girth, thigh},
      {"front_rise", front, or_ruled(problem.front_rise)},
      {"back_rise", back, or_ruled(problem.back_rise)},
      {"crotch_length", front + back, rises_known ? problem.front_rise.provenance : or_ruled(problem.crotch_length)},
      {"front_extension", e.front, Provenance::kRuled},
      {"back_extension", e.back, by_rises ? Provenance::kRuled : thigh}};
}

Status CheckPieces(const ForkedPattern& forked) {
  for (const PanelPattern& piece : forked.pieces) {
    const std::vector<Eigen::Vector2d> outline = JoinedPoints(piece);
    bool finite = true;
    for (const Eigen::Vector2d& p : outline) finite = finite && p.allFinite();
    if (finite && panels::SignedArea(outline) > 0.0 && panels::IsSimplePolygon(outline)) continue;
    return Invalid("FORK_NOT_A_GARMENT",
                   std::string(piece.side == GarmentSide::kFront ? "front" : "back") +
                       ": the piece would cross itself; check the points crotch and knee_inner and the stated rises");
  }
  return {};
}

}  // namespace

ForkEvidence EvidenceForSize(const ForkedPattern& photographed, const GarmentPattern& graded, ForkEvidence stated) {
  const auto of = [&](const char* name) { return FindMeasure(photographed.measures, name)->value; };
  const std::vector<GarmentMeasure> before = MeasurePattern(photographed.photographed), after = MeasurePattern(graded);
  const auto growth = [&](const char* name) { return MeasureValue(after, name) / MeasureValue(before, name); };
  const double hip_growth = growth("hip_width");
  if (!stated.thigh_width) {
    stated.thigh_width = hip_growth * of("thigh_width");
    stated.thigh_estimated = true;
  }
  // A curve grows with its height in full and with its extension by about a half: from a quarter ellipse's length.
  const auto scaled_rise = [&](const char* rise, const char* extension) {
    const double deeper = MeasureValue(after, rise) - MeasureValue(before, rise);
    return of(rise) + deeper + 0.5 * (hip_growth - 1.0) * of(extension);
  };
  if (!stated.front_rise || !stated.back_rise) {
    if (!stated.front_rise) stated.front_rise = scaled_rise("front_rise", "front_extension");
    if (!stated.back_rise) stated.back_rise = scaled_rise("back_rise", "back_extension");
    stated.rises_estimated = true;
  }
  return stated;
}

Result<ForkedPattern> BuildFork(const GarmentPattern& pattern, const ForkEvidence& evidence) {
  if (!HasLegs(pattern.kind)) {
    return Invalid("KIND_WITHOUT_FORK", "a " + std::string(GarmentKindName(pattern.kind)) + " has no fork");
  }
  const Panels halves{fork::TakeHalf(pattern.front, true), fork::TakeHalf(pattern.front, false),
                      fork::TakeHalf(pattern.back, true), fork::TakeHalf(pattern.back, false)};
  FR_ASSIGN_OR_RETURN(const ForkProblem problem, StateProblem(pattern, halves, evidence));
  FR_ASSIGN_OR_RETURN(const ForkSolution solution, Solve(problem, halves));
  ForkedPattern forked;
  forked.photographed = pattern;
  forked.extension_clamped = solution.clamped;
  forked.front_waist_raise = solution.front.raise;
  forked.back_waist_raise = solution.back.raise;
  CutPieces(problem, solution, halves, forked);
  TakeMeasures(problem, solution, halves, forked);
  FR_RETURN_IF_ERROR(CheckPieces(forked));
  return forked;
}

}  // namespace fitroom

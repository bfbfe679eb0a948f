#include "fit_client/fit/stages/dress_bottom.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "fit_client/fit/stages/push_out.h"

namespace fitroom {
namespace {

constexpr double kMergingPicture = 0.45;  // How far the panels have come in the picture of the merging, 0 to 1.
constexpr double kLeastToSay = 0.005;     // Differences of waist and rise below this are none (unit: metre).
constexpr double kWaistReached = 0.004;   // A waist this far below its height is there (unit: metre).
constexpr double kWholeSkirt = 1e3;       // (unit: metre)

// Where the cloth can get to: round the start, and lower, because it falls.
Eigen::AlignedBox3d ReachOf(const std::vector<Eigen::Vector3d>& places) {
  Eigen::AlignedBox3d reach;
  for (const Eigen::Vector3d& place : places) reach.extend(place);
  reach.min() -= Eigen::Vector3d(0.06, 0.12, 0.06);
  reach.max() += Eigen::Vector3d(0.06, 0.06, 0.06);
  return reach;
}

std::vector<int> WaistVertices(const BottomOutline& outline) {
  std::vector<int> vertices;
  for (const WaistParticle& edge : outline.waist) vertices.push_back(edge.particle);
  return vertices;
}

// The height at which the body first is as wide as the garment's waist, going down from its waist to its hip: where a
// waistband of that girth sits by itself.
double SeatOfWaist(const LowerBody& body, double garment_girth) {
  double height = body.waist_height();
  while (height > body.hip_height() && body.TrunkGirth(height) < garment_girth) height -= LowerBody::kStep;
  return height;
}

void Describe(const LowerBody& body, const DrapeReport& report, BottomOutcome& outcome) {
  char text[120];
  const double ease = outcome.belt.ease();
  outcome.rise_short = std::max(0.0, SeatOfWaist(body, outcome.belt.garment_girth) - outcome.belt.height);
  if (outcome.rise_short < 2.0 * LowerBody::kStep) outcome.rise_short = 0.0;
  if (ease < -kLeastToSay) {
    std::snprintf(text, sizeof(text), "waist short by %.1f cm", -ease * 100.0);
    outcome.sentences.emplace_back(text);
  } else if (ease > kLeastToSay) {
    std::snprintf(text, sizeof(text), "waist %.1f cm too wide, belted", ease * 100.0);
    outcome.sentences.emplace_back(text);
  }
  if (outcome.rise_short > 0.0) {
    std::snprintf(text, sizeof(text), "rise short by %.0f mm", outcome.rise_short * 1000.0);
    outcome.sentences.emplace_back(text);
  }
  outcome.pull_end = report.pull_end;
  outcome.outseam_residual = report.length_residual;
  outcome.ended_by_outseams = report.length_condition_met;
}

}  // namespace

Result<Dressing> DressBottom(const ClothMesh& cloth, const DressedBody& wearer, const DressingOptions& options,
                             Executor& executor, const std::function<void(double done)>& progress) {
  FR_ASSIGN_OR_RETURN(const LowerBody lower, LowerBody::Cut(wearer.body, wearer.collider, wearer.layers));
  FR_ASSIGN_OR_RETURN(const BottomOutline outline, FindBottomOutline(cloth));
  FR_ASSIGN_OR_RETURN(BottomPose pose, PlaceBottom(cloth, outline, lower, options.bottom_pose));
  FR_ASSIGN_OR_RETURN(SignedDistanceField field, BuildDressedField(wearer.collider, wearer.layers, ReachOf(pose.around),
                                                                   options.field_pitch, executor));
  // Start places near the crotch and beside hands may lie in the body.
  PushOut(field, options.drape.contact_offset, pose.around);

  Dressing result;
  result.field = std::make_shared<const SignedDistanceField>(std::move(field));
  result.stages.start = pose.apart;
  for (size_t i = 0; i < pose.apart.size(); ++i) {
    result.stages.merging.push_back((1.0 - kMergingPicture) * pose.apart[i] + kMergingPicture * pose.round_legs[i]);
  }
  result.stages.stitched = pose.round_legs;
  BottomOutcome& outcome = result.bottom.emplace();

  DrapeOptions drape = options.drape;
  PullUpOptions pull;
  pull.crotch_vertices = outline.crotch;
  pull.edge_vertices = WaistVertices(outline);
  if (!outline.has_legs()) {
    pull.edge_height = lower.waist_height() - kWaistReached;
    pull.grip_length = kWholeSkirt;  // Nothing below the waist could be blown up: the skirt rises as it is.
  }
  drape.pull_up = std::move(pull);
  drape.attach = [&](std::span<const Eigen::Vector3d> positions) -> Result<std::vector<Attachment>> {
    const double height = MeanWaistHeight(outline, positions);
    FR_ASSIGN_OR_RETURN(Belt belt, LayBelt(outline, lower.At(height).trunk, height, lower.groin().x(),
                                           drape.contact_offset + kBeltClearance));
    outcome.belt = belt.measure;
    return std::move(belt.attachments);
  };
  for (const auto& side : outline.outseams) drape.measured_chains.push_back(side[0].particles);
  const DrapeObserver observer = [&](const DrapeSnapshot& snapshot) {
    if (snapshot.stage == DrapeStage::kPulledUp) {
      result.stages.pulled_up.assign(snapshot.positions.begin(), snapshot.positions.end());
    }
    if (snapshot.stage == DrapeStage::kBelted) {
      result.stages.belted.assign(snapshot.positions.begin(), snapshot.positions.end());
    }
    if (progress) progress(snapshot.progress);
  };
  FR_ASSIGN_OR_RETURN(DrapeResult draped, Drape(cloth, pose.around, *result.field, drape, executor, observer));
  result.stages.final = std::move(draped.positions);
  result.report = std::move(draped.report);
  Describe(lower, result.report, outcome);
  return result;
}

}  // namespace fitroom

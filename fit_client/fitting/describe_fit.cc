#include "fit_client/fitting/describe_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "fit_client/fit/measure/garment_girth.h"

namespace fitroom {
namespace {

// A point inside the torso at `height`: the middle of the body's depth near its plane of symmetry (unit: metre).
Eigen::Vector2d TorsoAxis(const TriangleMesh& body, double height) {
  double front = -1e9;
  double back = 1e9;
  for (const Eigen::Vector3d& vertex : body.vertices) {
    if (std::abs(vertex.y() - height) > 0.01 || std::abs(vertex.x()) > 0.08) continue;
    front = std::max(front, vertex.z());
    back = std::min(back, vertex.z());
  }
  return {0.0, front > back ? 0.5 * (front + back) : 0.0};
}

// The garment's own bust line, as shops measure it, lies just under its underarms: above, the cloth is open to the
// sleeves.
double HighestClosedHeight(const FittedGarment& worn) {
  double height = 1e9;
  for (const NamedParticle& named : worn.cut.cloth.named_particles) {
    if (named.name.find("/underarm_") == std::string::npos) continue;
    height = std::min(height, worn.stages.final[static_cast<size_t>(named.particle)].y() - kChestBelowUnderarm);
  }
  return height;
}

EaseAtPlace MeasureEase(const std::string& place, const GirthMeasurement& girth, const TriangleMesh& body_surface,
                        const FittedGarment& worn) {
  EaseAtPlace ease;
  ease.place = place;
  ease.height = girth.height;
  ease.body_girth = girth.girth;
  if (girth.girth <= 0.0) {
    ease.note = "the scan gave no " + place + " girth";
    return ease;
  }
  const double height = std::min(girth.height, HighestClosedHeight(worn));
  const GarmentGirth garment =
      MeasureDrapedGirth(worn.cut.cloth, worn.stages.final, height, TorsoAxis(body_surface, height));
  ease.height = height;
  ease.measured = garment.found;
  ease.garment_girth = garment.girth;
  if (!garment.found) ease.note = "the garment does not reach round the " + place;
  return ease;
}

}  // namespace

void DescribeInputs(const BodyInput& body, const Garment& garment, const CutGarment& cut, FitReport& report) {
  report.body = body.name;
  report.body_stature = body.body.measurements.stature;
  report.body_triangle_count = static_cast<int64_t>(body.body.mesh.triangles.size());
  report.body_notes = body.notes;
  report.garment = garment.id;
  report.garment_title = garment.title;
  report.garment_kind = GarmentKindName(garment.kind);
  report.garment_length = garment.length;
  report.euler_characteristic = cut.topology.euler_characteristic();
  report.expected_euler_characteristic = ExpectedEulerCharacteristic(garment.kind);
  report.boundary_loop_count = cut.topology.boundary_loop_count;
  report.penetration.triangle_sample_count = cut.topology.edge_count + cut.topology.triangle_count;
  report.particle_count = static_cast<int>(cut.cloth.rest_positions.size());
  report.triangle_count = static_cast<int>(cut.cloth.triangles.size());
  report.mean_edge_length = MeanEdgeLength(cut.cloth);
  report.notes = cut.notes;
}

namespace {

// Cloth that came to rest is caught where it was torn over the body: an edge is this much longer than at rest (unit: 1)
// or something of it lies so deep in the body (unit: metre). No fabric does that, so that the picture is none of a fit.
constexpr double kTornStrain = 2.0;
constexpr double kTornDepth = 1e-3;

// What to do where cloth does not come to rest: it trembles where it finds no room, most often under an arm.
constexpr const char* kRemedyOfTrembling =
    "; cloth that finds no room trembles, most often between arm and trunk: scan again with arms and legs away from "
    "each other, or try another size";

void DescribeCaught(const DrapeReport& drape, FitReport& report) {
  const bool is_torn = drape.strain_max > kTornStrain || drape.deepest_penetration > kTornDepth;
  if (!is_torn || drape.outcome != DrapeOutcome::kAtRest) return;
  report.finished = false;
  report.finishing_reason = "CAUGHT_ON_BODY";
  char text[240];
  std::snprintf(
      text, sizeof(text),
      "the cloth is caught on the body: somewhere it is stretched to %.1f times its length and %.1f mm deep in "
      "the body; scan again with arms and legs away from each other",
      1.0 + drape.strain_max, 1e3 * drape.deepest_penetration);
  report.finishing_text = text;
}

}  // namespace

void DescribeOutcome(const Dressing& dressed, bool is_bottom, const DrapeOptions& options, FitReport& report) {
  const DrapeReport& drape = dressed.report;
  report.finished = drape.outcome == DrapeOutcome::kAtRest && drape.touching_condition_met;
  switch (drape.outcome) {
    case DrapeOutcome::kAtRest:
      report.finishing_reason = drape.touching_condition_met ? "AT_REST" : "AT_REST_OFF_THE_SHOULDER";
      break;
    case DrapeOutcome::kSeamsOpen:
      report.finishing_reason = "SEAMS_DO_NOT_CLOSE";
      break;
    case DrapeOutcome::kNotAtRest:
      report.finishing_reason = "STEP_LIMIT";
      break;
  }
  report.finishing_text = drape.finishing_reason;
  if (drape.outcome == DrapeOutcome::kNotAtRest) report.finishing_text += kRemedyOfTrembling;
  DescribeCaught(drape, report);
  if (!drape.touching_condition_met) {
    report.warnings.push_back("a shoulder point of the garment hangs " +
                              std::to_string(std::lround(1000.0 * drape.touching_distance_max)) +
                              " mm off the body: the garment may be much too wide for these shoulders");
  }
  report.stages.push_back({"merging",
                           std::to_string(drape.seam_pair_count - drape.open_seam_count) + " of " +
                               std::to_string(drape.seam_pair_count) + " seam pairs closed",
                           drape.merging_substeps});
  if (dressed.bottom) {
    for (const std::string& sentence : dressed.bottom->sentences) report.notes.push_back(sentence);
    report.stages.push_back({"pulled up", std::string(PullEndName(drape.pull_end)), drape.pulling_substeps});
    report.stages.push_back({"belted", "waist held", drape.belting_substeps});
    report.residuals.push_back(
        {"outseams to their length at rest", "outseam_residual", drape.length_residual, options.length_tolerance, "1"});
  }
  if (drape.tugging_substeps > 0) {
    char text[200];
    std::snprintf(text, sizeof(text),
                  "pulled up by %.0f mm at the waist, because it is too narrow for the body where it would hang; cloth "
                  "lies in folds above",
                  1e3 * drape.tugged_way);
    report.notes.push_back(text);
    report.stages.push_back({"pulled up", "waist", drape.tugging_substeps});
  }
  report.stages.push_back({"gravity", std::string(DrapeOutcomeName(drape.outcome)), drape.draping_substeps});
  if (dressed.shoulder_point_count > 0) {
    report.residuals.push_back(
        {"shoulder points to body", "shoulder_distance", drape.touching_distance_max, options.touching_distance, "m"});
  } else if (!is_bottom) {
    report.notes.push_back("every shoulder point of the garment drops to the arm; only rest ended the fit");
  }
  report.residuals.push_back(
      {"speed of 99 % of the particles", "speed_p99", drape.speed_p99, options.rest_speed_of_99_percent, "m/s"});
  report.seams = {drape.seam_pair_count, drape.open_seam_count, drape.seam_gap_mean, drape.seam_gap_p95,
                  drape.final_seam_gap_max};
  if (!drape.openings.empty()) {
    report.seams.lacking_girth = drape.openings.front().lacking_girth;
    report.seams.open_length = drape.openings.front().seam_length;
  }
  report.penetration = {drape.particles_inside, report.penetration.triangle_sample_count, drape.samples_inside,
                        drape.deepest_penetration};
  report.self_crossing_count = drape.self_crossing_count;
  report.strain = {drape.strain_p50, drape.strain_p95, drape.strain_p99, drape.strain_max};
  report.substep_count = drape.merging_substeps + drape.relaxing_substeps + drape.pulling_substeps +
                         drape.belting_substeps + drape.tugging_substeps + drape.draping_substeps;
}

void DescribeTuck(const DrapeReport& tucked, FitReport& report) {
  report.finished = report.finished && tucked.outcome == DrapeOutcome::kAtRest;
  if (tucked.outcome != DrapeOutcome::kAtRest && report.finishing_reason == "AT_REST") {
    report.finishing_reason = "STEP_LIMIT";
    report.finishing_text = tucked.finishing_reason;
    if (tucked.outcome == DrapeOutcome::kNotAtRest) report.finishing_text += kRemedyOfTrembling;
  }
  const int substeps = tucked.belting_substeps + tucked.draping_substeps;
  report.stages.push_back({"tucked in", std::string(DrapeOutcomeName(tucked.outcome)), substeps});
  report.penetration = {tucked.particles_inside, report.penetration.triangle_sample_count, tucked.samples_inside,
                        tucked.deepest_penetration};
  report.self_crossing_count = tucked.self_crossing_count;
  report.strain = {tucked.strain_p50, tucked.strain_p95, tucked.strain_p99, tucked.strain_max};
  report.substep_count += substeps;
}

void DescribeEase(const BodyMeasurements& girths, const TriangleMesh& body_surface, FittedGarment& worn) {
  worn.report.ease = {MeasureEase("bust", girths.bust, body_surface, worn),
                      MeasureEase("waist", girths.waist, body_surface, worn),
                      MeasureEase("hip", girths.hip, body_surface, worn)};
}

}  // namespace fitroom

#include "fit_client/fitting/fit_garment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "fit_client/fit/collision/body_repair.h"
#include "fit_client/fit/measure/garment_girth.h"
#include "fit_client/fit/panels/measure.h"
#include "fit_client/fit/panels/mesh_pattern.h"
#include "fit_client/fit/panels/reconcile.h"
#include "fit_client/fit/panels/topology.h"

namespace fitroom {
namespace {

constexpr int kTShirtEulerCharacteristic = -2;  // A sphere with four openings: 2 - 4.

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
double HighestClosedHeight(const Fit& fit) {
  constexpr double kBelowUnderarm = 0.015;  // (unit: metre)
  double height = 1e9;
  for (const NamedParticle& named : fit.cloth.named_particles) {
    if (named.name.find("/underarm_") == std::string::npos) continue;
    height = std::min(height, fit.stages.final[static_cast<size_t>(named.particle)].y() - kBelowUnderarm);
  }
  return height;
}

EaseAtPlace MeasureEase(const std::string& place, const GirthMeasurement& girth, const Fit& fit) {
  EaseAtPlace ease;
  ease.place = place;
  ease.height = girth.height;
  ease.body_girth = girth.girth;
  if (girth.girth <= 0.0) {
    ease.note = "the scan gave no " + place + " girth";
    return ease;
  }
  const double height = std::min(girth.height, HighestClosedHeight(fit));
  const GarmentGirth garment =
      MeasureDrapedGirth(fit.cloth, fit.stages.final, height, TorsoAxis(fit.body_surface, height));
  ease.height = height;
  ease.measured = garment.found;
  ease.garment_girth = garment.girth;
  if (!garment.found) ease.note = "the garment does not reach round the " + place;
  return ease;
}

double MeanEdgeLength(const ClothMesh& cloth) {
  double sum = 0.0;
  for (const Eigen::Vector3i& triangle : cloth.triangles) {
    for (int k = 0; k < 3; ++k) {
      sum += (cloth.rest_positions[static_cast<size_t>(triangle[k])] -
              cloth.rest_positions[static_cast<size_t>(triangle[(k + 1) % 3])])
                 .norm();
    }
  }
  return cloth.triangles.empty() ? 0.0 : sum / (3.0 * static_cast<double>(cloth.triangles.size()));
}

void DescribeInputs(const BodyInput& body, const Garment& garment, FitReport& report) {
  report.body = body.name;
  report.body_stature = body.body.measurements.stature;
  report.body_triangle_count = static_cast<int64_t>(body.body.mesh.triangles.size());
  report.body_notes = body.notes;
  report.garment = garment.id;
  report.garment_title = garment.title;
  report.garment_kind = GarmentKindName(garment.kind);
  report.garment_length = garment.length;
  report.profile = "standard";
}

void DescribeOutcome(const DressTopResult& dressed, const DrapeOptions& options, FitReport& report) {
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
  if (!drape.touching_condition_met) {
    report.warnings.push_back("a shoulder point of the garment hangs " +
                              std::to_string(std::lround(1000.0 * drape.touching_distance_max)) +
                              " mm off the body: the garment may be much too wide for these shoulders");
  }
  report.stages.push_back({"merging",
                           std::to_string(drape.seam_pair_count - drape.open_seam_count) + " of " +
                               std::to_string(drape.seam_pair_count) + " seam pairs closed",
                           drape.merging_substeps});
  report.stages.push_back({"gravity", std::string(DrapeOutcomeName(drape.outcome)), drape.draping_substeps});
  if (dressed.shoulder_point_count > 0) {
    report.residuals.push_back(
        {"shoulder points to body", "shoulder_distance", drape.touching_distance_max, options.touching_distance, "m"});
  } else {
    report.notes.push_back("every shoulder point of the garment drops to the arm; only rest ended the fit");
  }
  report.residuals.push_back(
      {"speed of 99 % of the particles", "speed_p99", drape.speed_p99, options.rest_speed_of_99_percent, "m/s"});
  report.seams = {drape.seam_pair_count, drape.open_seam_count, drape.seam_gap_mean, drape.seam_gap_p95,
                  drape.final_seam_gap_max};
  report.penetration = {drape.particles_inside, report.penetration.triangle_sample_count, drape.samples_inside,
                        drape.deepest_penetration};
  report.strain = {drape.strain_p50, drape.strain_p95, drape.strain_p99, drape.strain_max};
  report.substep_count = drape.merging_substeps + drape.draping_substeps;
}

}  // namespace

Result<Fit> FitGarment(const BodyInput& body, const GarmentInput& garment, const FitOptions& options,
                       Executor& executor, Stopwatch& stopwatch, const ProgressSink& progress) {
  const auto report_progress = [&progress](std::string_view stage, double done) {
    if (progress) progress(stage, done);
  };
  if (garment.garment.kind != GarmentKind::kTShirt && garment.garment.kind != GarmentKind::kLongSleeve) {
    return Status(StatusCode::kUnimplemented, "KIND_NOT_SUPPORTED",
                  "a " + std::string(GarmentKindName(garment.garment.kind)) +
                      " cannot be fitted yet; tshirt and long_sleeve can");
  }
  Fit fit;
  DescribeInputs(body, garment.garment, fit.report);
  fit.report.thread_count = executor.thread_count();

  report_progress("cutting panels", 0.0);
  FR_ASSIGN_OR_RETURN(const GarmentPattern pattern, ReconcileViews(garment.garment));
  FR_ASSIGN_OR_RETURN(fit.cloth, MeshPattern(pattern, options.pitch));
  const ClothTopology topology = ComputeWeldedTopology(fit.cloth);
  fit.report.euler_characteristic = topology.euler_characteristic();
  fit.report.expected_euler_characteristic = kTShirtEulerCharacteristic;
  fit.report.penetration.triangle_sample_count = topology.edge_count + topology.triangle_count;
  fit.report.boundary_loop_count = topology.boundary_loop_count;
  fit.report.particle_count = static_cast<int>(fit.cloth.rest_positions.size());
  fit.report.triangle_count = static_cast<int>(fit.cloth.triangles.size());
  fit.report.mean_edge_length = MeanEdgeLength(fit.cloth);
  if (pattern.asymmetric_by_design)
    fit.report.notes.push_back("the garment is asymmetric by design; left and right are kept");
  stopwatch.Lap("panels");

  report_progress("preparing the body", 0.02);
  FR_ASSIGN_OR_RETURN(fit.body_surface, RepairBody(body.body.mesh));
  stopwatch.Lap("body without holes");

  const auto dressing = [&](double done) { report_progress("dressing", 0.05 + 0.75 * done); };
  FR_ASSIGN_OR_RETURN(DressTopResult dressed,
                      DressTop(fit.cloth, body.body, fit.body_surface, options.dressing, executor, dressing));
  fit.stages = std::move(dressed.stages);
  stopwatch.Lap("dressing");

  DescribeOutcome(dressed, options.dressing.drape, fit.report);
  const BodyMeasurements& girths = body.body.measurements;
  fit.report.ease = {MeasureEase("bust", girths.bust, fit), MeasureEase("waist", girths.waist, fit),
                     MeasureEase("hip", girths.hip, fit)};
  stopwatch.Lap("measuring");
  return fit;
}

}  // namespace fitroom

#include "body_center/scan/synthetic_scan.h"

#include <cmath>
#include <utility>

#include <nlohmann/json.hpp>

#include "body_center/scan/scan_defects.h"
#include "body_center/scan/surface_nets.h"

namespace fitroom::body_center {
namespace {

// Polygonises with about the asked number of vertices: their number goes with the inverse square of the spacing.
TriangleMesh PolygoniseToCount(const ImplicitSolid& solid, int vertex_count) {
  constexpr double kCoarse = 0.009;  // (unit: metre)
  const double coarse_count = static_cast<double>(PolygoniseSurface(solid, kCoarse).vertices.size());
  return PolygoniseSurface(solid, kCoarse * std::sqrt(coarse_count / vertex_count));
}

nlohmann::json PointJson(const Eigen::Vector3d& point) { return {point.x(), point.y(), point.z()}; }

}  // namespace

Result<SyntheticScan> SynthesizeScan(const BodySpecification& specification, const SyntheticScanOptions& options) {
  FR_ASSIGN_OR_RETURN(const SolvedFigure solved, SolveFigure(specification));
  SyntheticScan scan;
  scan.landmarks = solved.landmarks;
  scan.measurements = solved.measurements;
  scan.shoulder = solved.scale * solved.figure.shoulder;
  scan.elbow = solved.scale * solved.figure.elbow;
  scan.wrist = solved.scale * solved.figure.wrist;
  scan.hip = solved.scale * solved.figure.hip;
  scan.knee = solved.scale * solved.figure.knee;
  scan.ankle = solved.scale * solved.figure.ankle;

  TriangleMesh mesh = PolygoniseToCount(solved.figure.solid, options.target_vertex_count);
  if (!options.is_clean) {
    BodyLandmarks in_figure = solved.landmarks;
    for (LandmarkEstimate& landmark : in_figure.estimates) landmark.position /= solved.scale;
    mesh = AddScanDefects(mesh, in_figure, options.seed);
  }
  scan.texture = PaintScanTexture(mesh, solved.figure.solid, options.seed);
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex *= solved.scale;
  scan.mesh = std::move(mesh);
  return scan;
}

std::string TruthAsJson(const SyntheticScan& scan) {
  nlohmann::json truth;
  truth["frame"] = {{"up", "+y"}, {"facing", "+z"}, {"unit", "metre"}};
  for (int i = 0; i < kBodyLandmarkCount; ++i) {
    const BodyLandmark landmark = static_cast<BodyLandmark>(i);
    if (scan.landmarks[landmark].confidence <= 0.0) continue;
    truth["landmarks"][std::string(LandmarkName(landmark))] = PointJson(scan.landmarks[landmark].position);
  }
  const auto girth = [&truth](const char* name, const GirthMeasurement& measurement) {
    truth["girths_cm"][name] = 100.0 * measurement.girth;
    truth["girth_heights_cm"][name] = 100.0 * measurement.height;
  };
  girth("bust", scan.measurements.bust);
  girth("waist", scan.measurements.waist);
  girth("hip", scan.measurements.hip);
  girth("neck", scan.measurements.neck);
  truth["stature_cm"] = 100.0 * scan.measurements.stature;
  truth["joints_L"] = {{"shoulder", PointJson(scan.shoulder)}, {"elbow", PointJson(scan.elbow)},
                       {"wrist", PointJson(scan.wrist)},       {"hip", PointJson(scan.hip)},
                       {"knee", PointJson(scan.knee)},         {"ankle", PointJson(scan.ankle)}};
  return truth.dump(1) + "\n";
}

}  // namespace fitroom::body_center

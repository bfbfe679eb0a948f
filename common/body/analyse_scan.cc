#include "common/body/analyse_scan.h"

#include <array>
#include <string>

#include "common/body/body_slices.h"
#include "common/body/landmark_search.h"
#include "common/body/plane_section.h"

namespace fitroom {
namespace {

constexpr int kSlabCount = 400;  // About 4 mm each: a section looks at few triangles that it does not cut.

// The landmarks without which no garment can be put on.
constexpr std::array kNeeded = {
    BodyLandmark::kFrontNeck,  BodyLandmark::kAcromionLeft, BodyLandmark::kAcromionRight,
    BodyLandmark::kArmpitLeft, BodyLandmark::kArmpitRight,  BodyLandmark::kCrotch,
};

Status CheckComplete(const Body& body) {
  for (const BodyLandmark landmark : kNeeded) {
    if (body.landmarks[landmark].confidence > 0.0) continue;
    return InvalidArgument("LANDMARKS_NOT_FOUND",
                           "no " + std::string(LandmarkName(landmark)) +
                               " was found; the scan must show a person upright, arms 10 to 60 degrees from the trunk, "
                               "hands off the body, legs apart");
  }
  const BodyMeasurements& measured = body.measurements;
  if (measured.bust.girth > 0.0 && measured.waist.girth > 0.0 && measured.hip.girth > 0.0) return {};
  return InvalidArgument("LANDMARKS_NOT_FOUND",
                         "the trunk has no measurable bust, waist or hip; scan the person again");
}

}  // namespace

Result<BodyAnalysis> AnalyseScan(const TriangleMesh& raw, const FrameOverrides& overrides) {
  BodyAnalysis analysis;
  FR_ASSIGN_OR_RETURN(CleanedScan cleaned, CleanScan(raw));
  FR_ASSIGN_OR_RETURN(DetectedFrame frame, DetectFrame(cleaned.mesh, overrides));
  analysis.cleaning = cleaned.counts;
  analysis.frame = std::move(frame.report);
  analysis.canonical_from_file = frame.canonical_from_file;
  Body& body = analysis.body;
  body.mesh = std::move(cleaned.mesh);
  for (Eigen::Vector3d& p : body.mesh.vertices) p = analysis.canonical_from_file * p;

  const HeightIndex index(body.mesh, kSlabCount);
  FR_ASSIGN_OR_RETURN(const BodySlices slices, SliceBody(index));
  const BodyShape shape{index, slices};
  FindNeckAndShoulders(shape, body.landmarks);
  FindTrunk(shape, body.landmarks, body.measurements);
  const LimbAxes axes = FindLimbs(shape, body.landmarks);
  body.arm_left = axes.arm_left;
  body.arm_right = axes.arm_right;
  body.leg_left = axes.leg_left;
  body.leg_right = axes.leg_right;
  FR_RETURN_IF_ERROR(CheckComplete(body));
  return analysis;
}

}  // namespace fitroom

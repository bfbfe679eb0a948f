#pragma once

#include <cstdint>
#include <string>

#include "body_center/scan/body_specification.h"
#include "body_center/scan/scan_texture.h"
#include "body_center/scan/solved_figure.h"
#include "common/base/status.h"
#include "common/geometry/triangle_mesh.h"

namespace fitroom::body_center {

// How a body is made beyond its measurements.
struct SyntheticScanOptions {
  uint64_t seed = 1;                 // Of noise, dropouts and islands.
  bool is_clean = false;             // Watertight and without noise.
  int target_vertex_count = 123000;  // Met within a few per cent.
};

// A body made from measurements, as a scanner would deliver it, with the truth about it.
struct SyntheticScan {
  TriangleMesh mesh;  // Canonical frame, metres.
  ScanTexture texture;
  BodyLandmarks landmarks;
  BodyMeasurements measurements;
  // Joints of the left side; the right side mirrors them in X (unit: metre).
  Eigen::Vector3d shoulder, elbow, wrist, hip, knee, ankle;
};

// Makes the body. INVALID_ARGUMENT as SolveFigure() returns it. The same input gives the same bytes.
Result<SyntheticScan> SynthesizeScan(const BodySpecification& specification, const SyntheticScanOptions& options);

// Returns the landmarks, girths and joints as JSON, names as in LandmarkName(), lengths in metres in the canonical
// frame.
std::string TruthAsJson(const SyntheticScan& scan);

}  // namespace fitroom::body_center

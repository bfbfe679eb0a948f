#include "tests/support/service/fake_scan.h"

#include <random>

#include "common/codec/hash.h"
#include "common/codec/packed_mesh.h"

namespace fitroom::testing {
namespace {

constexpr std::string_view kMark = "FAKE SCAN\n";

// A number from 0 to 1 made of one byte of the hash.
double Part(const Hash256& hash, size_t place) { return hash.bytes[place % hash.bytes.size()] / 255.0; }

}  // namespace

std::string FakeScanFile(uint32_t seed, size_t size) {
  std::mt19937 random(seed);
  std::string file(kMark);
  while (file.size() < size) {
    const bool repeats = (file.size() >> 10) % 2 == 0;
    file += repeats ? 'x' : static_cast<char>(random());
  }
  file.resize(size);
  return file;
}

ScanUploadStatement StatementOf(const std::string& body, const std::string& scan, const std::string& file) {
  ScanUploadStatement statement;
  statement.name = {body, scan};
  statement.file_name = scan + ".ase";
  statement.size = static_cast<int64_t>(file.size());
  statement.hash = Blake2b(file);
  return statement;
}

Result<body_center::AcceptedScan> FakeAcceptor(std::string_view bytes, std::string_view file_name,
                                               const FrameOverrides& overrides, const std::function<bool()>&) {
  if (!bytes.starts_with(kMark)) {
    return InvalidArgument("NOT_A_SCAN", std::string(file_name) + ":1: does not begin like a scan");
  }
  const Hash256 hash = Blake2b(bytes);
  body_center::AcceptedScan accepted;
  accepted.frame.up = overrides.up ? AxisName(*overrides.up) : "+z";
  accepted.frame.facing = "-y";
  accepted.frame.unit = "cm";
  accepted.frame.tilt_deg = 1.5;
  accepted.frame.yaw_deg = -2.25;
  accepted.frame.reasons = {"up +z: said so", "unit cm: said so"};
  Body& body = accepted.body;
  for (size_t i = 0; i < 30; ++i) body.mesh.vertices.emplace_back(Part(hash, i), Part(hash, i + 1), Part(hash, i + 2));
  for (int i = 0; i < 28; ++i) body.mesh.triangles.emplace_back(i, i + 1, i + 2);
  for (size_t i = 0; i < body.landmarks.estimates.size(); i += 2) {
    body.landmarks.estimates[i] = {{Part(hash, i), 1.0 / 3.0 + Part(hash, i + 1), -Part(hash, i + 2)},
                                   0.1 + Part(hash, i)};
  }
  for (LimbAxis* limb : {&body.arm_left, &body.arm_right, &body.leg_left, &body.leg_right}) {
    limb->root = {Part(hash, 1), 1.25, 0.1};
    limb->joint = {Part(hash, 2), 1.0, 0.2};
    limb->end = {Part(hash, 3), 0.75, 0.3};
  }
  body.measurements = {1.6 + Part(hash, 0), {0.9, 1.2}, {0.7, 1.05}, {0.95, 0.8}, {0.33, 1.4}};
  FR_ASSIGN_OR_RETURN(accepted.packed_mesh, PackMesh(body.mesh));
  accepted.packed_mesh_hash = Blake2b(accepted.packed_mesh);
  return accepted;
}

}  // namespace fitroom::testing

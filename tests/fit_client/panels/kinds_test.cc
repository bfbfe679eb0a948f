#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "fit_client/fit/panels/measure.h"
#include "fit_client/fit/panels/mesh_pattern.h"
#include "fit_client/fit/panels/polyline.h"
#include "fit_client/fit/panels/reconcile.h"
#include "fit_client/fit/panels/topology.h"
#include "tests/fit_client/panels/drawn_kinds.h"

// What every kind of garment has in common, on drawings of all seven.

namespace fitroom {
namespace {

using testing::DrawKind;

GarmentPattern Reconciled(const Garment& garment) {
  Result<GarmentPattern> pattern = ReconcileViews(garment);
  if (!pattern.ok()) throw std::runtime_error(pattern.status().ToString());
  return std::move(pattern).value();
}

ClothMesh Cut(const GarmentPattern& pattern, double pitch) {
  Result<ClothMesh> mesh = MeshPattern(pattern, pitch);
  if (!mesh.ok()) throw std::runtime_error(mesh.status().ToString());
  return std::move(mesh).value();
}

std::vector<GarmentKind> AllKinds() {
  std::vector<GarmentKind> kinds;
  for (int k = 0; k < kGarmentKindCount; ++k) kinds.push_back(static_cast<GarmentKind>(k));
  return kinds;
}

std::string KindName(const ::testing::TestParamInfo<GarmentKind>& info) {
  return std::string(GarmentKindName(info.param));
}

class EveryKind : public ::testing::TestWithParam<GarmentKind> {};

INSTANTIATE_TEST_SUITE_P(Kinds, EveryKind, ::testing::ValuesIn(AllKinds()), KindName);

// The method's table: T-shirt and one-piece are a sphere with four holes, a skirt has two, trousers three.
TEST_P(EveryKind, HasItsHolesOnceSewn) {
  const GarmentPattern pattern = Reconciled(DrawKind(GetParam(), {.tilt_deg = 3}, {.tilt_deg = -2}));
  const int holes = GetParam() == GarmentKind::kSkirt ? 2 : HasLegs(GetParam()) ? 3 : 4;
  for (const double pitch : {0.04, 0.03, 0.02, 0.01}) {
    const ClothTopology sewn = ComputeWeldedTopology(Cut(pattern, pitch));
    EXPECT_EQ(sewn.euler_characteristic(), 2 - holes) << pitch;
    EXPECT_EQ(sewn.boundary_loop_count, holes);
    EXPECT_EQ(sewn.component_count, 1);
    EXPECT_TRUE(sewn.is_manifold);
  }
  EXPECT_EQ(ExpectedEulerCharacteristic(GetParam()), 2 - holes);
}

}  // namespace
}  // namespace fitroom

#include "fit_client/fit/stages/worn_layers.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/fit_client/collision/shapes.h"
#include "tests/fit_client/stages/tube_skirt.h"

namespace fitroom {
namespace {

// A tube of 12 cm radius stands as a skirt round a column of 8 cm.
struct Column {
  Column()
      : body(testing::MakeCylinder(0.08, -0.4, 0.4, 64, 40)), skirt(testing::MakeTubeSkirt(0.377, 0.377, 0.3, 24, 20)) {
    for (size_t i = 0; i < skirt.rest_positions.size(); ++i) {
      const Eigen::Vector3d& rest = skirt.rest_positions[i];
      const double angle = M_PI * (rest.x() / 0.377 + 0.5);  // 0 at the right, pi at the left.
      const double outward = skirt.panel_of_particle[i] == 0 ? 1.0 : -1.0;
      positions.emplace_back(-0.12 * std::cos(angle), rest.y() + 0.15, outward * 0.12 * std::sin(angle));
    }
  }
  TriangleMesh body;
  ClothMesh skirt;
  std::vector<Eigen::Vector3d> positions;
};

// Nothing can be worn between the body and what is worn already: the gap belongs to the layer. Above and below it, and
// outside, the distance is that to the nearer of both.
TEST(WornLayers, TheGapBetweenBodyAndLayerIsInsideAndTheRestIsNot) {
  const Column column;
  SerialExecutor serial;
  const Result<WornGarment> worn = MakeWornGarment(GarmentKind::kSkirt, column.skirt, column.positions);
  ASSERT_TRUE(worn.ok()) << worn.status().ToString();
  const std::vector<WornGarment> layers = {*worn};
  const Eigen::AlignedBox3d reach(Eigen::Vector3d(-0.25, -0.3, -0.25), Eigen::Vector3d(0.25, 0.3, 0.25));
  const Result<SignedDistanceField> field = BuildDressedField(column.body, layers, reach, 0.004, serial);
  ASSERT_TRUE(field.ok()) << field.status().ToString();
  for (int k = 0; k < 36; ++k) {
    const double angle = M_PI * k / 18.0;
    const Eigen::Vector3d out(std::cos(angle), 0.0, std::sin(angle));
    EXPECT_LT(field->Distance(0.10 * out), -0.01) << angle;           // In the gap.
    EXPECT_NEAR(field->Distance(0.13 * out), 0.01, 0.0015) << angle;  // Outside the layer.
    EXPECT_NEAR(field->Distance(0.10 * out + Eigen::Vector3d(0, 0.22, 0)), 0.02, 0.0015) << angle;  // Above it.
    EXPECT_LT(field->Distance(0.06 * out + Eigen::Vector3d(0, 0.22, 0)), 0.0) << angle;             // In the body.
  }
}

TEST(WornLayers, TheOrderDecidesAndWhatNobodyCanWearIsRefusedWithARemedy) {
  const std::vector<WornGarment> pants = {{GarmentKind::kPants, {}}};
  const std::vector<WornGarment> shirt = {{GarmentKind::kTShirt, {}}};
  const std::vector<WornGarment> dress = {{GarmentKind::kOnePiece, {}}};
  EXPECT_TRUE(CheckLayerOrder(GarmentKind::kTShirt, pants).ok());  // Worn over.
  EXPECT_TRUE(CheckLayerOrder(GarmentKind::kPants, shirt).ok());   // Tucked in.
  EXPECT_TRUE(CheckLayerOrder(GarmentKind::kSkirt, pants).ok());
  const Status second = CheckLayerOrder(GarmentKind::kShorts, pants);
  EXPECT_EQ(second.reason(), "LAYER_ORDER");
  EXPECT_NE(second.message().find("take those off"), std::string::npos);
  const Status tucked = CheckLayerOrder(GarmentKind::kPants, dress);
  EXPECT_EQ(tucked.reason(), "LAYER_ORDER");
  EXPECT_NE(tucked.message().find("put the pants on first"), std::string::npos);
}

}  // namespace
}  // namespace fitroom

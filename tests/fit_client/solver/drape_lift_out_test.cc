#include "fit_client/fit/solver/drape_lift_out.h"

#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "tests/fit_client/collision/shapes.h"

namespace fitroom {
namespace {

SignedDistanceField BoxField(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  SerialExecutor serial;
  SignedDistanceFieldOptions options;
  options.region = Eigen::AlignedBox3d(Eigen::Vector3d(-0.08, -0.08, -0.08), Eigen::Vector3d(0.08, 0.08, 0.08));
  return SignedDistanceField::Build(testing::MakeBox(Eigen::AlignedBox3d(low, high), 6), options, serial).value();
}

// One triangle whose particles have the numbers of their corners, and its lifted places.
struct LiftedTriangle {
  explicit LiftedTriangle(const std::array<Eigen::Vector3d, 3>& corners, const SignedDistanceField& body) {
    ClothMesh mesh;
    mesh.rest_positions = {{0.0, 0.0, 0.0}, {0.02, 0.0, 0.0}, {0.0, 0.0, 0.02}};
    mesh.triangles = {{0, 1, 2}};
    const ClothModel model = ClothModel::Create(mesh, {}, {}).value();
    std::vector<Eigen::Vector3d> places(3);
    for (size_t corner = 0; corner < 3; ++corner) {
      places[static_cast<size_t>(model.particle_of_vertex()[corner])] = corners[corner];
    }
    const std::vector<Eigen::Vector3d> lifted = LiftOut(model, body, places);
    for (size_t corner = 0; corner < 3; ++corner) {
      after[corner] = lifted[static_cast<size_t>(model.particle_of_vertex()[corner])];
    }
  }
  std::array<Eigen::Vector3d, 3> after;
};

TEST(LiftOut, GoesStraightOutBesideASharpEdgeAndLeavesAloneWhatIsOutside) {
  // Half a cell from the edge of the box the interpolated gradient leans to the side; the way out is straight up.
  const SignedDistanceField body = BoxField({-0.05, -0.05, -0.05}, {0.05, 0.0, 0.05});
  const std::array<Eigen::Vector3d, 3> corners = {
      Eigen::Vector3d(0.049, -0.0003, 0.0), {0.03, 0.01, 0.0}, {0.04, 0.01, 0.02}};
  const LiftedTriangle lifted(corners, body);
  EXPECT_NEAR(lifted.after[0].x(), 0.049, 1e-7);
  EXPECT_NEAR(lifted.after[0].y(), 2.0 * kLiftedDistance, 1e-7);
  EXPECT_NEAR(lifted.after[0].z(), 0.0, 1e-7);
  EXPECT_EQ(lifted.after[1], corners[1]);
  EXPECT_EQ(lifted.after[2], corners[2]);
}

TEST(LiftOut, MovesTheCornersOfAnEdgeThatLiesAcrossARidge) {
  // The middle of the edge is 1 mm inside, below the top, its corners are outside beyond the sides.
  const SignedDistanceField body = BoxField({-0.05, -0.05, -0.003}, {0.05, 0.0, 0.003});
  const LiftedTriangle lifted({Eigen::Vector3d(0.0, -0.001, -0.01), {0.0, -0.001, 0.01}, {0.0, 0.03, 0.0}}, body);
  for (const int corner : {0, 1}) EXPECT_NEAR(lifted.after[static_cast<size_t>(corner)].y(), 0.0004, 1e-7);
  EXPECT_GE(body.ExactDistance(0.5 * (lifted.after[0] + lifted.after[1])), kLiftedDistance);
  EXPECT_EQ(lifted.after[2], Eigen::Vector3d(0.0, 0.03, 0.0));
}

TEST(LiftOut, LeadsOutOfACreviceThatIsNarrowerThanACell) {
  // A crevice of 0.2 mm between two boxes, open at the top: straight off one wall leads into the other.
  SignedDistanceField body = BoxField({-0.05, -0.05, -0.05}, {-0.0001, 0.0, 0.05});
  body.Unite(BoxField({0.0001, -0.05, -0.05}, {0.05, 0.0, 0.05}));
  const LiftedTriangle lifted({Eigen::Vector3d(0.0002, -0.001, 0.0), {0.0, 0.02, 0.01}, {0.0, 0.02, -0.01}}, body);
  EXPECT_GE(body.ExactDistance(lifted.after[0]), kLiftedDistance);
  EXPECT_GT(lifted.after[0].y(), 0.0);
  EXPECT_NEAR(lifted.after[0].x(), 0.0, 0.002);
}

TEST(LiftOut, KeepsTheRoundThatLeftLeastInsideWhereThereIsNoRoom) {
  // A gap of 0.1 mm between two boxes: the way out of one leads into the other, over and over.
  SignedDistanceField body = BoxField({-0.05, -0.05, -0.05}, {0.05, 0.0, 0.05});
  body.Unite(BoxField({-0.05, 0.0001, -0.05}, {0.05, 0.05, 0.05}));
  const auto at_height = [](double y) {
    return std::array<Eigen::Vector3d, 3>{Eigen::Vector3d(0.0, y, 0.0), {0.02, y, 0.0}, {0.0, y, 0.02}};
  };
  // 0.1 mm inside the lower one: one round later it would be 0.3 mm inside the upper one. Nothing moves.
  const LiftedTriangle shallow(at_height(-0.0001), body);
  for (size_t corner = 0; corner < 3; ++corner) EXPECT_EQ(shallow.after[corner], at_height(-0.0001)[corner]);
  // 2 mm inside: any place beside the gap is better than that, and none is outside.
  const LiftedTriangle deep(at_height(-0.002), body);
  for (const Eigen::Vector3d& place : deep.after) EXPECT_GT(body.ExactDistance(place), -0.001);
}

}  // namespace
}  // namespace fitroom

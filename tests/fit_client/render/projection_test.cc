#include "fit_client/render/projection.h"

#include <gtest/gtest.h>

namespace fitroom::render {
namespace {

Camera MakeCamera(ViewDirection view) {
  return Camera{view, Eigen::AlignedBox3d(Eigen::Vector3d(-0.6, 0.0, -0.2), Eigen::Vector3d(0.6, 1.7, 0.2)), 800, 1200};
}

TEST(Projection, PutsTheMiddleOfTheSubjectInTheMiddleOfEveryPicture) {
  for (const ViewDirection view :
       {ViewDirection::kFront, ViewDirection::kSide, ViewDirection::kBack, ViewDirection::kThreeQuarter}) {
    const Eigen::Vector2d pixel = ProjectToPixel(MakeCamera(view), Eigen::Vector3d(0.0, 0.85, 0.0));
    EXPECT_NEAR(pixel.x(), 400.0, 1e-9) << ViewName(view);
    EXPECT_NEAR(pixel.y(), 600.0, 1e-9) << ViewName(view);
  }
}

TEST(Projection, ShowsEachSideAsAPersonWhoStandsThereSeesIt) {
  const Eigen::Vector3d left_hand(0.5, 0.85, 0.0);  // The body's own left.
  const Eigen::Vector3d nose(0.0, 1.6, 0.1);
  EXPECT_GT(ProjectToPixel(MakeCamera(ViewDirection::kFront), left_hand).x(), 600.0);
  EXPECT_LT(ProjectToPixel(MakeCamera(ViewDirection::kBack), left_hand).x(), 200.0);
  EXPECT_NEAR(ProjectToPixel(MakeCamera(ViewDirection::kSide), left_hand).x(), 400.0, 1e-6);
  EXPECT_LT(ProjectToPixel(MakeCamera(ViewDirection::kSide), nose).x(),
            380.0);  // The body looks to the picture's left.
  EXPECT_LT(ProjectToPixel(MakeCamera(ViewDirection::kThreeQuarter), nose).x(), 390.0);
  EXPECT_LT(ProjectToPixel(MakeCamera(ViewDirection::kFront), nose).y(), 200.0);  // Up is up.
}

TEST(Projection, KeepsEveryCornerOfTheSubjectInThePicture) {
  for (const ViewDirection view : {ViewDirection::kFront, ViewDirection::kSide, ViewDirection::kBack}) {
    const Camera camera = MakeCamera(view);
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d point = camera.subject.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner));
      const Eigen::Vector2d pixel = ProjectToPixel(camera, point);
      EXPECT_TRUE(pixel.x() > 0.0 && pixel.x() < 800.0 && pixel.y() > 0.0 && pixel.y() < 1200.0)
          << ViewName(view) << " " << pixel.transpose();
    }
  }
}

TEST(Projection, DrawsAtOneScaleFromEverySide) {
  const Eigen::Vector3d low(0.0, 0.4, 0.0);
  const Eigen::Vector3d high(0.0, 1.4, 0.0);
  const Camera front = MakeCamera(ViewDirection::kFront);
  const double front_height = ProjectToPixel(front, low).y() - ProjectToPixel(front, high).y();
  EXPECT_NEAR(front_height * ComputeProjection(front).pixel_size, 1.0, 1e-9);
  for (const ViewDirection view : {ViewDirection::kSide, ViewDirection::kBack, ViewDirection::kThreeQuarter}) {
    const Camera camera = MakeCamera(view);
    EXPECT_NEAR(ProjectToPixel(camera, low).y() - ProjectToPixel(camera, high).y(), front_height, 1e-9);
  }
}

}  // namespace
}  // namespace fitroom::render

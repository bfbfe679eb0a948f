#include "fit_client/render/renderer.h"

#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "fit_client/render/projection.h"
#include "tests/fit_client/render/dressed_capsule.h"

namespace fitroom::render {
namespace {

enum class Hue { kRed, kGreen, kBlue, kYellow, kNone };

// Names the pure colour that a pixel was painted with, whatever the light on it.
Hue HueOf(const uint8_t* pixel) {
  const int r = pixel[0];
  const int g = pixel[1];
  const int b = pixel[2];
  constexpr int kClear = 60;
  if (r > g + kClear && r > b + kClear) return Hue::kRed;
  if (g > r + kClear && g > b + kClear) return Hue::kGreen;
  if (b > r + kClear && b > g + kClear) return Hue::kBlue;
  if (r > b + kClear && g > b + kClear) return Hue::kYellow;
  return Hue::kNone;
}

class RendererTest : public ::testing::Test {
 protected:
  Scene MakeScene() const {
    Scene scene;
    scene.body = &capsule_.body;
    scene.garments.push_back({&capsule_.cloth, capsule_.positions, &front_, &back_});
    return scene;
  }
  Camera MakeCamera(ViewDirection view, int width = 200, int height = 300) const {
    return Camera{view, ComputeBounds(capsule_.body.mesh), width, height};
  }
  Image Draw(const Scene& scene, const Camera& camera) const {
    Result<Renderer> renderer = Renderer::Create();
    EXPECT_TRUE(renderer.ok()) << renderer.status().ToString();
    const Result<std::vector<Image>> pictures = renderer->Draw(scene, std::array{camera});
    EXPECT_TRUE(pictures.ok()) << pictures.status().ToString();
    return pictures->front();
  }
  // The hue in the picture where `point` is.
  static Hue HueAt(const Image& image, const Camera& camera, const Eigen::Vector3d& point) {
    const Eigen::Vector2d pixel = ProjectToPixel(camera, point);
    return HueOf(image.at(static_cast<int>(pixel.x()), static_cast<int>(pixel.y())));
  }

  const DressedCapsule capsule_ = MakeDressedCapsule();
  const Image front_ = MakeHalvedImage({220, 20, 20}, {20, 200, 20});
  const Image back_ = MakeHalvedImage({20, 20, 220}, {210, 210, 20});
};

TEST_F(RendererTest, PhotographsAreWhereTheyBelongAndNotMirrored) {
  const Scene scene = MakeScene();
  const Camera front = MakeCamera(ViewDirection::kFront);
  const Image from_front = Draw(scene, front);
  // The left of the front photograph is the wearer's right, which a person before her sees on the left.
  EXPECT_EQ(HueAt(from_front, front, {-0.1, 1.1, 0.2}), Hue::kRed);
  EXPECT_EQ(HueAt(from_front, front, {+0.1, 1.1, 0.2}), Hue::kGreen);
  const Camera back = MakeCamera(ViewDirection::kBack);
  const Image from_back = Draw(scene, back);
  EXPECT_EQ(HueAt(from_back, back, {+0.1, 1.1, -0.2}), Hue::kBlue);
  EXPECT_EQ(HueAt(from_back, back, {-0.1, 1.1, -0.2}), Hue::kYellow);
  // From her left: the front photograph's right beside the back photograph's left.
  const Camera side = MakeCamera(ViewDirection::kSide);
  const Image from_side = Draw(scene, side);
  EXPECT_EQ(HueAt(from_side, side, {0.2, 1.1, +0.1}), Hue::kGreen);
  EXPECT_EQ(HueAt(from_side, side, {0.2, 1.1, -0.1}), Hue::kBlue);
}

TEST_F(RendererTest, TheGarmentCoversTheBodyAndEndsWhereItEnds) {
  const Camera camera = MakeCamera(ViewDirection::kFront, 400, 600);
  const Image picture = Draw(MakeScene(), camera);
  int covered = 0;
  for (double y = kTubeBottom + 0.01; y < kTubeTop - 0.01; y += 0.01) {
    for (double x = -0.19; x < 0.19; x += 0.01) {
      const double z = std::sqrt(kTubeRadius * kTubeRadius - x * x);
      EXPECT_NE(HueAt(picture, camera, {x, y, z}), Hue::kNone) << x << " " << y;
      ++covered;
    }
  }
  EXPECT_GT(covered, 1000);
  EXPECT_EQ(HueAt(picture, camera, {0.0, kTubeBottom - 0.03, kCapsuleRadius}), Hue::kNone);
  EXPECT_EQ(HueAt(picture, camera, {0.0, kTubeTop + 0.03, kCapsuleRadius}), Hue::kNone);
}

TEST_F(RendererTest, NoBackgroundShowsThroughASeam) {
  // Straight at the side seam, where the front photograph ends and the back photograph begins.
  const Camera side = MakeCamera(ViewDirection::kSide, 400, 600);
  const Image picture = Draw(MakeScene(), side);
  for (double y = kTubeBottom + 0.02; y < kTubeTop - 0.02; y += 0.005) {
    const Eigen::Vector2d pixel = ProjectToPixel(side, {kTubeRadius, y, 0.0});
    for (int dx = -3; dx <= 3; ++dx) {
      const uint8_t* colour = picture.at(static_cast<int>(pixel.x()) + dx, static_cast<int>(pixel.y()));
      // Green, blue or the mean of the two; red only comes with body or backdrop.
      EXPECT_LT(colour[0], 80) << y << " " << dx;
    }
  }
}

TEST_F(RendererTest, WhatIsNearerHidesWhatIsFarther) {
  Scene scene = MakeScene();
  // A second garment, all yellow, before the first one: only its far side may be hidden.
  DressedCapsule outer = MakeDressedCapsule();
  for (Eigen::Vector3d& position : outer.positions)
    position = Eigen::Vector3d(1.2 * position.x(), position.y(), 1.2 * position.z());
  const Image yellow = MakeHalvedImage({210, 210, 20}, {210, 210, 20});
  scene.garments.insert(scene.garments.begin(), {&outer.cloth, outer.positions, &yellow, &yellow});
  const Camera front = MakeCamera(ViewDirection::kFront);
  EXPECT_EQ(HueAt(Draw(scene, front), front, {-0.1, 1.1, 0.25}), Hue::kYellow);
  std::swap(scene.garments.front(), scene.garments.back());
  EXPECT_EQ(HueAt(Draw(scene, front), front, {-0.1, 1.1, 0.25}), Hue::kYellow);
}

TEST_F(RendererTest, TheInsideIsADarkerTintOfItsOwnPanel) {
  // Without a body one looks into the tube: raise the front panel away and the back panel's inside is seen.
  Scene scene = MakeScene();
  scene.body = nullptr;
  const Image white = MakeHalvedImage({230, 230, 230}, {230, 230, 230});
  const Image yellow = MakeHalvedImage({210, 210, 20}, {210, 210, 20});
  scene.garments.front().front_texture = &white;
  scene.garments.front().back_texture = &yellow;
  for (size_t i = 0; i < scene.garments.front().positions.size(); ++i) {
    if (capsule_.cloth.panel_of_particle[i] == 0) scene.garments.front().positions[i].y() += 0.7;
  }
  Camera front = MakeCamera(ViewDirection::kFront);
  const Image picture = Draw(scene, front);
  const Eigen::Vector2d pixel = ProjectToPixel(front, {0.0, 1.0, -kTubeRadius});
  const uint8_t* colour = picture.at(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()));
  EXPECT_EQ(HueOf(colour), Hue::kYellow);
  EXPECT_LT(colour[0], 190);
}

TEST_F(RendererTest, PrintColoursStayTrueWhereTheGarmentFacesTheCamera) {
  const Image grey = MakeHalvedImage({180, 120, 60}, {180, 120, 60});
  Scene scene = MakeScene();
  scene.garments.front().front_texture = &grey;
  const Camera front = MakeCamera(ViewDirection::kFront);
  const Image picture = Draw(scene, front);
  const Eigen::Vector2d pixel = ProjectToPixel(front, {0.0, 1.1, kTubeRadius});
  const uint8_t* colour = picture.at(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(colour[c], grey.at(0, 0)[c], 0.08 * 255.0) << c;
  // Whatever the light, the mix of the three stays.
  EXPECT_NEAR(static_cast<double>(colour[1]) / colour[0], 120.0 / 180.0, 0.05);
  EXPECT_NEAR(static_cast<double>(colour[2]) / colour[0], 60.0 / 180.0, 0.05);
}

TEST_F(RendererTest, LinesAreDrawnInTheirColourAndFaintlyThroughTheBody) {
  Scene scene = MakeScene();
  scene.garments.clear();
  const Camera front = MakeCamera(ViewDirection::kFront, 400, 600);
  const Image bare = Draw(scene, front);
  scene.lines.push_back({{-0.3, 1.0, 0.0}, {0.3, 1.0, 0.0}, Colour(0.0F, 0.0F, 1.0F)});
  const Image picture = Draw(scene, front);
  EXPECT_EQ(HueAt(picture, front, {0.27, 1.0, 0.0}), Hue::kBlue);
  const Eigen::Vector2d hidden = ProjectToPixel(front, {0.0, 1.0, 0.0});
  const uint8_t* before = bare.at(static_cast<int>(hidden.x()), static_cast<int>(hidden.y()));
  const uint8_t* after = picture.at(static_cast<int>(hidden.x()), static_cast<int>(hidden.y()));
  EXPECT_GT(after[2] - after[0], before[2] - before[0] + 20);
  EXPECT_NE(HueOf(after), Hue::kBlue);
}

TEST_F(RendererTest, ASeeThroughGarmentLetsTheBodyThrough) {
  Scene scene = MakeScene();
  const Camera front = MakeCamera(ViewDirection::kFront);
  const Image opaque = Draw(scene, front);
  scene.garments.front().opacity = 0.5F;
  const Image clear = Draw(scene, front);
  const Eigen::Vector2d pixel = ProjectToPixel(front, {-0.1, 1.1, 0.19});
  const int x = static_cast<int>(pixel.x());
  const int y = static_cast<int>(pixel.y());
  EXPECT_GT(clear.at(x, y)[1], opaque.at(x, y)[1] + 30);  // The body's green comes through the red.
}

TEST_F(RendererTest, TheSameSceneGivesTheSameBytes) {
  const Scene scene = MakeScene();
  const std::array cameras = {MakeCamera(ViewDirection::kFront), MakeCamera(ViewDirection::kThreeQuarter)};
  Result<Renderer> one = Renderer::Create();
  ASSERT_TRUE(one.ok());
  const Result<std::vector<Image>> first = one->Draw(scene, cameras);
  const Result<std::vector<Image>> again = one->Draw(scene, cameras);
  Result<Renderer> other = Renderer::Create();
  ASSERT_TRUE(other.ok());
  const Result<std::vector<Image>> elsewhere = other->Draw(scene, std::array{cameras[1]});
  ASSERT_TRUE(first.ok() && again.ok() && elsewhere.ok());
  EXPECT_EQ((*first)[0].pixels, (*again)[0].pixels);
  EXPECT_EQ((*first)[1].pixels, (*again)[1].pixels);
  EXPECT_EQ((*first)[1].pixels, (*elsewhere)[0].pixels);
}

TEST_F(RendererTest, ScenesThatCannotBeDrawnAreRefused) {
  Result<Renderer> renderer = Renderer::Create();
  ASSERT_TRUE(renderer.ok());
  const Scene good = MakeScene();
  const Camera camera = MakeCamera(ViewDirection::kFront);
  EXPECT_EQ(renderer->Draw(good, std::array{MakeCamera(ViewDirection::kFront, 0, 10)}).status().reason(),
            "BAD_PICTURE_SIZE");
  EXPECT_EQ(renderer->Draw(good, std::array{MakeCamera(ViewDirection::kFront, 10, 5000)}).status().reason(),
            "BAD_PICTURE_SIZE");
  EXPECT_EQ(renderer->Draw(good, std::array{Camera{}}).status().reason(), "BAD_SUBJECT");
  Scene bad = good;
  bad.garments.front().positions[0].x() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(renderer->Draw(bad, std::array{camera}).status().reason(), "BAD_GARMENT_SHAPE");
  DisplayBody body = capsule_.body;
  body.mesh.triangles[0][0] = -1;
  bad = good;
  bad.body = &body;
  EXPECT_EQ(renderer->Draw(bad, std::array{camera}).status().reason(), "BAD_BODY_SHAPE");
  EXPECT_TRUE(renderer->Draw(good, std::array{camera}).ok());  // And it still draws.
}

}  // namespace
}  // namespace fitroom::render

#include "fit_client/render/garment_surface.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/fit_client/render/dressed_capsule.h"

namespace fitroom::render {
namespace {

TEST(GarmentSurface, NormalsOfATubePointAwayFromItsAxisAlsoAtTheSeams) {
  const DressedCapsule scene = MakeDressedCapsule();
  const std::vector<Eigen::Vector3d> normals = ComputeGarmentNormals(scene.cloth, scene.positions);
  for (size_t i = 0; i < normals.size(); ++i) {
    const Eigen::Vector3d outward(scene.positions[i].x() / kTubeRadius, 0.0, scene.positions[i].z() / kTubeRadius);
    // At the open edges the two triangles of a corner weigh unevenly: half a sector, 2.8 degrees.
    EXPECT_GT(normals[i].dot(outward), std::cos(0.05)) << scene.positions[i].transpose();
  }
  for (const SeamPair& pair : scene.cloth.seams) {
    EXPECT_EQ(normals[static_cast<size_t>(pair.a)], normals[static_cast<size_t>(pair.b)]);
  }
}

TEST(GarmentSurface, AnOpenSeamKeepsTwoNormals) {
  DressedCapsule scene = MakeDressedCapsule();
  for (size_t i = 0; i < scene.positions.size(); ++i) {
    if (scene.cloth.panel_of_particle[i] == 0) scene.positions[i].z() += 0.1;
  }
  const std::vector<int> welded = WeldParticles(scene.cloth, scene.positions);
  for (size_t i = 0; i < welded.size(); ++i) EXPECT_EQ(welded[i], static_cast<int>(i));
}

TEST(GarmentSurface, ThePanelsColourIsThatOfItsClothNotOfItsPrint) {
  const DressedCapsule scene = MakeDressedCapsule();
  Image photograph = MakeHalvedImage({200, 210, 220}, {200, 210, 220});
  for (int y = 20; y < 40; ++y) {
    for (int x = 20; x < 40; ++x) photograph.at(x, y)[0] = photograph.at(x, y)[1] = 0;
  }
  const Colour colour = ComputePanelColour(scene.cloth, 0, &photograph);
  EXPECT_NEAR(colour.x(), 200.0 / 255.0, 1e-6);
  EXPECT_NEAR(colour.y(), 210.0 / 255.0, 1e-6);
  EXPECT_NEAR(colour.z(), 220.0 / 255.0, 1e-6);
}

TEST(GarmentSurface, WhatDoesNotFitTogetherIsRefused) {
  const DressedCapsule scene = MakeDressedCapsule();
  const GarmentShape good{&scene.cloth, scene.positions};
  EXPECT_TRUE(CheckGarmentShape(good).ok());

  GarmentShape bad = good;
  bad.cloth = nullptr;
  EXPECT_EQ(CheckGarmentShape(bad).reason(), "BAD_GARMENT_SHAPE");
  bad = good;
  bad.positions.pop_back();
  EXPECT_EQ(CheckGarmentShape(bad).reason(), "BAD_GARMENT_SHAPE");
  bad = good;
  bad.positions[7].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(CheckGarmentShape(bad).reason(), "BAD_GARMENT_SHAPE");
  ClothMesh cloth = scene.cloth;
  cloth.triangles.back()[2] = static_cast<int>(scene.positions.size());
  bad = good;
  bad.cloth = &cloth;
  EXPECT_EQ(CheckGarmentShape(bad).reason(), "BAD_GARMENT_SHAPE");
  cloth = scene.cloth;
  cloth.seams.push_back({0, -1});
  EXPECT_EQ(CheckGarmentShape(bad).reason(), "BAD_GARMENT_SHAPE");
  const Image broken{10, 10, 3, {}};
  bad = good;
  bad.front_texture = &broken;
  EXPECT_EQ(CheckGarmentShape(bad).reason(), "BAD_GARMENT_SHAPE");
}

}  // namespace
}  // namespace fitroom::render

#include "fit_client/render/pictures.h"

#include <array>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "common/image/decode.h"
#include "fit_client/render/image_scaling.h"
#include "tests/fit_client/render/dressed_capsule.h"

namespace fitroom::render {
namespace {

class PicturesTest : public ::testing::Test {
 protected:
  PicturesTest() {
    request_.body = &capsule_.body;
    request_.cloth = &capsule_.cloth;
    request_.front_texture = &front_;
    std::vector<Eigen::Vector3d> apart = capsule_.positions;
    for (size_t i = 0; i < apart.size(); ++i) apart[i].z() += capsule_.cloth.panel_of_particle[i] == 0 ? 0.2 : -0.2;
    request_.stages = {{"merging", "1 MERGING", apart, true}, {"final", "2 FINAL", capsule_.positions, false}};
  }

  const DressedCapsule capsule_ = MakeDressedCapsule();
  const Image front_ = MakeHalvedImage({20, 160, 20}, {20, 200, 20});
  FitPictureRequest request_;
};

TEST_F(PicturesTest, FourViewsEveryStageAndASheetTheSameForOneThreadAndTwo) {
  request_.thread_count = 1;
  const Result<std::vector<NamedPicture>> one = DrawFitPictures(request_);
  ASSERT_TRUE(one.ok()) << one.status().ToString();
  request_.thread_count = 2;
  const Result<std::vector<NamedPicture>> two = DrawFitPictures(request_);
  ASSERT_TRUE(two.ok()) << two.status().ToString();

  std::set<std::string> names;
  ASSERT_EQ(one->size(), two->size());
  for (size_t i = 0; i < one->size(); ++i) {
    names.insert((*one)[i].file_name);
    EXPECT_EQ((*one)[i].file_name, (*two)[i].file_name);
    EXPECT_TRUE((*one)[i].png == (*two)[i].png) << (*one)[i].file_name;
  }
  EXPECT_EQ(names, (std::set<std::string>{"front.png", "side.png", "back.png", "three_quarter.png", "front_close.png",
                                          "back_close.png", "stage_merging_front.png", "stage_merging_side.png",
                                          "stage_merging_back.png", "stage_final_front.png", "stage_final_side.png",
                                          "stage_final_back.png", "stages.png"}));
}

TEST_F(PicturesTest, MergingShowsStitchLinesAcrossTheBodyAndFinalShowsNone) {
  const Result<std::vector<NamedPicture>> pictures = DrawFitPictures(request_);
  ASSERT_TRUE(pictures.ok());
  const auto count_red = [&](const std::string& name) {
    for (const NamedPicture& picture : *pictures) {
      if (picture.file_name != name) continue;
      const Result<Image> image = DecodeImage(picture.png);
      if (!image.ok()) return -1;
      int count = 0;
      for (size_t i = 0; i + 2 < image->pixels.size(); i += 3) {
        const uint8_t* p = image->pixels.data() + i;
        if (p[0] > 170 && p[1] < 110 && p[2] < 110) ++count;
      }
      return count;
    }
    return -1;
  };
  // From the side both seams lie across the body: 30 lines of 40 cm. Nothing else in the scene is red.
  EXPECT_GT(count_red("stage_merging_side.png"), 1000);
  EXPECT_EQ(count_red("stage_final_side.png"), 0);
}

TEST_F(PicturesTest, WhatCannotBeDrawnIsRefused) {
  FitPictureRequest bad = request_;
  bad.stages.clear();
  EXPECT_EQ(DrawFitPictures(bad).status().reason(), "BAD_PICTURE_REQUEST");
  bad = request_;
  bad.body = nullptr;
  EXPECT_EQ(DrawFitPictures(bad).status().reason(), "BAD_PICTURE_REQUEST");
  bad = request_;
  bad.stages.front().positions.pop_back();
  EXPECT_EQ(DrawFitPictures(bad).status().reason(), "BAD_PICTURE_REQUEST");
  bad = request_;
  bad.stages.front().positions.front().z() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(DrawFitPictures(bad).status().reason(), "BAD_PICTURE_REQUEST");
}

TEST(Sheet, HoldsEveryPictureAndItsLabels) {
  const auto plain = [](uint8_t grey) { return Image{100, 60, 3, std::vector<uint8_t>(100 * 60 * 3, grey)}; };
  const Image sheet = ComposeSheet({{plain(10), plain(20)}, {plain(30), plain(40)}}, {"a", "b"}, {"one", "two"});
  std::array<int, 256> counts = {};
  for (size_t i = 0; i < sheet.pixels.size(); i += 3) ++counts[sheet.pixels[i]];
  // Each picture is there but for the strokes of its row's label.
  EXPECT_GT(counts[10], 5700);
  EXPECT_GE(counts[20], 6000);
  EXPECT_GT(counts[30], 5700);
  EXPECT_GE(counts[40], 6000);
  int dark = 0;  // The column labels, above the pictures.
  for (int y = 0; y < 46; ++y) {
    for (int x = 0; x < sheet.width; ++x) dark += sheet.at(x, y)[0] < 128 ? 1 : 0;
  }
  EXPECT_GT(dark, 100);
}

TEST(ImageScaling, HalvingTakesTheMeanOfFour) {
  Image image{4, 2, 1, {0, 10, 100, 100, 20, 30, 100, 104}};
  const Image half = HalveImage(image);
  EXPECT_EQ(half.width, 2);
  EXPECT_EQ(half.height, 1);
  EXPECT_EQ(half.pixels, (std::vector<uint8_t>{15, 101}));
}

}  // namespace
}  // namespace fitroom::render

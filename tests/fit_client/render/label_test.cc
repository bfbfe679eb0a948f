#include "fit_client/render/label.h"

#include <string>

#include <gtest/gtest.h>

namespace fitroom::render {
namespace {

Image MakeWhite(int width, int height) {
  return Image{width, height, 3,
               std::vector<uint8_t>(static_cast<size_t>(width) * static_cast<size_t>(height) * 3, 255)};
}

bool IsDark(const Image& image, int x, int y) { return image.at(x, y)[0] < 150; }

TEST(Label, DrawsLettersAsTheyAreReadAndNotMirrored) {
  Image image = MakeWhite(60, 60);
  LabelStyle style;
  style.height = 30.0;
  style.stroke_width = 4.0;
  DrawLabel(image, "L", 10.0, 10.0, style);
  EXPECT_TRUE(IsDark(image, 10, 25));   // The stem, on the left.
  EXPECT_TRUE(IsDark(image, 25, 40));   // The foot, below.
  EXPECT_FALSE(IsDark(image, 29, 20));  // Nothing top right.
}

TEST(Label, EveryLetterLeavesInkAndNoTwoLettersAreAlike) {
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ123456789.-/:()%+";
  std::vector<std::vector<uint8_t>> drawn;
  for (const char letter : letters) {
    Image image = MakeWhite(40, 40);
    DrawLabel(image, std::string(1, letter), 8.0, 8.0, {.height = 24.0, .stroke_width = 2.0});
    EXPECT_NE(image.pixels, MakeWhite(40, 40).pixels) << letter;
    for (size_t i = 0; i < drawn.size(); ++i) EXPECT_NE(drawn[i], image.pixels) << letters[i] << letter;
    drawn.push_back(image.pixels);
  }
}

TEST(Label, StaysInsideTheImage) {
  Image image = MakeWhite(20, 10);
  DrawLabel(image, "WIDER THAN THE IMAGE", -7.0, -3.0);
  DrawLabel(image, "BELOW", 0.0, 500.0);
  EXPECT_EQ(image.pixels.size(), 600U);
}

TEST(Label, WidthGrowsWithTheText) {
  EXPECT_EQ(MeasureLabel(""), 0.0);
  EXPECT_NEAR(MeasureLabel("AB", {.height = 6.0}), 10.0, 1e-12);  // Two letters 4 wide, 2 between them.
}

}  // namespace
}  // namespace fitroom::render

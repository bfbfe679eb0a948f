#include "common/garment/polygon.h"

#include <gtest/gtest.h>

namespace fitroom {
namespace {

const Polygon kSquare = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};  // Clockwise on the screen: y points down.

TEST(Polygon, AreaIsPositiveClockwiseOnTheScreen) {
  EXPECT_DOUBLE_EQ(SignedArea(kSquare), 100.0);
  EXPECT_DOUBLE_EQ(SignedArea({kSquare.rbegin(), kSquare.rend()}), -100.0);
  EXPECT_DOUBLE_EQ(Perimeter(kSquare), 40.0);
}

TEST(Polygon, NearestPlaceAndPlaceAtAgree) {
  const OutlinePlace place = NearestPlace(kSquare, {13, 4});
  EXPECT_EQ(place.edge, 1u);
  EXPECT_DOUBLE_EQ(place.arc_length, 14.0);
  EXPECT_DOUBLE_EQ(place.distance, 3.0);
  EXPECT_EQ(PlaceAt(kSquare, 14.0).pixel, Eigen::Vector2d(10, 4));
  EXPECT_EQ(PlaceAt(kSquare, -1.0).pixel, Eigen::Vector2d(0, 1));
  EXPECT_EQ(PlaceAt(kSquare, 81.0).pixel, Eigen::Vector2d(1, 0));
}

TEST(Polygon, CrossingsTouchesAndFoldsAreFound) {
  EXPECT_FALSE(FindCrossing(kSquare).has_value());
  EXPECT_TRUE(FindCrossing({{0, 0}, {10, 10}, {10, 0}, {0, 10}}).has_value());              // Bow tie.
  EXPECT_TRUE(FindCrossing({{0, 0}, {10, 0}, {10, 10}, {5, 0}, {0, 10}}).has_value());      // A corner on an edge.
  EXPECT_TRUE(FindCrossing({{0, 0}, {10, 0}, {5, 0}, {5, 10}}).has_value());                // Folds back.
  EXPECT_TRUE(FindCrossing({{0, 0}, {10, 0}, {10, 0}, {10, 10}, {0, 10}}).has_value());     // A point twice.
  EXPECT_FALSE(FindCrossing({{0, 0}, {10, 0}, {10, 10}, {5, 1e-9}, {0, 10}}).has_value());  // Just not touching.
}

}  // namespace
}  // namespace fitroom

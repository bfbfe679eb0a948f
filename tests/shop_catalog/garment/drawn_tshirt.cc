#include "tests/shop_catalog/garment/drawn_tshirt.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace fitroom::testing {
namespace {

struct Corner {
  const char* name;  // On the image's right of a front view.
  double across;     // Part of the height, from the middle.
  double down;       // Part of the height, from the neck ends.
};

// The right half of the silhouette below the neck: a common crew-neck T-shirt.
constexpr Corner kHalf[] = {
    {"P2", 0.130, 0.000},         {"", 0.30, 0.055}, {"e4", 0.520, 0.220},    {"sleeve_bottom_L", 0.455, 0.365},
    {"underarm_L", 0.345, 0.335}, {"", 0.335, 0.60}, {"hem_L", 0.345, 1.000},
};
constexpr double kBackNeckDepth = 0.03;    // Of the back neckline below the neck ends, part of the height.
constexpr double kFrontNeckDepth = 0.125;  // Of the front's.

// Part of each pixel that a polygon covers, from a grid of 3 x 3 samples, row by row.
std::vector<double> Coverage(const Polygon& polygon, int side) {
  std::vector<double> coverage(static_cast<size_t>(side) * static_cast<size_t>(side), 0.0);
  for (int row = 0; row < 3 * side; ++row) {
    const double y = (row + 0.5) / 3.0;
    std::vector<double> crossings;
    for (size_t i = 0; i < polygon.size(); ++i) {
      const Eigen::Vector2d& a = polygon[i];
      const Eigen::Vector2d& b = polygon[(i + 1) % polygon.size()];
      if ((a.y() > y) != (b.y() > y)) crossings.push_back((b.x() - a.x()) * (y - a.y()) / (b.y() - a.y()) + a.x());
    }
    std::sort(crossings.begin(), crossings.end());
    for (size_t k = 0; k + 1 < crossings.size(); k += 2) {
      const int first = std::max(0, static_cast<int>(std::ceil(3.0 * crossings[k] - 0.5)));
      const int last = std::min(3 * side - 1, static_cast<int>(std::floor(3.0 * crossings[k + 1] - 0.5)));
      for (int i = first; i <= last; ++i) coverage[static_cast<size_t>(row / 3 * side + i / 3)] += 1.0 / 9.0;
    }
  }
  return coverage;
}

// A neckline from the left neck end to the right one as half an ellipse of a depth.
Polygon NeckCurve(double depth) {
  Polygon curve;
  for (int i = 1; i < 24; ++i) {
    const double angle = std::numbers::pi * (1.0 - i / 24.0);
    curve.push_back({kHalf[0].across * std::cos(angle), depth * std::sin(angle)});
  }
  return curve;
}

}  // namespace

DrawnTShirt DrawTShirt(const DrawnTShirtOptions& options) {
  DrawnTShirt drawn;
  drawn.length_px = options.height;
  const double tilt = options.tilt_deg * std::numbers::pi / 180.0;
  Eigen::Matrix2d turn;
  turn << std::cos(tilt), -std::sin(tilt), std::sin(tilt), std::cos(tilt);
  const Eigen::Vector2d centre = Eigen::Vector2d::Constant(0.5 * options.image_side) + options.shift;
  const auto place = [&](const Eigen::Vector2d& p) {
    const Eigen::Vector2d scaled(p.x() * options.width_scale, p.y() - 0.5);
    return Eigen::Vector2d(centre + turn * (options.height * scaled));
  };

  const Polygon back_neck = NeckCurve(kBackNeckDepth);
  const Polygon front_neck = NeckCurve(kFrontNeckDepth);
  const bool front = options.side == GarmentSide::kFront;
  drawn.points["neck_drop"] = place({0.0, front ? kFrontNeckDepth : kBackNeckDepth});
  for (const Eigen::Vector2d& p : back_neck) drawn.silhouette.push_back(place(p));
  for (const Corner& corner : kHalf) {
    drawn.silhouette.push_back(place({corner.across, corner.down}));
    if (corner.name[0] == '\0') continue;
    // The image's right is the wearer's left on a front view and the wearer's right on a back view.
    const std::string name = front ? corner.name : TwinPointName(GarmentKind::kTShirt, corner.name);
    drawn.points[name] = place({corner.across, corner.down});
    drawn.points[TwinPointName(GarmentKind::kTShirt, name)] = place({-corner.across, corner.down});
  }
  for (size_t i = std::size(kHalf); i > 0; --i)
    drawn.silhouette.push_back(place({-kHalf[i - 1].across, kHalf[i - 1].down}));

  Polygon inside_neck;  // Between the back neckline and the front one.
  for (const Eigen::Vector2d& p : back_neck) inside_neck.push_back(place(p));
  for (size_t i = front_neck.size(); i > 0; --i) inside_neck.push_back(place(front_neck[i - 1]));

  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, std::max(1e-9, options.noise));
  drawn.photo = MakeImage(options.image_side, options.image_side, options.with_alpha ? 4 : 3);
  const Eigen::Vector2d shadow_centre = place({0.0, 1.10});
  const std::vector<double> covered = Coverage(drawn.silhouette, options.image_side);
  const std::vector<double> neck_covered = Coverage(front ? inside_neck : Polygon(), options.image_side);
  for (int y = 0; y < options.image_side; ++y) {
    for (int x = 0; x < options.image_side; ++x) {
      const double coverage = covered[static_cast<size_t>(y * options.image_side + x)];
      const double neck = neck_covered[static_cast<size_t>(y * options.image_side + x)];
      double ground = options.texture * std::sin(0.35 * x + 0.05 * y);
      if (options.shadow) {
        const double dx = (x - shadow_centre.x()) / (0.35 * options.height);
        const double dy = (y - shadow_centre.y()) / (0.035 * options.height);
        ground -= 90.0 * std::exp(-dx * dx - dy * dy);
      }
      // Soft folds across the cloth.
      const double fold = 8.0 * std::sin(0.045 * x + 0.02 * y) * std::sin(0.03 * y);
      for (size_t c = 0; c < 3; ++c) {
        const double cloth = neck * options.inside[c] + (1.0 - neck) * (options.cloth[c] + fold);
        const double value = coverage * cloth + (1.0 - coverage) * (options.background[c] + ground) + noise(random);
        drawn.photo.at(x, y)[c] = static_cast<uint8_t>(std::clamp(value, 0.0, 255.0));
      }
      if (options.with_alpha) drawn.photo.at(x, y)[3] = static_cast<uint8_t>(255.0 * coverage);
    }
  }
  return drawn;
}

Image DrawShape(const Polygon& polygon, int image_side, const Colour& cloth, const Colour& background) {
  Image image = MakeImage(image_side, image_side, 3);
  std::mt19937 random(11);
  std::normal_distribution<double> noise(0.0, 2.0);
  const std::vector<double> covered = Coverage(polygon, image_side);
  for (int y = 0; y < image_side; ++y) {
    for (int x = 0; x < image_side; ++x) {
      const double coverage = covered[static_cast<size_t>(y * image_side + x)];
      for (size_t c = 0; c < 3; ++c) {
        const double value = coverage * cloth[c] + (1.0 - coverage) * background[c] + noise(random);
        image.at(x, y)[c] = static_cast<uint8_t>(std::clamp(value, 0.0, 255.0));
      }
    }
  }
  return image;
}

}  // namespace fitroom::testing

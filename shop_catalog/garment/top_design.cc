#include "shop_catalog/garment/garment_design.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace fitroom::shop_catalog {
namespace {

using Eigen::Vector2d;

constexpr double kBand = 1.9;       // Width of the neck's rib (unit: centimetre).
constexpr double kHemHeight = 2.2;  // From the edge to the stitches (unit: centimetre).

struct Palette {
  Rgb cloth, second, rib, thread, ink, ink_light;
  double mottle = 0.02;
};

Palette PaletteOf(const PhotographOptions& options) {
  Palette palette;
  if (options.design == TopDesign::kHeather) {
    palette = {Rgb(104, 132, 146),
               Rgb(104, 132, 146),
               Rgb(92, 119, 133),
               Rgb(70, 92, 106),
               Rgb(208, 96, 58),
               Rgb(240, 228, 206),
               0.065};
  } else {
    palette = {Rgb(44, 58, 96),
               Rgb(122, 160, 178),
               Rgb(40, 52, 88),
               Rgb(120, 130, 160),
               Rgb(186, 52, 52),
               Rgb(226, 220, 208),
               0.028};
  }
  if (options.colour) {
    palette.cloth = Rgb((*options.colour)[0], (*options.colour)[1], (*options.colour)[2]);
    if (options.design == TopDesign::kHeather) palette.second = palette.cloth;
    palette.rib = 0.9F * palette.cloth;
    palette.thread = 0.72F * palette.cloth;
  }
  return palette;
}

// Says on which part of the garment a place lies: beyond the armhole is the sleeve.
bool IsOnSleeve(const GarmentShape& shape, const Vector2d& place) {
  const Vector2d at(std::abs(place.x()), place.y());
  if (at.y() > shape.armhole.back().y() && at.x() < shape.armhole.back().x()) return false;
  const auto nearest = std::min_element(
      shape.armhole.begin(), shape.armhole.end(),
      [&at](const Vector2d& a, const Vector2d& b) { return std::abs(a.y() - at.y()) < std::abs(b.y() - at.y()); });
  return at.x() > nearest->x();
}

// Stripes run across the trunk and round the sleeves.
GarmentCanvas::Cloth MakeCloth(const GarmentShape& shape, const PhotographOptions& options, const Palette& palette) {
  if (options.design == TopDesign::kHeather) {
    return [&palette](const Vector2d&) { return palette.cloth; };
  }
  return [&shape, &palette](const Vector2d& place) -> Rgb {
    constexpr double kPitch = 3.4, kStripe = 1.1, kEdge = 0.06;  // (unit: centimetre)
    // The turned-up hem is cut along the stripes.
    if (place.y() > shape.hem.back().y() - kHemHeight - 0.4) return palette.cloth;
    double along = place.y() - 1.0;
    if (IsOnSleeve(shape, place)) {
      along = (Vector2d(std::abs(place.x()), place.y()) - shape.sleeve_end.front()).dot(shape.sleeve_axis) - 2.2;
    }
    const double phase = along - kPitch * std::floor(along / kPitch);
    const double inside = std::min(phase, kStripe - phase);
    const float amount = static_cast<float>(std::clamp(inside / kEdge + 0.5, 0.0, 1.0));
    return palette.cloth + amount * (palette.second - palette.cloth);
  };
}

// An emblem that looks different in a mirror: a disc with a steep hill on one side, a sun on the other, and bars that
// start on the wearer's right.
void DrawEmblem(const Vector2d& centre, double radius, const Palette& palette, GarmentCanvas& canvas) {
  const auto at = [&](double x, double y) -> Vector2d { return centre + radius * Vector2d(x, y); };
  canvas.FillInk(Circle(centre, radius), palette.ink);
  canvas.FillInk(Circle(at(0.36, -0.42), 0.2 * radius), palette.ink_light);
  canvas.FillInk(Polygonal({at(-0.86, 0.42), at(-0.30, -0.50), at(-0.02, -0.06), at(0.16, -0.26), at(0.86, 0.42)}),
                 palette.ink_light);
  canvas.FillInk(Polygonal({at(-0.30, -0.50), at(-0.02, -0.06), at(-0.13, 0.42), at(-0.42, 0.42)}),
                 0.8F * palette.cloth);
  const double bar = 0.13 * radius;
  canvas.FillInk(Rectangle(centre.x() - radius, centre.y() + 1.18 * radius, 2.0 * radius, bar), palette.ink_light);
  canvas.FillInk(Rectangle(centre.x() - radius, centre.y() + 1.42 * radius, 1.4 * radius, bar), palette.ink);
  canvas.FillInk(Rectangle(centre.x() - radius, centre.y() + 1.66 * radius, 0.8 * radius, bar), palette.ink_light);
}

void DrawPrint(const GarmentShape& shape, GarmentSide side, const PhotographOptions& options, const Palette& palette,
               GarmentCanvas& canvas) {
  const double half_chest = shape.armhole.back().x();
  if (options.design == TopDesign::kHeather) {
    if (side == GarmentSide::kFront) {
      DrawEmblem({0.0, shape.armhole.back().y() + 1.0}, 0.33 * half_chest, palette, canvas);
    } else {
      canvas.FillInk(Rectangle(-0.5 * half_chest, 9.5, half_chest, 0.9), palette.ink);
      canvas.FillInk(Rectangle(-0.5 * half_chest, 11.2, 0.6 * half_chest, 0.9), palette.ink_light);
    }
    return;
  }
  if (side == GarmentSide::kBack) {
    // A tab below the neck, towards the wearer's right.
    canvas.FillInk(Rectangle(2.0, 4.6, 2.6, 1.3), palette.ink);
    return;
  }
  // A pocket on the wearer's left, which is on the image's right.
  const double x = 0.28 * half_chest, y = 16.5;
  const std::vector<Vector2d> corners = {{x, y}, {x + 9.0, y}, {x + 9.0, y + 8.6}, {x + 4.5, y + 10.4}, {x, y + 8.6}};
  FlatCurve edge = Polygonal(corners);
  canvas.FillCloth(
      edge, [&palette](const Vector2d&) { return palette.cloth; }, palette.mottle);
  edge.push_back(edge.front());
  canvas.DrawSeams({edge}, 0.18, 0.35);
  canvas.DrawStitches({{x + 0.4, y + 1.5}, {x + 8.6, y + 1.5}}, palette.second);
  canvas.FillInk(Rectangle(x - 0.1, y + 5.0, 1.1, 1.9), palette.ink);
}

// Ribs run across the band.
void DrawNeckBand(const FlatCurve& neckline, const Palette& palette, double light, GarmentCanvas& canvas) {
  const FlatCurve seam = Offset(neckline, kBand);
  canvas.FillCloth(
      Between(neckline, seam), [&palette](const Vector2d&) { return palette.rib; }, 0.5 * palette.mottle, light);
  std::vector<FlatCurve> ribs;
  double walked = 0.0;
  for (size_t i = 1; i < neckline.size(); ++i) {
    const double length = (neckline[i] - neckline[i - 1]).norm();
    for (; walked < length; walked += 0.26) {
      const double t = walked / length;
      ribs.push_back(
          {neckline[i - 1] + t * (neckline[i] - neckline[i - 1]), seam[i - 1] + t * (seam[i] - seam[i - 1])});
    }
    walked -= length;
  }
  canvas.DrawSeams(ribs, 0.05, 0.22);
  canvas.DrawSeams({seam}, 0.14, 0.32);
  canvas.DrawStitches(Offset(neckline, kBand + 0.3), palette.thread);
  canvas.DrawSeams({neckline}, 0.1, 0.25);
}

void DrawSeams(const GarmentShape& shape, const Palette& palette, GarmentCanvas& canvas) {
  for (const bool mirrored : {false, true}) {
    const auto on_side = [mirrored](const FlatCurve& curve) { return mirrored ? Mirror(curve) : curve; };
    canvas.DrawSeams({on_side(shape.armhole)}, 0.16, 0.30);
    FlatCurve cuff = Offset(shape.sleeve_end, kHemHeight - 0.2);
    // The ends of the parallel curve reach beyond the sleeve's edges.
    cuff.erase(cuff.begin(), cuff.begin() + 2);
    cuff.erase(cuff.end() - 2, cuff.end());
    canvas.DrawStitches(on_side(cuff), palette.thread);
    canvas.DrawSeams({on_side(shape.sleeve_end)}, 0.12, 0.3);
  }
  DrawHem(shape.hem, kHemHeight, palette.thread, canvas);
}

}  // namespace

void DrawTop(const GarmentShape& shape, GarmentSide side, const PhotographOptions& options, GarmentCanvas& canvas) {
  const Palette palette = PaletteOf(options);
  const bool is_front = side == GarmentSide::kFront;
  const FlatCurve& neckline = is_front ? shape.front_neckline : shape.back_neckline;
  if (is_front) DrawInsideOfNeck(shape, palette.cloth, palette.rib, kBand, palette.mottle, canvas);
  // The panel: the outline with its back neckline replaced by this side's.
  FlatCurve panel = neckline;
  panel.insert(panel.end(), shape.outline.begin() + static_cast<std::ptrdiff_t>(shape.back_neckline.size()),
               shape.outline.end());
  canvas.FillCloth(panel, MakeCloth(shape, options, palette), palette.mottle);
  DrawPrint(shape, side, options, palette, canvas);
  DrawSeams(shape, palette, canvas);
  DrawNeckBand(neckline, palette, 1.0, canvas);
}

}  // namespace fitroom::shop_catalog

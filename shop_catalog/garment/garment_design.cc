#include "shop_catalog/garment/garment_design.h"

#include <algorithm>
#include <cmath>

#include <opencv2/core.hpp>

namespace fitroom::shop_catalog {
namespace {

using Eigen::Vector2d;

// Folds one by one, from a seeded generator.
class FoldMaker {
 public:
  explicit FoldMaker(uint64_t seed) : random_(seed * 7919 + 3) {}

  double Uniform(double low, double high) { return random_.uniform(low, high); }
  double Sign() { return random_.uniform(0.0, 1.0) < 0.5 ? -1.0 : 1.0; }
  // `angle` of the fold's line; lengths in cm.
  void Add(const Vector2d& middle, double angle, double length, double width, double height) {
    folds_.push_back({middle, Vector2d(std::cos(angle), std::sin(angle)), length, width, height});
  }
  std::vector<Fold> Take() { return std::move(folds_); }

 private:
  cv::RNG random_;
  std::vector<Fold> folds_;
};

void FoldTop(const GarmentShape& shape, FoldMaker& maker) {
  const Vector2d underarm = shape.armhole.back();
  const double sleeve = shape.sleeve_end.empty() ? 0.0 : (shape.sleeve_end.front() - shape.armhole.front()).norm();
  for (const double side : {-1.0, 1.0}) {
    for (int i = 0; i < 4; ++i) {
      const double angle = side * maker.Uniform(0.5, 1.25);
      const Vector2d start(side * (underarm.x() - maker.Uniform(2.5, 7.0)), underarm.y() + maker.Uniform(-3.0, 9.0));
      const double length = maker.Uniform(4.0, 9.0), width = maker.Uniform(0.7, 1.5);
      maker.Add(start, angle, length, width, maker.Sign() * maker.Uniform(0.15, 0.4));
    }
    const Vector2d inwards(-shape.sleeve_axis.y(), shape.sleeve_axis.x());
    for (int i = 0; i < static_cast<int>(sleeve / 6.0); ++i) {
      const Vector2d middle = shape.armhole.front() + maker.Uniform(0.15, 0.75) * sleeve * shape.sleeve_axis +
                              maker.Uniform(2.0, 11.0) * inwards;
      const double angle = side * (std::atan2(inwards.y(), inwards.x()) + maker.Uniform(-0.9, 0.5));
      const double length = maker.Uniform(3.0, 6.0), width = maker.Uniform(0.6, 1.2);
      maker.Add({side * middle.x(), middle.y()}, angle, length, width, maker.Sign() * maker.Uniform(0.1, 0.28));
    }
  }
}

void FoldLegs(const GarmentShape& shape, FoldMaker& maker) {
  const double crotch = shape.inseam.front().y();
  for (const double side : {-1.0, 1.0}) {
    // Whiskers from the crotch outwards and up.
    for (int i = 0; i < 5; ++i) {
      const Vector2d middle(side * maker.Uniform(3.0, 9.0), crotch + maker.Uniform(-6.0, 5.0));
      const double angle = -side * maker.Uniform(0.15, 0.7), length = maker.Uniform(4.0, 8.0);
      maker.Add(middle, angle, length, maker.Uniform(0.5, 1.0), maker.Sign() * maker.Uniform(0.12, 0.3));
    }
    // Creases across the knee and above the hem.
    for (int i = 0; i < 9; ++i) {
      const double part = maker.Uniform(0.15, 0.95), height = crotch + part * (shape.length - crotch);
      const double inner = AtHeight(shape.inseam, height).x(), outer = AtHeight(shape.side, height).x();
      const Vector2d middle(side * (inner + maker.Uniform(0.2, 0.8) * (outer - inner)), height);
      const double length = maker.Uniform(3.0, 8.0), angle = maker.Uniform(-0.5, 0.5) + (i % 3 == 0 ? 1.4 : 0.0);
      maker.Add(middle, angle, length, maker.Uniform(0.6, 1.4), maker.Sign() * maker.Uniform(0.1, 0.3));
    }
  }
}

// Long soft folds that fall from the waist or the hip to the hem.
void FoldSkirt(const GarmentShape& shape, double top, FoldMaker& maker) {
  for (int i = 0; i < 8; ++i) {
    const double part = maker.Uniform(-0.85, 0.85);
    const double height = top + maker.Uniform(0.45, 0.95) * (shape.length - top);
    const double fan = part * 0.16, length = maker.Uniform(0.25, 0.5) * (shape.length - top);
    maker.Add({part * AtHeight(shape.side, height).x(), height}, 1.5708 - fan, length, maker.Uniform(1.0, 2.4),
              maker.Sign() * maker.Uniform(0.16, 0.42));
  }
}

void FoldAnywhere(double half_width, double top, double bottom, int count, FoldMaker& maker) {
  for (int i = 0; i < count; ++i) {
    const double x = maker.Uniform(-0.85, 0.85) * half_width;
    const Vector2d middle(x, maker.Uniform(top, bottom));
    const double angle = maker.Uniform(1.0, 2.1), length = maker.Uniform(5.0, 13.0);
    maker.Add(middle, angle, length, maker.Uniform(0.9, 2.2), maker.Sign() * maker.Uniform(0.12, 0.36));
  }
}

}  // namespace

std::vector<Fold> MakeFolds(const GarmentShape& shape, uint64_t seed) {
  FoldMaker maker(seed);
  const bool is_folded = HasLegs(shape.kind) && !shape.armhole.empty();
  if (!IsBottom(shape.kind)) FoldTop(shape, maker);
  if (shape.kind == GarmentKind::kTShirt || shape.kind == GarmentKind::kLongSleeve) {
    FoldAnywhere(shape.armhole.back().x(), 0.5 * shape.length, 0.97 * shape.length, 9, maker);
  } else if (is_folded) {
    FoldAnywhere(0.8 * shape.side.front().x(), 0.3 * shape.length, 0.95 * shape.length, 12, maker);
  } else if (HasLegs(shape.kind)) {
    FoldLegs(shape, maker);
  } else {
    FoldSkirt(shape, shape.kind == GarmentKind::kSkirt ? 4.0 : 0.45 * shape.length, maker);
  }
  return maker.Take();
}

void DrawGarment(const GarmentShape& shape, GarmentSide side, const PhotographOptions& options, GarmentCanvas& canvas) {
  switch (shape.kind) {
    case GarmentKind::kTShirt:
    case GarmentKind::kLongSleeve:
      return DrawTop(shape, side, options, canvas);
    case GarmentKind::kOnePiece:
    case GarmentKind::kSleevedOnePiece:
      return DrawDress(shape, side, options, canvas);
    case GarmentKind::kSkirt:
      return DrawSkirt(shape, side, options, canvas);
    case GarmentKind::kPants:
    case GarmentKind::kShorts:
      return DrawTrousers(shape, side, options, canvas);
  }
}

Rgb ColourOr(const PhotographOptions& options, const Rgb& own) {
  if (!options.colour) return own;
  return Rgb((*options.colour)[0], (*options.colour)[1], (*options.colour)[2]);
}

void DrawHem(const FlatCurve& edge, double height_cm, const Rgb& thread, GarmentCanvas& canvas) {
  const double middle = 0.5 * (edge.front().x() + edge.back().x());
  for (const double up : {height_cm, height_cm - 0.45}) {
    FlatCurve row = Offset(edge, -up);
    // Stitches end before the side seams.
    for (Vector2d& point : row) point.x() = middle + 0.992 * (point.x() - middle);
    canvas.DrawStitches(row, thread);
  }
  canvas.DrawSeams({Offset(edge, -height_cm - 0.15)}, 0.25, 0.14);
  canvas.DrawSeams({edge}, 0.12, 0.3);
}

void DrawInsideOfNeck(const GarmentShape& shape, const Rgb& cloth, const Rgb& facing, double facing_cm, double mottle,
                      GarmentCanvas& canvas) {
  canvas.FillCloth(
      Between(shape.back_neckline, shape.front_neckline), [&cloth](const Vector2d&) { return cloth; }, mottle, 0.55);
  const FlatCurve seam = Offset(shape.back_neckline, facing_cm);
  canvas.FillCloth(
      Between(shape.back_neckline, seam), [&facing](const Vector2d&) { return facing; }, 0.02, 0.72);
  canvas.DrawSeams({seam}, 0.2, 0.4);
  const double y = seam[seam.size() / 2].y();
  canvas.FillInk(Rectangle(-1.9, y + 0.1, 3.8, 2.2), Rgb(150, 150, 148));
}

}  // namespace fitroom::shop_catalog

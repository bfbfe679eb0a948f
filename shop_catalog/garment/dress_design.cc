#include <algorithm>
#include <cmath>
#include <cstdint>

#include "shop_catalog/garment/garment_design.h"

namespace fitroom::shop_catalog {
namespace {

using Eigen::Vector2d;

const Rgb kCloth(46, 78, 92);
const Rgb kPetal(236, 178, 92);
const Rgb kHeart(158, 66, 48);
const Rgb kLeaf(98, 140, 128);
constexpr double kFacing = 1.2;  // (unit: centimetre)

// A number in [0, 1) that depends on a cell of the print alone.
double HashOf(int column, int row, int salt) {
  uint32_t h = static_cast<uint32_t>(column) * 73856093u ^ static_cast<uint32_t>(row) * 19349663u ^
               static_cast<uint32_t>(salt) * 83492791u;
  h ^= h >> 13;
  h *= 0x5bd1e995u;
  h ^= h >> 15;
  return (h & 0xFFFFFFu) / double{0x1000000};
}

// Mixes `over` in where `inside` is positive, with an edge half a millimetre wide.
void Paint(Rgb& colour, const Rgb& over, double inside) {
  const double amount = std::clamp(inside / 0.05 + 0.5, 0.0, 1.0);
  colour += static_cast<float>(amount) * (over - colour);
}

// Scattered flowers of five petals with a leaf each, no two alike: the print of a summer dress.
Rgb PrintAt(const Vector2d& place, const Rgb& ground) {
  constexpr double kPitch = 3.7;  // (unit: centimetre)
  Rgb colour = ground;
  const int row0 = static_cast<int>(std::floor(place.y() / kPitch));
  for (int row = row0 - 1; row <= row0 + 1; ++row) {
    const double shift = row % 2 == 0 ? 0.0 : 0.5;
    const int column0 = static_cast<int>(std::floor(place.x() / kPitch - shift));
    for (int column = column0 - 1; column <= column0 + 1; ++column) {
      const Vector2d centre((column + 0.5 + shift + 0.35 * (HashOf(column, row, 1) - 0.5)) * kPitch,
                            (row + 0.5 + 0.35 * (HashOf(column, row, 2) - 0.5)) * kPitch);
      const Vector2d offset = place - centre;
      const double radius = 0.62 + 0.42 * HashOf(column, row, 3), turn = 6.28 * HashOf(column, row, 4);
      const double distance = offset.norm(), angle = std::atan2(offset.y(), offset.x()) + turn;
      const Vector2d leaf_axis(std::cos(turn * 1.7), std::sin(turn * 1.7));
      const double along = offset.dot(leaf_axis) - 1.45 * radius;
      const double across = offset.x() * leaf_axis.y() - offset.y() * leaf_axis.x();
      Paint(colour, kLeaf, 0.26 * radius * (1.0 - std::pow(along / (0.6 * radius), 2)) - std::abs(across));
      Paint(colour, kPetal, radius * (0.72 + 0.28 * std::cos(5.0 * angle)) - distance);
      Paint(colour, kHeart, 0.3 * radius - distance);
    }
  }
  return colour;
}

double HeightOfWaist(const GarmentShape& shape) {
  const auto is_waist = [](const auto& point) { return point.first == "waist_L"; };
  return std::find_if(shape.points.begin(), shape.points.end(), is_waist)->second.y();
}

void DrawWaistSeam(const GarmentShape& shape, double height, GarmentCanvas& canvas) {
  const double half = AtHeight(shape.side, height).x();
  FlatCurve seam = {Vector2d(-half, height)};
  AppendArc(seam, Vector2d(half, height), -0.5);
  canvas.DrawSeams({seam}, 0.16, 0.4);
}

// A sash tied on the wearer's left, which is on the image's right.
void DrawSash(const GarmentShape& shape, double height, const Rgb& cloth, GarmentCanvas& canvas) {
  const double half = AtHeight(shape.side, height).x();
  const auto plain = [&cloth](const Vector2d&) -> Rgb { return 0.8F * cloth; };
  FlatCurve upper = {Vector2d(-half - 0.5, height - 1.1)}, lower = {Vector2d(-half - 0.5, height + 1.1)};
  AppendArc(upper, Vector2d(half + 0.5, height - 1.1), -0.5);
  AppendArc(lower, Vector2d(half + 0.5, height + 1.1), -0.5);
  canvas.FillCloth(Between(upper, lower), plain, 0.03);
  canvas.DrawSeams({upper, lower}, 0.1, 0.45);
  const Vector2d knot(0.55 * half, height + 0.3);
  const auto at = [&knot](double x, double y) -> Vector2d { return knot + Vector2d(x, y); };
  for (const FlatCurve& part :
       {Polygonal({at(0, 0), at(-4.6, -2.0), at(-5.4, 0.6), at(-4.4, 2.2)}),
        Polygonal({at(0, 0), at(4.4, -1.7), at(5.0, 0.9), at(4.2, 2.4)}),
        Polygonal({at(-0.7, 0.4), at(0.2, 0.4), at(-1.9, 12.5), at(-4.3, 11.6)}),
        Polygonal({at(-0.2, 0.4), at(0.8, 0.4), at(3.3, 14.2), at(1.0, 14.9)}), Circle(knot, 0.95)}) {
    canvas.FillCloth(part, plain, 0.03);
    FlatCurve edge = part;
    edge.push_back(edge.front());
    canvas.DrawSeams({edge}, 0.1, 0.4);
  }
}

}  // namespace

void DrawDress(const GarmentShape& shape, GarmentSide side, const PhotographOptions& options, GarmentCanvas& canvas) {
  const bool is_front = side == GarmentSide::kFront;
  const Rgb cloth = ColourOr(options, kCloth);
  const double waist = HeightOfWaist(shape);
  const FlatCurve& neckline = is_front ? shape.front_neckline : shape.back_neckline;
  if (is_front) DrawInsideOfNeck(shape, cloth, 0.9F * cloth, 2.4, 0.03, canvas);
  FlatCurve panel = neckline;
  panel.insert(panel.end(), shape.outline.begin() + static_cast<std::ptrdiff_t>(shape.back_neckline.size()),
               shape.outline.end());
  // The back is cut from another part of the same cloth.
  const Vector2d shift = is_front ? Vector2d(0.0, 0.0) : Vector2d(61.3, 143.7);
  canvas.FillCloth(
      panel, [&](const Vector2d& place) { return PrintAt(place + shift, cloth); }, 0.035);

  const Rgb thread = 0.75F * cloth;
  for (const bool mirrored : {false, true}) {
    const auto on_side = [mirrored](const FlatCurve& curve) { return mirrored ? Mirror(curve) : curve; };
    canvas.DrawSeams({on_side(shape.armhole)}, 0.16, 0.35);
    if (shape.kind == GarmentKind::kOnePiece) {
      canvas.DrawStitches(on_side(Offset(shape.armhole, 0.9)), thread);
    } else {
      canvas.DrawSeams({on_side(shape.sleeve_end)}, 0.12, 0.3);
      FlatCurve cuff = Offset(shape.sleeve_end, 1.6);
      cuff.erase(cuff.begin(), cuff.begin() + 2);
      cuff.erase(cuff.end() - 2, cuff.end());
      canvas.DrawStitches(on_side(cuff), thread);
    }
    // Bust darts in front, long darts behind.
    const double x = 0.42 * shape.side.front().x(), sign = mirrored ? -1.0 : 1.0;
    if (is_front) {
      const Vector2d bust(sign * 1.15 * x, shape.side.front().y() + 3.0);
      canvas.DrawSeams({{AtHeight(shape.side, shape.side.front().y() + 6.0).cwiseProduct(Vector2d(sign, 1.0)), bust}},
                       0.12, 0.3);
    } else {
      canvas.DrawSeams({{Vector2d(sign * x, waist - 11.0), Vector2d(sign * 0.96 * x, waist),
                         Vector2d(sign * 1.02 * x, waist + 10.0)}},
                       0.12, 0.3);
    }
  }
  DrawWaistSeam(shape, waist, canvas);
  if (is_front) {
    DrawSash(shape, waist, cloth, canvas);
  } else {
    canvas.DrawSeams({{Vector2d(0.0, neckline[neckline.size() / 2].y()), Vector2d(0.0, waist + 17.0)}}, 0.2, 0.45);
    canvas.FillInk(Rectangle(-0.2, neckline[neckline.size() / 2].y() + 1.6, 0.4, 1.4), Rgb(180, 178, 170));
  }
  DrawHem(shape.hem, 1.8, thread, canvas);
  canvas.DrawStitches(Offset(neckline, kFacing), thread);
  canvas.DrawSeams({neckline}, 0.1, 0.3);
}

}  // namespace fitroom::shop_catalog

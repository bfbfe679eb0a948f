#include <algorithm>
#include <cmath>
#include <numbers>

#include "shop_catalog/garment/garment_design.h"

namespace fitroom::shop_catalog {
namespace {

using Eigen::Vector2d;

constexpr double kPi = std::numbers::pi;
constexpr double kTrouserBand = 4.0;  // Height of the waistband (unit: centimetre).
constexpr double kSkirtBand = 3.4;    // (unit: centimetre)
const Rgb kDenim(58, 82, 120);
const Rgb kDenimThread(196, 150, 84);
const Rgb kWool(122, 74, 58);
const Rgb kCheck(206, 186, 152);

// Twill: fine lines that rise to the right, worn paler down the middle of each leg.
Rgb DenimAt(const Vector2d& place, const Rgb& cloth, double leg_middle, double crotch) {
  const double twill = 0.035 * std::sin(2 * kPi * (place.x() + 0.8 * place.y()) / 0.23);
  const double slub = 0.02 * std::sin(9.1 * place.x() + 1.3 * std::sin(0.21 * place.y()));
  const double off = (std::abs(place.x()) - leg_middle) / 6.5, down = (place.y() - crotch - 8.0) / 24.0;
  const double worn = 0.2 * std::exp(-off * off - down * down);
  const double bright = 1.0 + twill + slub + worn;
  const Rgb pale(210, 222, 236);
  return static_cast<float>(bright) * (cloth + static_cast<float>(0.45 * worn) * (pale - cloth));
}

// A wide check of fine double lines on a herringbone ground.
Rgb CheckAt(const Vector2d& place, const Rgb& cloth) {
  constexpr double kPitch = 6.4;  // (unit: centimetre)
  const double column = std::floor(place.x() / 0.9);
  const double lean = static_cast<long>(column) % 2 == 0 ? 1.0 : -1.0;
  const double weave = 1.0 + 0.05 * std::sin(2 * kPi * (place.y() + lean * place.x()) / 0.4);
  Rgb colour = static_cast<float>(weave) * cloth;
  for (const double value : {place.x() + 1.1, place.y() + 0.4}) {
    const double phase = value - kPitch * std::floor(value / kPitch);
    for (const double line : {0.3, 0.75}) {
      const double inside = 0.1 - std::abs(phase - line);
      colour += static_cast<float>(0.6 * std::clamp(inside / 0.05 + 0.5, 0.0, 1.0)) * (kCheck - colour);
    }
  }
  return colour;
}

// The waist's edge moved down by a height, cut off where the sides are.
FlatCurve BandSeam(const GarmentShape& shape, double height) {
  const double half = AtHeight(shape.side, height).x();
  FlatCurve seam;
  for (const Vector2d& place : shape.waist)
    seam.push_back({place.x() / shape.waist.back().x() * half, place.y() + height});
  return seam;
}

void DrawLoop(double x, double height, const GarmentCanvas::Cloth& cloth, GarmentCanvas& canvas) {
  const FlatCurve loop = Rectangle(x - 0.55, -0.2 + 0.6, 1.1, height + 0.5);
  canvas.FillCloth(loop, cloth, 0.06, 1.04);
  FlatCurve edge = loop;
  edge.push_back(edge.front());
  canvas.DrawSeams({edge}, 0.12, 0.5);
}

void Patch(const std::vector<Vector2d>& corners, const GarmentCanvas::Cloth& cloth, const Rgb& thread,
           GarmentCanvas& canvas) {
  FlatCurve edge = Polygonal(corners);
  canvas.FillCloth(edge, cloth, 0.06, 1.03);
  edge.push_back(edge.front());
  canvas.DrawSeams({edge}, 0.2, 0.45);
  Vector2d centre = Vector2d::Zero();
  for (const Vector2d& corner : corners) centre += corner / static_cast<double>(corners.size());
  for (const double inset : {0.94, 0.89}) {
    FlatCurve row;
    for (const Vector2d& place : edge) row.push_back(centre + inset * (place - centre));
    canvas.DrawStitches(row, thread);
  }
}

// Button, fly with its curved stitching on the wearer's left, slanted pockets, a coin pocket on the wearer's right.
void DrawTrouserFront(const GarmentShape& shape, const Rgb& thread, GarmentCanvas& canvas) {
  const double crotch = shape.inseam.front().y();
  const double fly = 0.62 * crotch;
  for (const double out : {3.4, 3.0}) {
    FlatCurve stitch = {Vector2d(out, kTrouserBand + 0.6)};
    AppendLine(stitch, Vector2d(out, fly - 3.5));
    AppendCurve(stitch, Vector2d(out, fly - 0.8), Vector2d(0.4 * out, fly + 0.2), Vector2d(0.15, fly + 0.4));
    canvas.DrawStitches(stitch, thread);
  }
  canvas.DrawSeams({{Vector2d(0.0, kTrouserBand), Vector2d(0.0, fly)}}, 0.25, 0.5);
  for (const double sign : {-1.0, 1.0}) {
    const double x = 0.56 * shape.side.front().x();
    const Vector2d end = AtHeight(shape.side, kTrouserBand + 0.44 * crotch);
    FlatCurve pocket = {Vector2d(sign * x, kTrouserBand + 0.8)};
    AppendCurve(pocket, Vector2d(sign * (x + 1.0), kTrouserBand + 6.0), Vector2d(sign * (end.x() - 5.0), end.y() - 0.6),
                Vector2d(sign * end.x(), end.y()));
    canvas.DrawSeams({pocket}, 0.3, 0.55);
    canvas.DrawStitches(Offset(pocket, sign * 0.35), thread);
    canvas.DrawStitches(Offset(pocket, sign * 0.75), thread);
    if (sign < 0.0) {
      FlatCurve coin = {Vector2d(-x - 1.2, kTrouserBand + 4.6)};
      AppendLine(coin, Vector2d(-x - 5.6, kTrouserBand + 4.9));
      canvas.DrawSeams({coin}, 0.16, 0.45);
      canvas.DrawStitches(Offset(coin, -0.3), thread);
    }
  }
  canvas.FillInk(Circle({1.0, 0.5 * kTrouserBand + 0.9}, 0.95), Rgb(150, 122, 84));
  canvas.FillInk(Circle({0.8, 0.5 * kTrouserBand + 0.7}, 0.42), Rgb(214, 190, 150));
}

// Yoke, patch pockets, a label on the wearer's right.
void DrawTrouserBack(const GarmentShape& shape, const GarmentCanvas::Cloth& cloth, const Rgb& thread,
                     GarmentCanvas& canvas) {
  const double crotch = shape.inseam.front().y();
  const double yoke = kTrouserBand + 0.16 * crotch;
  canvas.DrawSeams({{Vector2d(0.0, kTrouserBand), Vector2d(0.0, crotch)}}, 0.22, 0.5);
  canvas.DrawStitches({Vector2d(0.4, kTrouserBand + 0.4), Vector2d(0.4, crotch - 1.0)}, thread);
  for (const double sign : {-1.0, 1.0}) {
    const Vector2d end = AtHeight(shape.side, yoke - 0.5);
    FlatCurve seam = {Vector2d(0.0, yoke + 2.6)};
    AppendLine(seam, Vector2d(sign * end.x(), end.y()));
    canvas.DrawSeams({seam}, 0.22, 0.45);
    canvas.DrawStitches(Offset(seam, sign * 0.35), thread);
    canvas.DrawStitches(Offset(seam, sign * 0.75), thread);
    const double x = 0.2 * shape.side.front().x(), y = yoke + 3.6;
    const double width = 0.62 * shape.side.front().x(), height = std::min(14.0, 0.5 * crotch);
    const auto at = [&](double u, double v) -> Vector2d {
      return {sign * (x + u * width), y + v * height - 0.08 * u * width};
    };
    Patch({at(0.0, 0.0), at(1.0, 0.0), at(0.96, 0.8), at(0.5, 1.0), at(0.04, 0.8)}, cloth, thread, canvas);
    FlatCurve swing = {at(0.06, 0.42)};
    AppendCurve(swing, at(0.25, 0.62), at(0.4, 0.62), at(0.5, 0.46));
    AppendCurve(swing, at(0.6, 0.62), at(0.75, 0.62), at(0.94, 0.42));
    canvas.DrawStitches(swing, thread);
  }
  // On a back photograph the wearer's right is the image's right.
  canvas.FillInk(Rectangle(0.42 * shape.side.front().x(), 0.9, 5.6, kTrouserBand - 0.6), Rgb(150, 104, 66));
  canvas.FillInk(Rectangle(0.42 * shape.side.front().x() + 1.0, 2.1, 3.6, 0.5), Rgb(110, 72, 44));
}

void DrawBand(const GarmentShape& shape, double height, const GarmentCanvas::Cloth& cloth, const Rgb& thread,
              GarmentCanvas& canvas) {
  const FlatCurve seam = BandSeam(shape, height);
  canvas.FillCloth(Between(shape.waist, seam), cloth, 0.05, 0.97);
  canvas.DrawSeams({seam}, 0.25, 0.5);
  canvas.DrawSeams({shape.waist}, 0.15, 0.35);
  canvas.DrawStitches(BandSeam(shape, 0.5), thread);
  canvas.DrawStitches(BandSeam(shape, height - 0.4), thread);
}

}  // namespace

void DrawTrousers(const GarmentShape& shape, GarmentSide side, const PhotographOptions& options,
                  GarmentCanvas& canvas) {
  const bool is_front = side == GarmentSide::kFront;
  const Rgb denim = ColourOr(options, kDenim);
  const Rgb thread = options.colour ? Rgb(0.7F * denim) : kDenimThread;
  const double crotch = shape.inseam.front().y();
  const double leg_middle = 0.5 * (shape.inseam.back().x() + shape.side.back().x());
  const GarmentCanvas::Cloth cloth = [&](const Vector2d& place) { return DenimAt(place, denim, leg_middle, crotch); };
  canvas.FillCloth(shape.outline, cloth, 0.06);
  // The crotch seam shows from fly to fork; inseams and outseams are felled, with two rows of stitches on one edge.
  canvas.DrawSeams({{Vector2d(0.0, 0.5 * crotch), Vector2d(0.0, crotch)}}, 0.22, 0.5);
  if (is_front) {
    DrawTrouserFront(shape, thread, canvas);
  } else {
    DrawTrouserBack(shape, cloth, thread, canvas);
  }
  for (const bool mirrored : {false, true}) {
    const auto on_side = [mirrored](const FlatCurve& curve) { return mirrored ? Mirror(curve) : curve; };
    canvas.DrawSeams({on_side(Offset(shape.side, 0.25))}, 0.5, 0.22);
    canvas.DrawSeams({on_side(Offset(shape.inseam, -0.2))}, 0.4, 0.25);
    for (const double out : {0.35, 0.75}) {
      canvas.DrawStitches(on_side(Offset(shape.inseam, -out)), thread);
    }
    DrawHem(on_side(mirrored ? Reversed(shape.hem) : shape.hem), 1.6, thread, canvas);
  }
  DrawBand(shape, kTrouserBand, cloth, thread, canvas);
  const double half = shape.side.front().x();
  for (const double part : {-0.86, -0.4, 0.4, 0.86}) DrawLoop(part * half, kTrouserBand, cloth, canvas);
  if (!is_front) DrawLoop(0.0, kTrouserBand, cloth, canvas);
  if (is_front) {
    canvas.DrawSeams({{Vector2d(-0.4, 0.8), Vector2d(-0.4, kTrouserBand + 0.6)}}, 0.18, 0.5);
    canvas.FillInk(Circle({1.1, 0.5 * kTrouserBand + 0.8}, 0.85), Rgb(142, 114, 78));
    canvas.FillInk(Circle({0.9, 0.5 * kTrouserBand + 0.6}, 0.36), Rgb(208, 184, 146));
  }
}

void DrawSideFolded(const GarmentShape& shape, const PhotographOptions& options, GarmentCanvas& canvas) {
  const Rgb denim = ColourOr(options, kDenim);
  const Rgb thread = options.colour ? Rgb(0.7F * denim) : kDenimThread;
  const double crotch = shape.inseam.front().y();
  const GarmentCanvas::Cloth cloth = [&](const Vector2d& place) {
    return DenimAt(place, denim, 0.5 * (shape.inseam.back().x() + shape.side.back().x()), crotch);
  };
  canvas.FillCloth(shape.outline, cloth, 0.06);
  canvas.DrawSeams({Offset(shape.armhole, -0.2)}, 0.4, 0.3);
  for (const double out : {0.35, 0.75}) {
    canvas.DrawStitches(Offset(shape.armhole, -out), thread);
    canvas.DrawStitches(Offset(shape.inseam, -out), thread);
  }
  canvas.DrawSeams({Offset(shape.side, 0.25), Offset(shape.inseam, -0.2)}, 0.45, 0.22);
  // Half a pocket's mouth is seen on the outseam's side.
  const Vector2d end = AtHeight(shape.side, kTrouserBand + 0.44 * crotch);
  FlatCurve pocket = {Vector2d(0.56 * shape.waist.back().x(), kTrouserBand + 0.8)};
  AppendCurve(pocket, Vector2d(0.6 * shape.waist.back().x(), kTrouserBand + 6.0), end - Vector2d(4.0, 0.6), end);
  canvas.DrawSeams({pocket}, 0.3, 0.5);
  canvas.DrawStitches(Offset(pocket, 0.4), thread);
  DrawHem(shape.hem, 1.6, thread, canvas);
  FlatCurve seam = {Vector2d(0.0, kTrouserBand)};
  AppendLine(seam, AtHeight(shape.side, kTrouserBand));
  canvas.FillCloth(Between(shape.waist, seam), cloth, 0.05, 0.97);
  canvas.DrawSeams({seam}, 0.25, 0.5);
  canvas.DrawStitches(Offset(seam, -0.4), thread);
  canvas.DrawStitches(Offset(shape.waist, 0.5), thread);
  DrawLoop(0.7 * shape.waist.back().x(), kTrouserBand, cloth, canvas);
}

void DrawSkirt(const GarmentShape& shape, GarmentSide side, const PhotographOptions& options, GarmentCanvas& canvas) {
  const bool is_front = side == GarmentSide::kFront;
  const Rgb wool = ColourOr(options, kWool);
  const Rgb thread = 0.7F * wool;
  const Vector2d shift = is_front ? Vector2d(0.0, 0.0) : Vector2d(3.1, 2.2);
  const GarmentCanvas::Cloth cloth = [&](const Vector2d& place) { return CheckAt(place + shift, wool); };
  canvas.FillCloth(shape.outline, cloth, 0.05);
  const double half = shape.side.front().x();
  for (const double sign : {-1.0, 1.0}) {
    // Darts from the waistband, longer behind.
    const double x = sign * 0.5 * half, length = is_front ? 9.0 : 12.5;
    canvas.DrawSeams({{Vector2d(x, kSkirtBand), Vector2d(1.08 * x, kSkirtBand + length)}}, 0.16, 0.4);
    FlatCurve edge = sign > 0 ? shape.side : Mirror(shape.side);
    canvas.DrawSeams({edge}, 0.3, 0.2);
  }
  if (is_front) {
    // A pocket flap on the wearer's left.
    const double x = 0.42 * half, y = kSkirtBand + 11.5;
    Patch({{x, y}, {x + 8.6, y + 0.5}, {x + 8.2, y + 4.6}, {x + 4.3, y + 5.8}, {x + 0.3, y + 4.1}}, cloth, thread,
          canvas);
    canvas.FillInk(Circle({x + 4.3, y + 4.2}, 0.6), Rgb(70, 46, 36));
  } else {
    canvas.DrawSeams({{Vector2d(0.0, kSkirtBand), Vector2d(0.0, shape.length)}}, 0.16, 0.4);
    canvas.DrawSeams({{Vector2d(0.0, kSkirtBand), Vector2d(0.0, kSkirtBand + 17.0)}}, 0.35, 0.4);
    canvas.FillInk(Rectangle(-0.2, kSkirtBand + 0.5, 0.4, 1.3), Rgb(176, 160, 120));
    canvas.DrawSeams({{Vector2d(0.0, shape.length - 15.0), Vector2d(1.0, shape.length + 1.5)}}, 0.5, 0.4);
  }
  DrawBand(shape, kSkirtBand, cloth, thread, canvas);
  if (!is_front) {
    // The band overlaps to the wearer's right, with a button.
    canvas.DrawSeams({{Vector2d(2.4, 0.6), Vector2d(2.4, kSkirtBand + 0.7)}}, 0.16, 0.5);
    canvas.FillInk(Circle({1.2, 0.5 * kSkirtBand + 0.7}, 0.7), Rgb(70, 46, 36));
  }
  DrawHem(shape.hem, 2.6, thread, canvas);
}

}  // namespace fitroom::shop_catalog

// The torso: a sweep of horizontal sections from the crotch to the neck, and what stands out from it.
#include <vector>

#include "body_center/scan/figure.h"
#include "body_center/scan/figure_parts.h"

namespace fitroom::body_center {
namespace {

// Sections of the reference torso without bust, buttocks and shoulders. Proportions of a young adult woman; the spine's
// curve is in the change of z_back with height.
const std::vector<HorizontalRow> kTorsoRows = {
    {79.0, 0, 8.5, 0.0, 4.5, -5.0, 2.0, 2.0},    {81.5, 0, 13.5, 0.2, 7.6, -7.9, 2.1, 2.2},
    {85.0, 0, 16.4, 0.2, 9.4, -9.2, 2.2, 2.3},   {88.5, 0, 17.1, 0.1, 10.1, -9.8, 2.2, 2.3},
    {93.0, 0, 16.6, 0.2, 10.6, -9.4, 2.15, 2.3}, {98.0, 0, 15.2, 0.6, 10.8, -8.2, 2.1, 2.4},
    {103.0, 0, 13.4, 1.0, 10.5, -7.0, 2.1, 2.5}, {107.5, 0, 12.4, 1.2, 10.1, -6.5, 2.1, 2.5},
    {112.0, 0, 12.6, 1.1, 10.2, -7.0, 2.1, 2.5}, {117.0, 0, 13.3, 0.8, 10.5, -8.1, 2.1, 2.5},
    {122.5, 0, 13.9, 0.3, 10.5, -9.2, 2.1, 2.4}, {127.0, 0, 14.1, -0.2, 9.7, -9.7, 2.2, 2.4},
    {131.0, 0, 13.4, -0.7, 8.4, -9.7, 2.2, 2.3}, {134.5, 0, 11.4, -1.2, 6.7, -9.0, 2.2, 2.2},
    {137.5, 0, 8.4, -1.6, 4.6, -7.9, 2.1, 2.1},  {140.0, 0, 5.4, -1.8, 3.0, -6.6, 2.0, 2.0},
};

void AddBust(const FigureShape& shape, Figure& figure) {
  // Breasts grow faster than the rib cage that carries them.
  const double size = 1.0 + 1.2 * (shape.bust - 1.0);
  const double level = BustHeight(shape) / kCm;  // (unit: centimetre)
  for (const double side : {1.0, -1.0}) {
    const double x = side * 7.5 * shape.bust;
    figure.solid.Add(MakeEllipsoid(PointCm(x, level, 7.6 * shape.bust), size * PointCm(6.2, 6.2, 5.7)), 0.032);
    // The slope from the collar bone to the breast.
    figure.solid.Add(MakeRoundCone(PointCm(x * 0.80, 130.5, 3.6 * shape.bust), 0.042,
                                   PointCm(x * 0.95, level + 1.2, 7.2 * shape.bust), 0.046 * size),
                     0.05);
  }
}

void AddButtocks(const FigureShape& shape, Figure& figure) {
  for (const double side : {1.0, -1.0}) {
    const Eigen::Vector3d centre = PointCm(side * 7.3 * shape.hip, 88.0, -5.6 * shape.hip);
    figure.solid.Add(MakeEllipsoid(centre, shape.hip * PointCm(7.7, 8.8, 6.5)), 0.03);
  }
}

void AddShoulderGirdle(const FigureShape& shape, double breadth, Figure& figure) {
  for (const double side : {1.0, -1.0}) {
    // The slope from the neck to the shoulder's edge: trapezius, then the bone's end.
    figure.solid.Add(MakeRoundCone(PointCm(side * 3.2, 139.9, -2.6), 0.034 * shape.neck,
                                   PointCm(side * 14.6 * breadth, 133.9, -1.0), 0.037),
                     0.025);
    // Shoulder blade and collar bone.
    figure.solid.Add(
        MakeEllipsoid(PointCm(side * 8.2 * breadth, 127.0, -1.7 - 4.6 * shape.bust), PointCm(4.8, 9.5, 2.9)), 0.055);
    figure.solid.Add(
        MakeRoundCone(PointCm(side * 1.9, 138.0, 4.2), 0.008, PointCm(side * 12.5 * breadth, 136.6, 1.6), 0.008),
        0.016);
  }
}

}  // namespace

double BustHeight(const FigureShape& shape) { return 1.218 - 0.07 * (shape.bust - 1.0); }

void AddTorso(const FigureShape& shape, Figure& figure) {
  const double shoulder = 1.0 + 0.45 * (shape.bust - 1.0);
  const std::vector<Eigen::Vector2d> factors = {{79.0, shape.hip},   {91.0, shape.hip},   {107.5, shape.waist},
                                                {122.5, shape.bust}, {127.0, shape.bust}, {136.0, shoulder},
                                                {140.0, shape.neck}};
  std::vector<SweptSection> sections;
  for (const HorizontalRow& row : kTorsoRows) {
    sections.push_back(SectionFromRow(row, SmoothProfile(factors, row.y)));
  }
  figure.solid.AddGroup(ImplicitSolid::Region::kTorso, 0.0);
  figure.solid.Add(MakeSweep(VerticalSweepFrame(), sections), 0.0);
  AddShoulderGirdle(shape, shoulder, figure);
  AddBust(shape, figure);
  AddButtocks(shape, figure);
  // Navel, the hollow of the spine and the notch above the breastbone.
  figure.solid.Carve(MakeEllipsoid(PointCm(0.0, 102.0, 1.0 + 9.7 * shape.waist), PointCm(0.6, 0.9, 0.9)), 0.01);
  figure.solid.Carve(MakeRoundCone(PointCm(0.0, 99.0, -0.8 - 9.2 * shape.waist), 0.012,
                                   PointCm(0.0, 133.0, -3.4 - 9.6 * shape.bust), 0.004),
                     0.025);
  figure.solid.Carve(MakeEllipsoid(PointCm(0.0, 138.8, 6.6), PointCm(1.2, 1.3, 1.8)), 0.012);
}

}  // namespace fitroom::body_center

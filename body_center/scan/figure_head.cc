// Neck and head.
#include <vector>

#include "body_center/scan/figure.h"
#include "body_center/scan/figure_parts.h"

namespace fitroom::body_center {
namespace {

const std::vector<HorizontalRow> kNeckRows = {
    {134.0, 0, 6.2, -1.4, 3.6, -7.2, 2.1, 2.1}, {137.0, 0, 5.8, -1.1, 4.1, -6.9, 2.1, 2.1},
    {140.0, 0, 5.4, -0.7, 4.5, -6.2, 2.1, 2.1}, {143.0, 0, 5.15, -0.2, 4.8, -5.2, 2.1, 2.1},
    {146.0, 0, 5.05, 0.3, 5.2, -4.5, 2.1, 2.1}, {150.0, 0, 5.1, 0.8, 5.8, -4.1, 2.1, 2.1},
    {154.0, 0, 5.0, 1.2, 6.0, -3.8, 2.1, 2.1},
};

// From the chin to the brow.
const std::vector<HorizontalRow> kFaceRows = {
    {146.3, 0, 1.4, 7.4, 8.7, 4.5, 2.2, 2.0},    {147.2, 0, 2.8, 6.4, 10.0, 2.8, 2.2, 2.0},
    {148.8, 0, 4.25, 5.0, 10.6, 1.5, 2.2, 2.0},  {151.0, 0, 5.35, 4.0, 10.8, 0.6, 2.2, 2.0},
    {153.5, 0, 6.1, 3.4, 11.0, -1.0, 2.25, 2.0}, {156.0, 0, 6.4, 3.0, 11.0, -2.5, 2.3, 2.0},
    {158.5, 0, 6.65, 2.7, 11.0, -4.0, 2.3, 2.0}, {161.0, 0, 6.2, 2.5, 10.4, -4.0, 2.3, 2.0},
    {163.5, 0, 4.6, 2.4, 8.2, -3.0, 2.2, 2.0},   {165.0, 0, 2.0, 2.3, 4.5, -1.0, 2.0, 2.0},
};

void AddFace(Figure& figure) {
  ImplicitSolid& solid = figure.solid;
  solid.Add(MakeEllipsoid(PointCm(0.0, 148.0, 9.3), PointCm(1.9, 1.5, 1.6)), 0.012);
  for (const double side : {1.0, -1.0}) {
    solid.Carve(MakeEllipsoid(PointCm(side * 3.2, 156.7, 12.1), PointCm(1.9, 1.15, 1.9)), 0.012);
    solid.Add(MakeEllipsoid(PointCm(side * 3.2, 156.5, 9.3), PointCm(1.35, 1.05, 1.25)), 0.003);
    solid.Add(MakeEllipsoid(PointCm(side * 4.3, 153.9, 8.0), PointCm(1.9, 1.5, 1.6)), 0.025);
    solid.Add(MakeEllipsoid(PointCm(side * 1.0, 152.6, 11.3), PointCm(0.7, 0.65, 0.9)), 0.008);
    solid.Add(MakeEllipsoid(PointCm(side * 6.95, 155.9, 0.9), PointCm(0.8, 2.7, 1.6)), 0.010);
  }
  solid.Add(MakeRoundCone(PointCm(0.0, 157.5, 10.8), 0.006, PointCm(0.0, 153.0, 12.4), 0.0085), 0.012);
  solid.Add(MakeEllipsoid(PointCm(0.0, 150.55, 10.55), PointCm(2.2, 0.55, 0.95)), 0.008);
  solid.Add(MakeEllipsoid(PointCm(0.0, 149.65, 10.35), PointCm(1.8, 0.65, 1.0)), 0.008);
}

}  // namespace

void AddHead(const FigureShape& shape, Figure& figure) {
  // Below the throat the neck grows out of the shoulders, above it carries a head of given size.
  const std::vector<Eigen::Vector2d> factors = {{134.0, shape.neck}, {147.0, shape.neck}, {153.0, 1.0}};
  std::vector<SweptSection> neck;
  for (const HorizontalRow& row : kNeckRows) neck.push_back(SectionFromRow(row, SmoothProfile(factors, row.y)));
  figure.solid.AddGroup(ImplicitSolid::Region::kTorso, 0.03);
  figure.solid.Add(MakeSweep(VerticalSweepFrame(), neck), 0.0);

  std::vector<SweptSection> face;
  for (const HorizontalRow& row : kFaceRows) face.push_back(SectionFromRow(row, 1.0));
  figure.solid.AddGroup(ImplicitSolid::Region::kHead, 0.012);
  figure.solid.Add(MakeEllipsoid(PointCm(0.0, 158.6, 2.2), PointCm(7.3, 9.4, 9.3)), 0.0);
  figure.solid.Add(MakeSweep(VerticalSweepFrame(), face), 0.03);
  AddFace(figure);
}

}  // namespace fitroom::body_center

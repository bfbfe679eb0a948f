#include "body_center/scan/figure.h"

#include <algorithm>

#include "body_center/scan/figure_parts.h"

namespace fitroom::body_center {

SweptSection SectionFromRow(const HorizontalRow& row, double factor, double spread, double side) {
  SweptSection section;
  section.position = kCm * row.y;
  section.centre = kCm * Eigen::Vector2d(side * row.x_centre * spread, row.z_centre);
  section.half_width = kCm * row.half_width * factor;
  section.front = kCm * (row.z_front - row.z_centre) * factor;
  section.back = kCm * (row.z_centre - row.z_back) * factor;
  section.front_exponent = row.front_exponent;
  section.back_exponent = row.back_exponent;
  return section;
}

Eigen::Isometry3d VerticalSweepFrame() {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear().col(0) = Eigen::Vector3d::UnitX();
  frame.linear().col(1) = Eigen::Vector3d::UnitZ();
  frame.linear().col(2) = Eigen::Vector3d::UnitY();
  return frame;
}

double SmoothProfile(const std::vector<Eigen::Vector2d>& pairs, double place) {
  if (place <= pairs.front().x()) return pairs.front().y();
  for (size_t i = 1; i < pairs.size(); ++i) {
    if (place > pairs[i].x()) continue;
    const double t = (place - pairs[i - 1].x()) / (pairs[i].x() - pairs[i - 1].x());
    return pairs[i - 1].y() + (pairs[i].y() - pairs[i - 1].y()) * t * t * (3.0 - 2.0 * t);
  }
  return pairs.back().y();
}

Figure BuildFigure(const FigureShape& shape) {
  Figure figure;
  AddTorso(shape, figure);
  AddLegs(shape, figure);
  AddHead(shape, figure);
  AddArms(shape, figure);
  return figure;
}

}  // namespace fitroom::body_center

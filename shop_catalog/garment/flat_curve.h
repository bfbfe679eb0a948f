#pragma once

#include <vector>

#include <Eigen/Core>

// Curves on a garment that lies flat (unit: centimetre; origin on the middle line at the garment's top, x to the
// image's right, y down).
namespace fitroom::shop_catalog {

using FlatCurve = std::vector<Eigen::Vector2d>;

Eigen::Vector2d MirrorX(const Eigen::Vector2d& place);
// Returns the curve mirrored in the middle line, running the same way.
FlatCurve Mirror(const FlatCurve& curve);
// Returns the curve mirrored in the middle line and reversed, so that it carries on where its end met the middle.
FlatCurve MirrorReversed(const FlatCurve& curve);
FlatCurve Reversed(const FlatCurve& curve);

// Appends `next` without its first point, which is the curve's last.
void Join(FlatCurve& curve, const FlatCurve& next);
// Appends a straight line, densely sampled, so that crumpling bends it too.
void AppendLine(FlatCurve& curve, const Eigen::Vector2d& end);
// Appends a cubic Bezier curve from the curve's last point.
void AppendCurve(FlatCurve& curve, const Eigen::Vector2d& first_handle, const Eigen::Vector2d& second_handle,
                 const Eigen::Vector2d& end);
// Appends a curve that leaves the straight line by `bulge` to its left, seen in its direction (y down).
void AppendArc(FlatCurve& curve, const Eigen::Vector2d& end, double bulge);

// Returns a smooth curve x(y) through places of rising y that never swings beyond them (monotone cubic: Fritsch and
// Carlson 1980).
FlatCurve Profile(const std::vector<Eigen::Vector2d>& places);

// Returns the curve moved by `distance` to its right, seen in its direction (y down: below a curve that runs to the
// image's right).
FlatCurve Offset(const FlatCurve& curve, double distance);
// Returns the closed shape between two curves that run the same way.
FlatCurve Between(const FlatCurve& a, const FlatCurve& b);
FlatCurve Circle(const Eigen::Vector2d& centre, double radius);
// Returns a closed shape with straight edges, densely sampled.
FlatCurve Polygonal(const std::vector<Eigen::Vector2d>& corners);
FlatCurve Rectangle(double x, double y, double width, double height);

// Returns the place where the curve is nearest to a height.
Eigen::Vector2d AtHeight(const FlatCurve& curve, double height);
// Returns the place at a part of the curve's length, 0 to 1.
Eigen::Vector2d AtPart(const FlatCurve& curve, double part);
double CurveLength(const FlatCurve& curve);
// Returns the part of a curve whose heights lie in this range.
FlatCurve Section(const FlatCurve& curve, double top, double bottom);

}  // namespace fitroom::shop_catalog

#include "fit_client/fit/fork/fork_pieces.h"

#include <cmath>
#include <string>
#include <utility>

namespace fitroom::fork {
namespace {

// Raises the waist towards the middle, not at all at the side, and without a corner at either.
OutlineSection RaisedWaist(const OutlineSection& waist, double raise, const Eigen::Vector2d& middle) {
  OutlineSection raised = waist;
  const double side = waist.points.front().x(), width = side - waist.points.back().x();
  for (Eigen::Vector2d& p : raised.points) {
    const double t = (side - p.x()) / width;
    p.y() += raise * t * t * (3.0 - 2.0 * t);
  }
  raised.points.back() = middle;
  return raised;
}

// A seam that the photograph does not show, with the knots of the one in whose place it comes, each at the nearest
// height.
OutlineSection NewSeam(std::string name, const panels::Polyline& points, const std::vector<SectionKnot>& knots,
                       const panels::Polyline& knot_points, const ForkTexture& texture) {
  OutlineSection seam{std::move(name), SectionKind::kSeam, points, {}, {}};
  for (const Eigen::Vector2d& p : points) seam.pixels.push_back(texture.PixelAt(p));
  for (const SectionKnot& knot : knots) {
    const double height = knot_points[static_cast<size_t>(knot.index)].y();
    int nearest = 0;
    for (size_t i = 0; i < points.size(); ++i) {
      if (std::abs(points[i].y() - height) < std::abs(points[static_cast<size_t>(nearest)].y() - height)) {
        nearest = static_cast<int>(i);
      }
    }
    seam.knots.push_back({knot.name, nearest});
  }
  seam.knots.front().index = 0;
  seam.knots.back().index = static_cast<int>(points.size()) - 1;
  return seam;
}

OutlineSection ShiftedHem(const OutlineSection& hem, double shift) {
  OutlineSection shifted = hem;
  if (shift == 0.0) return shifted;
  const std::vector<double> arcs = panels::CumulativeLengths(hem.points);
  for (size_t i = 0; i < hem.points.size(); ++i) shifted.points[i].x() += shift * (1.0 - arcs[i] / arcs.back());
  return shifted;
}

}  // namespace

PanelPattern CutPiece(const PanelPattern& panel, const HalfPanel& half, bool left, const ForkSeams& seams) {
  const ForkTexture texture(panel, half, left);
  const panels::Polyline centre = CentreSeam(FrameOf(half), seams.centre);
  OutlineSection waist = RaisedWaist(half.waist, seams.centre.raise, centre.front());
  OutlineSection hem = ShiftedHem(half.leg_hem, seams.inseam.shift);
  panels::Polyline inseam = seams.inseam.points;
  inseam.front() = centre.back();
  inseam.back() = hem.points.front();
  const std::vector<SectionKnot> ends = {{"waist_centre", 0}, {"crotch", static_cast<int>(centre.size()) - 1}};
  OutlineSection centre_seam = NewSeam(left ? "centre_L" : "centre_R", centre, ends, centre, texture);
  OutlineSection inner_seam = NewSeam(half.inseam.name, inseam, half.inseam.knots, half.inseam.points, texture);
  return PieceOf(panel, left,
                 {std::move(waist), std::move(centre_seam), std::move(inner_seam), std::move(hem), half.outseam});
}

}  // namespace fitroom::fork

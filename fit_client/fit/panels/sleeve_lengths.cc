#include "fit_client/fit/panels/sleeve_lengths.h"

#include <algorithm>
#include <array>
#include <string>

#include <Eigen/Dense>

#include "common/base/check.h"

namespace fitroom::panels {
namespace {

// The corners of a sleeve, laid flat:
//
//   tip ------ top           Chords: tip-top, underarm-bottom, top-bottom, tip-bottom, underarm-top.
//    |          |            Tip and underarm belong to the torso and stay.
// underarm -- bottom
struct SleeveCorners {
  Eigen::Vector2d tip, top, bottom, underarm;
};

using Chords = Eigen::Matrix<double, 5, 1>;

struct SleeveSections {
  size_t shoulder = 0, end = 0, underside = 0;
  size_t tip_knot = 0;  // Of the shoulder section.
};

SleeveSections FindSleeve(const std::vector<SectionLayout>& layout, bool left) {
  SleeveSections found;
  const std::string side = left ? "_L" : "_R";
  for (size_t s = 0; s < layout.size(); ++s) {
    if (layout[s].name == "shoulder" + side) found.shoulder = s;
    if (layout[s].name == "sleeve_end" + side) found.end = s;
    if (layout[s].name == "underside" + side) found.underside = s;
  }
  FR_CHECK(layout[found.shoulder].held_knot >= 0);
  found.tip_knot = static_cast<size_t>(layout[found.shoulder].held_knot);  // The shoulder bends at its tip.
  return found;
}

// On the left the sections run shoulder: top to neck; underside: underarm to bottom. On the right they run backwards.
SleeveCorners CornersOf(const std::vector<Polyline>& sections, const SleeveSections& sleeve, int tip_index, bool left) {
  const Polyline& shoulder = sections[sleeve.shoulder];
  const Polyline& underside = sections[sleeve.underside];
  return {shoulder[static_cast<size_t>(tip_index)], left ? shoulder.front() : shoulder.back(),
          left ? underside.back() : underside.front(), left ? underside.front() : underside.back()};
}

Chords ChordsOf(const SleeveCorners& c) {
  return Chords((Chords() << (c.tip - c.top).norm(), (c.underarm - c.bottom).norm(), (c.top - c.bottom).norm(),
                 (c.tip - c.bottom).norm(), (c.underarm - c.top).norm())
                    .finished());
}

// Gauss-Newton from the averaged corners; five chords, four unknowns.
void SolveEndCorners(const Chords& wanted, SleeveCorners& corners) {
  for (int iteration = 0; iteration < 8; ++iteration) {
    const Chords residual = ChordsOf(corners) - wanted;
    Eigen::Matrix<double, 5, 4> jacobian = Eigen::Matrix<double, 5, 4>::Zero();
    jacobian.block<1, 2>(0, 0) = (corners.top - corners.tip).normalized().transpose();
    jacobian.block<1, 2>(1, 2) = (corners.bottom - corners.underarm).normalized().transpose();
    jacobian.block<1, 2>(2, 0) = (corners.top - corners.bottom).normalized().transpose();
    jacobian.block<1, 2>(2, 2) = (corners.bottom - corners.top).normalized().transpose();
    jacobian.block<1, 2>(3, 2) = (corners.bottom - corners.tip).normalized().transpose();
    jacobian.block<1, 2>(4, 0) = (corners.top - corners.underarm).normalized().transpose();
    const Eigen::Vector4d step = jacobian.colPivHouseholderQr().solve(-residual);
    corners.top += step.head<2>();
    corners.bottom += step.tail<2>();
  }
}

// Moves the sleeve's part of the shoulder section; the part from the tip to the neck stays.
void MoveSleeveTop(Polyline& shoulder, int tip_index, bool left, const Eigen::Vector2d& top) {
  const auto tip = static_cast<std::ptrdiff_t>(tip_index);
  Polyline part =
      left ? Polyline(shoulder.begin(), shoulder.begin() + tip + 1) : Polyline(shoulder.begin() + tip, shoulder.end());
  MoveEnds(part, left ? top : part.front(), left ? part.back() : top);
  std::copy(part.begin(), part.end(), left ? shoulder.begin() : shoulder.begin() + tip);
}

}  // namespace

void KeepSleeveLengths(const std::vector<SectionLayout>& layout, const KnotIndices& knots,
                       const std::vector<const ViewSamples*>& views, bool asymmetric, std::vector<Polyline>& shared) {
  std::array<Chords, 2> mean = {Chords::Zero(), Chords::Zero()};
  std::array<SleeveSections, 2> sleeves;
  std::array<int, 2> tips = {};
  for (size_t side = 0; side < 2; ++side) {
    sleeves[side] = FindSleeve(layout, side == 0);
    tips[side] = knots[sleeves[side].shoulder][sleeves[side].tip_knot];
    for (const ViewSamples* view : views) {
      mean[side] +=
          ChordsOf(CornersOf(view->points, sleeves[side], tips[side], side == 0)) / static_cast<double>(views.size());
    }
  }
  if (!asymmetric) {
    const Chords both = 0.5 * (mean[0] + mean[1]);
    mean = {both, both};
  }
  for (size_t side = 0; side < 2; ++side) {
    const bool left = side == 0;
    const SleeveSections& sleeve = sleeves[side];
    SleeveCorners corners = CornersOf(shared, sleeve, tips[side], left);
    if (ChordsOf(corners).minCoeff() < 1e-3) continue;  // No sleeve to speak of.
    SolveEndCorners(mean[side], corners);
    if (!corners.top.allFinite() || !corners.bottom.allFinite()) continue;
    MoveSleeveTop(shared[sleeve.shoulder], tips[side], left, corners.top);
    Polyline& end = shared[sleeve.end];
    Polyline& underside = shared[sleeve.underside];
    if (left) {
      MoveEnds(end, corners.bottom, corners.top);
      MoveEnds(underside, underside.front(), corners.bottom);
    } else {
      MoveEnds(end, corners.top, corners.bottom);
      MoveEnds(underside, corners.bottom, underside.back());
    }
  }
}

}  // namespace fitroom::panels

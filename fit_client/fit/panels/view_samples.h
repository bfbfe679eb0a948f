#pragma once

#include <vector>

#include <Eigen/Core>

#include "fit_client/fit/panels/outline_layout.h"
#include "fit_client/fit/panels/polyline.h"
#include "fit_client/fit/panels/view_outline.h"

namespace fitroom::panels {

// Samples of one view's sections, equally many in both views and on both sides, so that samples correspond.
struct ViewSamples {
  std::vector<Polyline> pixels;  // Per section, in the photograph.
  std::vector<Polyline> points;  // The same, upright in the wearer's frame (unit: metre).
};

// Which sample of a section sits on which of its knots. Two knots less than 2 mm apart share a sample.
using KnotIndices = std::vector<std::vector<int>>;  // [section][knot].

// Chooses how many samples each interval of each section gets, about one every 8 mm, the same on mirrored sections.
KnotIndices ChooseKnotIndices(const std::vector<SectionLayout>& layout, const std::vector<const ViewOutline*>& views);

// Samples a view and stands it upright: the axis about which its two sides mirror each other best becomes vertical.
// The origin is left at the middle of the seams, the same for each view of a garment but for noise.
ViewSamples SampleUpright(const std::vector<SectionLayout>& layout, const KnotIndices& knots, const ViewOutline& view,
                          double length);

// Moves a view's points so that the mean of all samples on sections that both views share is the origin.
void CentreOnSeams(const std::vector<SectionLayout>& layout, ViewSamples& samples);

// Turns a view so that the ends of its upper opening, the first section, are level: how a garment without a mirror
// plane is stood upright.
void LevelUpperOpening(ViewSamples& samples);

// Returns a section's points mirrored at the plane x = 0 and in reverse order: as its mirror section runs.
Polyline Mirrored(const Polyline& points);

// Replaces a chain's ends, the displacement fading linearly along the chain between them.
void MoveEnds(Polyline& points, const Eigen::Vector2d& first, const Eigen::Vector2d& last);

}  // namespace fitroom::panels

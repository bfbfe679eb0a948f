#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "fit_client/fit/cloth_mesh.h"

namespace fitroom {

// The part of a line that lies on one panel, from seam to seam.
struct LineHalf {
  double worn_length = 0.0;
  double flat_length = 0.0;
  double height = 0.0;                                             // Mean, as worn.
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();                // Mean place of the cloth on it, as worn.
  std::array<Eigen::Vector3d, 2> ends = {Eigen::Vector3d::Zero(),  // As worn: the wearer's right one, the left one.
                                         Eigen::Vector3d::Zero()};
};

// A line of the garment's own that runs round the body: level across the flat panels, wherever it lies when worn. Its
// length does not depend on folds and on how obliquely the cloth hangs, so that drape and flat pattern can be compared.
struct GarmentLine {
  bool found = false;
  double worn_girth = 0.0;  // Along the cloth as worn; open seams count nothing (unit: metre).
  double flat_girth = 0.0;  // Of the same line at rest: twice the flat width (unit: metre).
  double height = 0.0;      // Mean of the worn line (unit: metre).
  // False: it runs out of the cloth at a hem or a neckline, or out of a sleeve into the torso, and its lengths are not
  // those of a girth.
  bool is_closed = false;
  std::array<LineHalf, 2> halves;  // Of the front and of the back panel; MeasureLine() alone fills them.
};

// The height of a line in the flat frame of the front panel and of the back panel (unit: metre).
using LineHeights = std::array<double, 2>;

// Returns the torso's (or both legs' together) line at these heights of the panels; sleeves are left out. Not found
// where one of the panels has no cloth there.
GarmentLine MeasureLine(const ClothMesh& cloth, const std::vector<Eigen::Vector3d>& positions,
                        const LineHeights& heights);

// Returns the heights of the line that lies at `height` above the floor when worn: of each panel the mean over the
// curve in which the level plane cuts it. Nothing where that curve spans less than six tenths of a panel's width: the
// garment ends above or below, or stands askew there.
std::optional<LineHeights> FindLineAt(const ClothMesh& cloth, const std::vector<Eigen::Vector3d>& positions,
                                      double height);

// Returns the line round a sleeve where a plane through `origin` square to `direction` cuts its worn cloth, not
// farther than `reach` from the origin (unit: metre). `left`: the wearer's left sleeve.
GarmentLine MeasureSleeve(const ClothMesh& cloth, const std::vector<Eigen::Vector3d>& positions,
                          const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double reach, bool left);

// Returns the edge of the opening on which these particles lie: a waist, from its corners. Along the panels' borders
// that are sewn to nothing, both panels' together. Not found where no such border meets the particles.
GarmentLine MeasureOpening(const ClothMesh& cloth, const std::vector<Eigen::Vector3d>& positions,
                           const std::vector<int>& particles);

// Returns how much of a triangle belongs to a sleeve, 0 to 1; 0 where nobody knows.
double SleevePart(const ClothMesh& cloth, const Eigen::Vector3i& triangle, bool left);

}  // namespace fitroom

#pragma once

#include <string>
#include <vector>

#include "common/base/status.h"
#include "common/image/image.h"
#include "fit_client/render/pictures.h"
#include "fit_client/render/scene.h"

namespace fitroom::render {

// One step of a map's colours: values from `from` up to the next band's.
struct MapBand {
  double from = 0.0;  // In the scale's unit.
  std::string label;  // "2-5 SNUG"; what label.h can write.
  Colour colour;
};

// How numbers become colours: bands from the smallest up. The colours of ours are told apart by lightness alone, so
// that no kind of colour blindness matters.
struct MapScale {
  std::string title;           // "STRAIN %".
  std::vector<MapBand> bands;  // At least one; `from` ascending.
};

// Strain, as a part of the length: none to 2 %, snug to `tight`, tight to `limit`, cannot be worn.
MapScale StrainScale(double tight, double limit);
// Pressure (unit: Pa), in the bands of Anthropometry, Apparel Sizing and Design, table 13.5.
MapScale PressureScale();
// Gap between body and cloth (unit: metre): lies on it, near, loose, stands off.
MapScale GapScale();

// What a map shows. Views of what the caller owns.
struct FitMapRequest {
  const DisplayBody* body = nullptr;
  const ClothMesh* cloth = nullptr;
  std::vector<Eigen::Vector3d> positions;  // As worn, one a particle (unit: metre).
  std::vector<double> values;              // One a particle or one a triangle, in the scale's unit.
  MapScale scale;
  std::vector<GarmentShape> others;  // Worn with it; those that cover it are better left out.
};

// Returns the share of a scale at which a value lies, 0 to 1: band i of n covers i/n to (i+1)/n.
double PlaceOnScale(const MapScale& scale, double value);

// Returns the values of triangles as values of particles: the mean over the triangles round each, sewn partners
// together.
std::vector<double> SpreadToParticles(const ClothMesh& cloth, const std::vector<Eigen::Vector3d>& positions,
                                      const std::vector<double>& triangle_values);

// Draws the garment from front and back in the colours of the map, side by side, with the legend below (1206 x 1010).
// INVALID_ARGUMENT [BAD_MAP_REQUEST] for values that are neither one a particle nor one a triangle, or an empty scale;
// values that are not finite count as 0. Else fails like Renderer::Draw().
Result<Image> DrawFitMap(const FitMapRequest& request);

}  // namespace fitroom::render

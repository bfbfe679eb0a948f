#pragma once

#include "fit_client/fit/cloth_mesh.h"

namespace fitroom::testing {

// A tube skirt in two panels, front and back, with the corners e1 to e4: `width` flat at the waist, `hem_width` at the
// hem (unit: metre). Rest frame as ClothMesh says.
ClothMesh MakeTubeSkirt(double width, double hem_width, double length, int columns, int rows);

}  // namespace fitroom::testing

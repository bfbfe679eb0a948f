#pragma once

#include "fit_client/fit/cloth_mesh.h"
#include "fit_client/fit/collision/signed_distance_field.h"

namespace fitroom::testing {

// A flat rectangle in the plane z = 0, cut into squares of two triangles, from the origin towards +x and +y.
ClothMesh MakeSheet(double width, double height, int columns, int rows);

// Two rectangles, front at +distance and back at -distance from the plane z = 0, centred on the y axis, sewn along both
// long sides: a tube once closed. Facing outwards.
ClothMesh MakeTube(double width, double height, int columns, int rows, double distance);

// The field of a small sphere far below everything: a body that nothing touches.
SignedDistanceField MakeFarBody();

// The field of a thick plate whose upper side lies in the plane through the origin, tilted about z by `angle`, so that
// the plane falls towards +x.
SignedDistanceField MakeSlope(double angle);

}  // namespace fitroom::testing

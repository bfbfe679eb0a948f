#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/base/status.h"
#include "common/geometry/triangle_mesh.h"
#include "fit_client/fit/cloth_mesh.h"

namespace fitroom::testing {

// A cone of elliptic section along y: half axes grow linearly from the upper to the lower end; closed, facing outwards.
// Each of the `along` bands of `around` quads is two triangles.
TriangleMesh MakeEllipticCone(double upper_half_width, double lower_half_width, double depth_ratio, double low,
                              double high, int around, int along);

// A skirt of two trapezoids for MakeEllipticCone(): at every height as wide as half the cone's girth times `ease`.
// Panels at z = +distance and -distance; from y = low to y = high.
ClothMesh MakeConeSkirt(double upper_half_width, double lower_half_width, double depth_ratio, double body_low,
                        double body_high, double low, double high, double ease, double distance, int columns, int rows);

// The case that both profiles can end: an elliptic cone that widens downwards, so steep that a strain of one per cent
// is a slip of no more than 3 mm, and a skirt cut to it with 2 % of ease, of 3 cm pitch over `refinement`. Friction,
// bending and folds decide nothing here: the end is the only one there is.
TriangleMesh CommonCone();
ClothMesh CommonSkirt(double refinement);

// Perimeter of an ellipse by Ramanujan's second formula, exact to 1e-5 of it for ratios above 0.5.
double EllipsePerimeter(double a, double b);

// Root of the mean squared distance of corresponding places (unit: metre).
double RmsDistance(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b);

// Cuts every triangle into four, `rounds` times; the surface stays the same.
TriangleMesh Refined(const TriangleMesh& mesh, int rounds);

// The T-shirt of two flat panels that other programs are measured on, in a Z-up frame: "0.02" or "0.01" (pitch, metre).
Result<ClothMesh> LoadPeerShirt(const std::filesystem::path& folder, const std::string& pitch);

}  // namespace fitroom::testing

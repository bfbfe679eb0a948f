#pragma once

#include <span>
#include <string>

#include <Eigen/Core>

namespace fitroom {

// Returns a Wavefront OBJ with these vertices and triangles (0-based here, 1-based in the text), in this order, with
// seven decimals: 0.1 micrometre where the unit is a metre.
std::string FormatObj(std::span<const Eigen::Vector3d> vertices, std::span<const Eigen::Vector3i> triangles);

}  // namespace fitroom

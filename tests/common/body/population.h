#pragma once

#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/triangle_mesh.h"

namespace fitroom::testing {

// The truth about one body of the external population, as measured on the closed mesh it was made from.
struct BodyTruth {
  std::map<std::string, Eigen::Vector3d> landmarks;  // In the file's frame (unit: centimetre).
  std::map<std::string, double> measurements;        // Named as the columns of measurements.csv.
};

// Reads the truth tables of the population, by body id ("p001" …). Empty where the external test data is absent.
std::map<std::string, BodyTruth> ReadPopulationTruth();

// Reads a scan below the folder of bodies ("population/p001.ply"). Fails the test, and returns no triangles, on error.
TriangleMesh ReadBody(const std::string& path_below_bodies);

}  // namespace fitroom::testing

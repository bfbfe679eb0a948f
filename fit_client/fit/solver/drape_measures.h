#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/base/executor.h"
#include "fit_client/fit/solver/drape.h"

namespace fitroom {

// Returns the value below which `share` (0 to 1) of the values lie; the largest for 1. `values` must not be empty.
double Percentile(std::vector<double> values, double share);

// Fills the strain of the report from particle positions: the strain of every edge of every triangle of the mesh.
void MeasureStrain(const ClothModel& model, std::span<const Eigen::Vector3d> positions, const ClothMesh& mesh,
                   DrapeReport& report);

// Fills what lies inside the body: particles, edge middles and triangle centres, by exact distances near the surface.
void MeasurePenetration(const ClothModel& model, std::span<const Eigen::Vector3d> positions,
                        const SignedDistanceField& body, Executor& executor, DrapeReport& report);

// Returns how often an edge of the cloth crosses a triangle of the cloth that shares no particle with it.
int CountSelfCrossings(const ClothModel& model, std::span<const Eigen::Vector3d> positions, Executor& executor);

}  // namespace fitroom

#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "fit_client/fit/panels/mesh_size.h"
#include "fit_client/fit/panels/pattern.h"

namespace fitroom::panels {

// A panel's outline sampled about every edge length, counter-clockwise, corners once.
struct OutlineSamples {
  std::vector<Eigen::Vector2d> points;  // (unit: metre)
  std::vector<Eigen::Vector2d> pixels;
  std::vector<std::vector<int>> samples_of_section;  // Per section, from corner to corner.
  struct Named {
    std::string name;
    int sample = 0;
  };
  std::vector<Named> named;  // Each named point once.
  std::vector<bool> sewn;    // Whether a sample lies on a seam, its ends included.
};

// Samples all sections. Corners are samples exactly; so are the other knots that lie at least 0.8 pitches from their
// neighbours. The number of samples depends on the section's points alone, so that equal seams are sampled equally.
OutlineSamples SampleOutline(const PanelPattern& panel, const MeshSize& size);

// Returns the places of one section's samples as shares of its length, from 0 to 1.
std::vector<double> SampleShares(const OutlineSection& section, const MeshSize& size);

// The same at given places, so that seams of two pieces are sampled one to one: `shares` holds those of each section.
OutlineSamples SampleOutlineAt(const PanelPattern& panel, const std::vector<std::vector<double>>& shares);

}  // namespace fitroom::panels

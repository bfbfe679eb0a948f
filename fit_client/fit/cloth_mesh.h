#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace fitroom {

// Two particles that are to be sewn onto each other.
struct SeamPair {
  int a = 0;  // Particle on the front panel.
  int b = 0;  // Particle on the back panel.
};

// A named point of the outline and the particle that sits on it.
struct NamedParticle {
  std::string name;  // As in OutlinePointNames(), with the panel in front: "front/e3", "back/hem_L".
  int particle = 0;
};

// A garment before it is worn: panels cut from the photographs, at rest, flat, with the pairs to be sewn.
// The rest shape, immutable while dressing; one mesh serves many bodies. Triangles are counter-clockwise seen from the
// outside of the garment (front: from +Z; back: from -Z).
// Rest frame: metres, x towards the wearer's left, y up, z = 0; origin of tops and one-pieces at Cp (the midpoint of P1
// and P2), of bottoms in the middle between the waist's ends e1 and e3.
struct ClothMesh {
  std::vector<Eigen::Vector3d> rest_positions;
  std::vector<Eigen::Vector3i> triangles;
  std::vector<int> panel_of_particle;                // 0 front, 1 back.
  std::vector<Eigen::Vector2d> texture_coordinates;  // Of the panel's photograph; (0,0) top left, (1,1) bottom right.
  std::vector<SeamPair> seams;
  std::vector<NamedParticle> named_particles;
  // How much a particle belongs to a sleeve: 0 on the torso, 1 on the sleeve, smooth across the armhole line (shoulder
  // tip to underarm) over about 6 cm; 0 everywhere on a kind without sleeves. For turning the sleeves about the
  // shoulder in the start position. One a particle; both empty where nobody knows, as in panels read from a file.
  std::vector<double> left_sleeve_weights;
  std::vector<double> right_sleeve_weights;
};

// The pieces that a mesh is cut in: what triangles join, seams aside.
struct ClothPieces {
  std::vector<int> piece_of_particle;  // Pieces are numbered by their lowest particles.
  int count = 0;
};

// Finds the pieces; a particle without a triangle is one of its own.
ClothPieces FindPieces(const ClothMesh& mesh);

// The mean over triangles of the lengths of their edges at rest: inner edges count twice (unit: metre); 0 without
// triangles.
double MeanEdgeLength(const ClothMesh& mesh);

}  // namespace fitroom

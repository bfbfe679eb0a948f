#pragma once

#include <cstdint>
#include <vector>

#include "fit_client/fit/collision/signed_distance_field.h"

namespace fitroom {

// What is known at one sample while a field is being built.
struct NearestTriangle {
  float squared_distance = 0.0F;
  float facing = 0.0F;  // Cosine between the way from the surface and the surface's normal; its sign tells in from out.
  int32_t triangle = -1;  // None yet.
};

// Fills a SignedDistanceField. One object builds one field; not thread-safe, uses the executor itself.
//
// 1. Triangles are binned into the bricks they come within two pitches of; bricks without triangles are not stored.
// 2. Each stored brick splats its triangles onto the samples within kNearCells pitches of them (exact there), then the
//    remaining samples try the nearest triangles of their neighbours.
// 3. The coarse grid takes over what the bricks know and hands nearest triangles on by sweeping.
// Sign: face and vertex normals as in Baerentzen and Aanaes, "Signed distance computation using the angle weighted
// pseudonormal", 2005; on an edge, of the two triangles that tie, the one that faces the query more squarely decides,
// which is the same sign as the edge's pseudonormal and needs no adjacency. Away from the surface the sign is inherited
// from neighbours, so that one bad triangle cannot spoil a region.
class SignedDistanceFieldBuilder {
 public:
  SignedDistanceFieldBuilder(const TriangleMesh& body, const SignedDistanceFieldOptions& options, Executor& executor);

  Result<SignedDistanceField> Build();

  // Updates `nearest` if `triangle` is closer to `point`, or ties and faces it more squarely.
  static void Consider(const SignedDistanceField& field, const Eigen::Vector3f& point, int32_t triangle,
                       NearestTriangle& nearest);

 private:
  struct Box {
    Eigen::Vector3i low;
    Eigen::Vector3i high;  // Inclusive.
  };
  using BrickSamples = std::vector<NearestTriangle>;

  Status CheckInput() const;
  Status LayOutRegion();
  void KeepTrianglesInReach();
  void ComputeAngleWeightedNormals();
  void BinTriangles();
  Box BricksNear(const Eigen::Vector3i& triangle) const;

  void FillBrick(size_t slot);
  void SplatTriangles(size_t slot, const Eigen::Vector3i& first_node, BrickSamples& samples) const;
  void SpreadInBrick(const Eigen::Vector3i& first_node, BrickSamples& samples) const;

  void FillCoarseGrid();
  void TakeOverBricks(std::vector<NearestTriangle>& nodes) const;
  void SpreadOverCoarseGrid(std::vector<NearestTriangle>& nodes, const std::vector<bool>& fixed) const;
  void SignCoarseGrid(std::vector<NearestTriangle>& nodes, const std::vector<bool>& fixed) const;

  Eigen::Vector3f FinePoint(const Eigen::Vector3i& node) const {
    return node.cast<float>() * static_cast<float>(field_.pitch_);
  }

  const TriangleMesh& body_;
  const SignedDistanceFieldOptions& options_;
  Executor& executor_;
  SignedDistanceField field_;
  std::vector<Eigen::Vector3i> brick_of_slot_;
  std::vector<NearestTriangle> coarse_of_brick_;  // 27 a slot: what the brick knows at its coarse nodes.
};

}  // namespace fitroom

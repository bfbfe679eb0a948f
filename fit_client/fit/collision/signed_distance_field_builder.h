#pragma once

#include <cstdint>
#include <vector>

#include "fit_client/fit/collision/signed_distance_field.h"

namespace fitroom {

// What is known at one sample while a field is being built.
struct NearestTriangle {
  float squared_distance = 0.0F;  // (unit: m^2)
  float distance = 0.0F;          // (unit: metre)
  float facing = 0.0F;  // Cosine between the way from the surface and the surface's normal; its sign tells in from out.
  int32_t triangle = -1;  // None yet.
};

// Fills a SignedDistanceField. One object builds one field; not thread-safe, uses the executor itself.
//
// 1. Triangles are binned into the bricks they come within two pitches of; bricks without triangles are not stored.
// 2. The coarse grid gets a nearest triangle a node from triangles next to it and by sweeping from node to node.
// 3. Each stored brick splats its triangles onto the samples within kNearCells pitches of them (exact there); the
//    remaining samples try the nearest triangles of the coarse grid and of their neighbours.
// 4. The coarse nodes in bricks take over what the bricks know; the other ones get their sign from them.
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
  // The same, but looks first whether the ball round the triangle is near enough.
  void TryTriangle(const Eigen::Vector3f& point, int32_t triangle, NearestTriangle& nearest) const {
    const Eigen::Vector4f& sphere = spheres_[static_cast<size_t>(triangle)];
    const float reach = nearest.distance * 1.00001F + sphere[3];
    if ((point - sphere.head<3>()).squaredNorm() > reach * reach) return;
    Consider(field_, point, triangle, nearest);
  }

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
  void SpreadInBrick(const Eigen::Vector3i& first_node, const std::vector<bool>& reached, BrickSamples& samples) const;
  static void SpreadSigns(const std::vector<bool>& reached, BrickSamples& samples);

  void SeedCoarseGrid();
  void SpreadOverCoarseGrid();
  void FillCoarseGrid();
  std::vector<bool> TakeOverBricks();
  void SignCoarseGrid(const std::vector<bool>& in_brick);

  Eigen::Vector3f FinePoint(const Eigen::Vector3i& node) const {
    return node.cast<float>() * static_cast<float>(field_.pitch_);
  }

  const TriangleMesh& body_;
  const SignedDistanceFieldOptions& options_;
  Executor& executor_;
  SignedDistanceField field_;
  std::vector<Eigen::Vector3i> brick_of_slot_;
  std::vector<Eigen::Vector4f> spheres_;          // One a triangle: centre and radius of a ball round it.
  std::vector<NearestTriangle> coarse_;           // One a coarse node.
  std::vector<NearestTriangle> coarse_of_brick_;  // 27 a slot: what the brick knows at its coarse nodes.
};

}  // namespace fitroom

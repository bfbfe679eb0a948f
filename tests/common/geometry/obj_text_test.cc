#include "common/geometry/obj_text.h"

#include <vector>

#include <gtest/gtest.h>

namespace fitroom {
namespace {

TEST(FormatObj, WritesVerticesThenTrianglesCountedFromOne) {
  const std::vector<Eigen::Vector3d> vertices = {{0.0, 1.5, -2.25}, {1e-7, 1e3, -1e-8}};
  const std::vector<Eigen::Vector3i> triangles = {{0, 1, 0}};
  EXPECT_EQ(FormatObj(vertices, triangles),
            "v 0.0000000 1.5000000 -2.2500000\n"
            "v 0.0000001 1000.0000000 -0.0000000\n"
            "f 1 2 1\n");
}

}  // namespace
}  // namespace fitroom

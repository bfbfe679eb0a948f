#pragma once

#include <string>
#include <vector>

#include "common/base/status.h"
#include "common/image/image.h"
#include "fit_client/render/scene.h"

namespace fitroom::render {

// The garment at the end of one stage of the process.
struct StageShape {
  std::string name;                        // In file names, [a-z0-9_]+: "start", "merging", "stitched", "final".
  std::string title;                       // On the sheet: "1 START".
  std::vector<Eigen::Vector3d> positions;  // One a particle.
  bool draw_stitch_lines = false;          // Draw the line between the two particles of each open seam pair.
};

// What the pictures of one fit are made of. Views of what the caller owns.
struct FitPictureRequest {
  const DisplayBody* body = nullptr;
  const ClothMesh* cloth = nullptr;
  const Image* front_texture = nullptr;  // Null: plain cloth.
  const Image* back_texture = nullptr;   // Null: the front's.
  std::vector<GarmentShape> others;      // Worn already: drawn as they are in every stage.
  std::vector<StageShape> stages;        // In the order of the process; the last one is what is shown to the shopper.
  int thread_count = 1;                  // Pictures are drawn on at most two threads; the bytes do not depend on it.
};

// A finished picture.
struct NamedPicture {
  std::string file_name;  // "front.png"
  std::string description;
  std::string png;  // The file's bytes.
};

// Draws everything a fit shows: front.png, side.png, back.png and three_quarter.png (800 x 1200) of the last stage, of
// its garment front_close.png and back_close.png (800 x 900),
// stage_<name>_<view>.png (400 x 600) of each stage from front, side and back, and stages.png, a labelled sheet of
// these. Fails like Renderer::Draw().
Result<std::vector<NamedPicture>> DrawFitPictures(const FitPictureRequest& request);

// Returns lines between the partners of open seam pairs, about every 2 cm of seam: more would merge into a band.
std::vector<LineSegment> MakeStitchLines(const ClothMesh& cloth, const std::vector<Eigen::Vector3d>& positions);

// Composes RGB pictures of one size in a sheet with labels above the columns and in the corner of each row.
Image ComposeSheet(const std::vector<std::vector<Image>>& rows, const std::vector<std::string>& row_labels,
                   const std::vector<std::string>& column_labels);

}  // namespace fitroom::render

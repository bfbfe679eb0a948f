#pragma once

#include <string>
#include <vector>

#include "common/base/status.h"
#include "common/image/image.h"
#include "fit_client/render/scene.h"

namespace fitroom::render {

// One size of a garment on one body. Views of what the caller owns.
struct SizeColumn {
  std::string size;                     // "M"
  std::string verdict;                  // "TIGHT AT THE HIP: …"; wrapped, and the sheet grows with the longest.
  std::vector<std::string> ease_lines;  // "BUST +8 CM", one a line, at most six are shown.
  bool is_recommended = false;          // Framed.
  GarmentShape shape;                   // The size as worn; no cloth: the size was not dressed.
  std::vector<GarmentShape> others;     // Worn with it.
};

// The most sizes that a sheet shows; more are refused.
inline constexpr size_t kMostSizeColumns = 12;

// Draws all sizes side by side, each from front and side in one scale, with name, verdict and ease below: one picture,
// 300 pixels a column. INVALID_ARGUMENT [BAD_SIZE_SHEET] for no or too many columns; else fails like Renderer::Draw().
// `thread_count`: at most two threads draw; the bytes do not depend on it.
Result<Image> DrawSizeSheet(const DisplayBody& body, const std::vector<SizeColumn>& columns, int thread_count);

// Breaks a text into lines of at most `width` pixels at its spaces; a longer word stays whole.
std::vector<std::string> WrapLabel(const std::string& text, double height, double width);

}  // namespace fitroom::render

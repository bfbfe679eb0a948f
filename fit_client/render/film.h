#pragma once

#include <string>
#include <vector>

#include "common/base/status.h"
#include "fit_client/render/scene.h"

namespace fitroom::render {

// The garment at one moment of the film.
struct FilmKey {
  double seconds = 0.0;                    // From the film's start, ascending.
  std::string caption;                     // Written while this key is the last one passed; label.h's letters.
  std::vector<Eigen::Vector3d> positions;  // One a particle (unit: metre).
  bool draw_stitch_lines = false;          // Until the next key.
};

// What a film of the dressing is made of. Views of what the caller owns.
struct FilmRequest {
  const DisplayBody* body = nullptr;
  const ClothMesh* cloth = nullptr;
  const Image* front_texture = nullptr;
  const Image* back_texture = nullptr;
  std::vector<GarmentShape> others;  // Worn already.
  std::vector<FilmKey> keys;         // At least one; between keys the cloth moves straight and evenly.
  ViewDirection view = ViewDirection::kThreeQuarter;
  int frame_count = 26;  // At most 60.
  int hold_ms = 1500;    // The last frame stays this long.
  int thread_count = 1;  // At most two threads draw; the bytes do not depend on it.
};

// Returns an animated WebP of 640 x 960 pixels. INVALID_ARGUMENT [BAD_FILM_REQUEST] for no key, keys out of order or
// without one position a particle; else fails like Renderer::Draw().
Result<std::string> DrawDressingFilm(const FilmRequest& request);

// Returns the cloth at a moment of the film: straight between keys, the first before and the last after all of them.
std::vector<Eigen::Vector3d> FilmPositions(const std::vector<FilmKey>& keys, double seconds);

}  // namespace fitroom::render

#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "common/base/status.h"
#include "common/garment/garment.h"
#include "common/image/image.h"

namespace fitroom {

// A file that belongs to a garment: a photograph, a mask, a texture or the drawing of what was found.
struct GarmentFile {
  std::string name;  // IsPlainFileName().
  std::string bytes;
};

// Writes a garment's folder: `garment.json` and the files. The folder is made where it is missing; files of the same
// names are replaced, others are left alone. garment.json is written last, so that a folder with one is complete.
// Fails as ValidateGarment() does, INVALID_ARGUMENT GARMENT_FILE_NAME, GARMENT_FILE_MISSING where a view names a file
// that is not given, or as the file system does.
Status WriteGarmentFolder(const std::filesystem::path& folder, const Garment& garment,
                          std::span<const GarmentFile> files);

// Reads and validates the garment of a folder. NOT_FOUND GARMENT_NOT_FOUND without garment.json,
// GARMENT_FILE_MISSING where an image that a view names is absent, else as GarmentFromJson() does.
Result<Garment> ReadGarmentFolder(const std::filesystem::path& folder);

// Reads a view's texture (RGB) or mask (grey) and checks that it has the view's size: INVALID_ARGUMENT IMAGE_SIZE else.
Result<Image> ReadGarmentTexture(const std::filesystem::path& folder, const GarmentView& view);
Result<Image> ReadGarmentMask(const std::filesystem::path& folder, const GarmentView& view);

}  // namespace fitroom

#include "common/garment/garment_folder.h"

#include <algorithm>
#include <system_error>

#include "common/base/file.h"
#include "common/garment/garment_json.h"
#include "common/garment/validate.h"
#include "common/image/decode.h"

namespace fitroom {
namespace {

constexpr const char* kGarmentFileName = "garment.json";
constexpr size_t kMaxJsonSize = 4u << 20;    // (unit: byte)
constexpr size_t kMaxImageSize = 64u << 20;  // Our own textures are fast PNG, larger than photographs (unit: byte).

std::vector<const GarmentView*> ViewsOf(const Garment& garment) {
  std::vector<const GarmentView*> views = {&garment.front};
  if (garment.back) views.push_back(&*garment.back);
  if (garment.side_folded) views.push_back(&*garment.side_folded);
  return views;
}

Result<Image> ReadViewImage(const std::filesystem::path& path, const GarmentView& view, int channels) {
  FR_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(path, kMaxImageSize));
  ImageLimits limits;
  limits.max_bytes = kMaxImageSize;
  Result<Image> image = DecodeImage(bytes, limits);
  if (!image.ok()) return image.status().At(path.string());
  if (image->width != view.image_width || image->height != view.image_height) {
    return InvalidArgument("IMAGE_SIZE", path.string() + " has " + std::to_string(image->width) + " x " +
                                             std::to_string(image->height) + " pixels, garment.json says " +
                                             std::to_string(view.image_width) + " x " +
                                             std::to_string(view.image_height));
  }
  return ConvertChannels(*image, channels);
}

}  // namespace

Status WriteGarmentFolder(const std::filesystem::path& folder, const Garment& garment,
                          std::span<const GarmentFile> files) {
  FR_RETURN_IF_ERROR(ValidateGarment(garment));
  for (const GarmentView* view : ViewsOf(garment)) {
    for (const std::string& name : {view->photo_file, view->mask_file, view->texture_file}) {
      if (std::none_of(files.begin(), files.end(), [&](const GarmentFile& file) { return file.name == name; })) {
        return InvalidArgument("GARMENT_FILE_MISSING", name + " is named by the garment but not given");
      }
    }
  }
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return Unavailable("FILE_IO", folder.string() + ": " + error.message());
  for (const GarmentFile& file : files) {
    if (!IsPlainFileName(file.name) || file.name == kGarmentFileName) {
      return InvalidArgument("GARMENT_FILE_NAME", "\"" + file.name.substr(0, 40) + "\" cannot be a garment's file");
    }
    FR_RETURN_IF_ERROR(WriteFileAtomically(folder / file.name, file.bytes));
  }
  return WriteFileAtomically(folder / kGarmentFileName, GarmentToJson(garment));
}

Result<Garment> ReadGarmentFolder(const std::filesystem::path& folder) {
  Result<std::string> text = ReadFile(folder / kGarmentFileName, kMaxJsonSize);
  if (text.status().code() == StatusCode::kNotFound) {
    return NotFound("GARMENT_NOT_FOUND", folder.string() + " holds no garment.json; give a folder that " +
                                             "shop_catalog extract or fit_client pull has written");
  }
  if (!text.ok()) return text.status();
  Result<Garment> garment = GarmentFromJson(*text);
  if (!garment.ok()) return garment.status().At((folder / kGarmentFileName).string());
  for (const GarmentView* view : ViewsOf(*garment)) {
    for (const std::string& name : {view->mask_file, view->texture_file}) {
      std::error_code error;
      if (!std::filesystem::is_regular_file(folder / name, error)) {
        return NotFound("GARMENT_FILE_MISSING", (folder / name).string() + " is missing; extract or pull it again");
      }
    }
  }
  return garment;
}

Result<Image> ReadGarmentTexture(const std::filesystem::path& folder, const GarmentView& view) {
  return ReadViewImage(folder / view.texture_file, view, 3);
}

Result<Image> ReadGarmentMask(const std::filesystem::path& folder, const GarmentView& view) {
  return ReadViewImage(folder / view.mask_file, view, 1);
}

}  // namespace fitroom
